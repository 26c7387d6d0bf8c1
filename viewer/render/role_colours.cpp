#include "viewer/render/role_colours.hpp"

#include <algorithm>
#include <string>

#include <curveskel/role_names.hpp>
#include "viewer/render/colours.hpp"

namespace curveskel::viewer {
namespace {

/// "figure2_head" of a scene's second figure is "head".
std::string without_figure(const std::string& role) {
  return role.starts_with("figure") ? role.substr(role.find('_') + 1) : role;
}

/// "leftFoot" and "rightFoot" are "Foot", "shin.L" and "shin.R" are "shin".
std::string without_side(const std::string& role) {
  if (role.starts_with("left")) return role.substr(4);
  if (role.starts_with("right")) return role.substr(5);
  if (role.ends_with(".L") || role.ends_with(".R")) return role.substr(0, role.size() - 2);
  return role;
}

/// Of every body that there is a plan of, so that a role has its colour whatever else a rig has.
const std::vector<std::string>& kinds_of_roles() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> kinds;
    for (const auto& entry : body_kinds) {
      for (const std::string& role : roles_of(entry.value)) {
        const std::string kind = without_side(role);
        if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
      }
    }
    return kinds;
  }();
  return all;
}

}  // namespace

std::vector<glm::vec3> role_colours(const Rig& rig) {
  constexpr float lighter = 0.35F;
  constexpr glm::vec3 unknown{0.6F};
  std::vector<std::string> kinds = kinds_of_roles();
  std::vector<glm::vec3> colours;
  for (std::size_t joint = 0; joint < rig.names.size(); ++joint) {
    const std::string role = joint < rig.roles.size() ? without_figure(rig.roles[joint]) : "";
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    if (role.empty()) {
      colours.push_back(parent < 0 ? unknown : colours[static_cast<std::size_t>(parent)]);
      continue;
    }
    const std::string kind = without_side(role);
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    const glm::vec3 colour = category(static_cast<std::size_t>(found - kinds.begin()));
    if (found == kinds.end()) kinds.push_back(kind);
    const bool is_left = role.starts_with("left") || role.ends_with(".L");
    colours.push_back(is_left ? glm::mix(colour, glm::vec3(1), lighter) : colour);
  }
  return colours;
}

}  // namespace curveskel::viewer
