#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/levels.hpp>
#include <curveskel/rig_character.hpp>
#include "rig/joints/figure_name.hpp"
#include "rig/joints/sides.hpp"
#include "rig/joints/sound_rig.hpp"
#include "rig/pipeline/kept_joints.hpp"
#include "skeleton/graph/sound_skeleton.hpp"
#include "surface/spatial/box_tree.hpp"
#include "surface/spatial/segment.hpp"

namespace curveskel {
namespace {

/// Of the edges that lie near a place, without asking each.
class LivesByPlace {
 public:
  explicit LivesByPlace(const CurveSkeleton& skeleton)
      : skeleton_(skeleton), lives_(edge_lives(skeleton)), tree_(middles_of(skeleton)) {
    for (Eigen::Index edge = 0; edge < lives_.size(); ++edge) {
      const auto [from, to] = ends_of(edge);
      tree_.put(idx(edge), {Eigen::AlignedBox3d(from.cwiseMin(to), from.cwiseMax(to))});
    }
  }

  /// Of the nearest edge; where branches meet, that of the longest life.
  [[nodiscard]] double at(const Eigen::Vector3d& place, double near) const {
    constexpr double rounding = 1e-12;  // of distances to boxes beside those to what is in them
    const auto bound = [&](const BoxTree::Item& item) {
      return (1 - rounding) * item.box.exteriorDistance(place);
    };
    double least = std::numeric_limits<double>::infinity();
    tree_.search(bound, least,
                 [&](std::size_t edge) { least = std::min(least, distance_to(edge, place)); });
    double life = 0;
    const double most = least + near;
    tree_.search(bound, most, [&](std::size_t edge) {
      if (distance_to(edge, place) > most) return;
      life = std::max(life, lives_[static_cast<Eigen::Index>(edge)]);
    });
    return life;
  }

 private:
  static Positions middles_of(const CurveSkeleton& skeleton) {
    return 0.5 * (skeleton.nodes(skeleton.edges.col(0), Eigen::all) +
                  skeleton.nodes(skeleton.edges.col(1), Eigen::all));
  }

  [[nodiscard]] std::pair<Eigen::Vector3d, Eigen::Vector3d> ends_of(Eigen::Index edge) const {
    return {skeleton_.nodes.row(skeleton_.edges(edge, 0)),
            skeleton_.nodes.row(skeleton_.edges(edge, 1))};
  }

  [[nodiscard]] double distance_to(std::size_t edge, const Eigen::Vector3d& place) const {
    const auto [from, to] = ends_of(static_cast<Eigen::Index>(edge));
    return (nearest_on_segment(place, from, to) - place).norm();
  }

  const CurveSkeleton& skeleton_;
  Eigen::VectorXd lives_;  // by edge
  BoxTree tree_;
};

/// "left" or "right" for a role such as "leftIndexProximal", else "". That of a scene's second
/// figure begins with "figure2_", and so on.
std::string_view hand_of(std::string_view role) {
  constexpr std::array<std::string_view, 5> digits{"Thumb", "Index", "Middle", "Ring", "Little"};
  for (const std::string_view side : {"left", "right"}) {
    const std::string_view own = of_figure(role).own;
    if (!own.starts_with(side)) continue;
    const std::string_view rest = own.substr(side.size());
    const auto begins = [&](std::string_view digit) { return rest.starts_with(digit); };
    if (std::any_of(digits.begin(), digits.end(), begins))
      return role.substr(0, role.size() - rest.size());
  }
  return "";
}

/// The middle one of the lives of a hand's digits is that of all: no hand has fingers without a
/// thumb.
void share_in_hands(const Rig& rig, std::vector<double>& lives) {
  if (rig.roles.empty()) return;
  std::map<std::string_view, std::vector<double>> of_hands;
  const auto begins_digit = [&](std::size_t joint) {
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    return !hand_of(rig.roles[joint]).empty() &&
           (parent < 0 || hand_of(rig.roles[idx(parent)]).empty());
  };
  for (std::size_t joint = 0; joint < lives.size(); ++joint) {
    if (begins_digit(joint)) of_hands[hand_of(rig.roles[joint])].push_back(lives[joint]);
  }
  for (auto& [hand, all] : of_hands) std::sort(all.begin(), all.end());
  std::vector<char> in_digit(lives.size(), 0);
  for (std::size_t joint = 0; joint < lives.size(); ++joint) {
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    if (begins_digit(joint)) {
      const std::vector<double>& all = of_hands[hand_of(rig.roles[joint])];
      lives[joint] = all[all.size() / 2];
    } else if (parent >= 0 && in_digit[idx(parent)] != 0) {
      lives[joint] = lives[idx(parent)];
    } else {
      continue;
    }
    in_digit[joint] = 1;
  }
}

/// Of two that are each other's mirror images the longer life is that of both.
void share_with_twins(const Rig& rig, std::vector<double>& lives) {
  const std::vector<int> twins = twins_of(rig);
  for (std::size_t joint = 0; joint < lives.size(); ++joint) {
    if (twins[joint] >= 0) lives[joint] = std::max(lives[joint], lives[idx(twins[joint])]);
  }
}

/// By joint; a root lives for ever.
std::vector<double> lives_of_joints(const Rig& rig, const CurveSkeleton& skeleton) {
  const LivesByPlace by_place(skeleton);
  const double near =
      1e-6 * (skeleton.nodes.colwise().maxCoeff() - skeleton.nodes.colwise().minCoeff()).norm();
  std::vector<double> lives(rig.names.size(), lives_for_ever);
  for (std::size_t joint = 0; joint < lives.size(); ++joint) {
    const auto row = static_cast<Eigen::Index>(joint);
    if (rig.parents[row] < 0) continue;
    lives[joint] = by_place.at(rig.joints.row(row), near);
  }
  share_with_twins(rig, lives);
  share_in_hands(rig, lives);
  return lives;
}

}  // namespace

CharacterRig level_of_character(CharacterRig character, const CurveSkeleton& skeleton,
                                double least_life) {
  const Rig& rig = character.rig;
  require_sound(rig, "level_of_character");
  require_planned_joints(character, "level_of_character");
  require_sound(skeleton, "level_of_character");
  if (skeleton.lives.size() == 0 || skeleton.edges.rows() == 0 || !(least_life > 0)) {
    return character;
  }
  least_life = std::min(least_life, lives_for_ever);
  const std::vector<double> lives = lives_of_joints(rig, skeleton);
  std::vector<char> stays(rig.names.size(), 0);
  for (std::size_t joint = 0; joint < stays.size(); ++joint) {
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    const bool hangs = parent < 0 || stays[idx(parent)] != 0;
    stays[joint] = (hangs && lives[joint] >= least_life) || is_required(character, joint) ? 1 : 0;
  }
  mark_ancestors(character.rig, stays);
  return with_joints(std::move(character), stays);
}

}  // namespace curveskel
