#include <cctype>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/role_names.hpp>
#include "rig/joints/sound_rig.hpp"
#include "rig/plan/role_words.hpp"

namespace curveskel {
namespace {

/// Small letters and digits, without the namespace before a colon, or Mixamo's where a program
/// wrote the colon as another sign: UpperArm.L, upper_arm.L and upperarm_l are one word.
std::string letters_of(std::string_view name) {
  name.remove_prefix(name.rfind(':') + 1);              // none: npos + 1 = 0
  if (name.starts_with("DEF-")) name.remove_prefix(4);  // Rigify's bones that deform
  std::string letters;
  for (const char sign : name) {
    const auto byte = static_cast<unsigned char>(sign);
    if (std::isalnum(byte) != 0) letters += static_cast<char>(std::tolower(byte));
  }
  constexpr std::string_view mixamo = "mixamorig";
  if (!letters.starts_with(mixamo)) return letters;
  std::size_t end = mixamo.size();
  while (end < letters.size() && std::isdigit(static_cast<unsigned char>(letters[end])) != 0) ++end;
  return letters.substr(end);
}

/// By their letters; -1 for letters that several joints have.
std::map<std::string, int> joints_by_letters(const std::vector<std::string>& names) {
  std::map<std::string, int> joints;
  for (std::size_t joint = 0; joint < names.size(); ++joint) {
    const auto [found, is_new] =
        joints.try_emplace(letters_of(names[joint]), static_cast<int>(joint));
    if (!is_new) found->second = -1;
  }
  return joints;
}

using JointOfRole = std::map<std::string, int>;

JointOfRole named_in(NameStyle style, const std::map<std::string, int>& joints) {
  JointOfRole found;
  for (const std::string& role : roles_of(BodyKind::humanoid)) {
    const auto joint = joints.find(letters_of(name_of_role(role, BodyKind::humanoid, style)));
    if (joint != joints.end() && joint->second >= 0) found[role] = joint->second;
  }
  return found;
}

bool hangs_from(int joint, int above, const Eigen::VectorXi& parents) {
  while (joint >= 0 && joint != above) joint = parents[joint];
  return joint >= 0;
}

/// The joint after the hips on the way to the head, called whatever it is.
void add_spine(JointOfRole& joints, const Eigen::VectorXi& parents) {
  const auto hips = joints.find("hips");
  const auto head = joints.find("head");
  if (hips == joints.end() || head == joints.end() || joints.contains("spine")) return;
  if (!hangs_from(head->second, hips->second, parents) || head->second == hips->second) return;
  int joint = head->second;
  while (parents[joint] != hips->second) joint = parents[joint];
  if (joint == head->second) return;
  std::erase_if(joints, [joint](const auto& named) { return named.second == joint; });
  joints["spine"] = joint;
}

/// Each required bone is there and hangs from the one that VRM wants above it.
bool is_human(const JointOfRole& joints, const Eigen::VectorXi& parents) {
  const auto number = [&](const std::string& role) {
    const auto found = joints.find(role);
    return found == joints.end() ? -1 : found->second;
  };
  const auto hangs = [&](const std::string& role, const std::string& above) {
    const int joint = number(role);
    const int holder = number(above);
    return joint >= 0 && holder >= 0 && joint != holder && hangs_from(joint, holder, parents);
  };
  const auto side_hangs = [&](const std::string& side) {
    return hangs(side + "UpperLeg", "hips") && hangs(side + "LowerLeg", side + "UpperLeg") &&
           hangs(side + "Foot", side + "LowerLeg") && hangs(side + "UpperArm", "spine") &&
           hangs(side + "LowerArm", side + "UpperArm") && hangs(side + "Hand", side + "LowerArm");
  };
  return hangs("spine", "hips") && hangs("head", "spine") && side_hangs("left") &&
         side_hangs("right");
}

}  // namespace

std::vector<std::string> roles_by_name(const Rig& rig) {
  require_sound(rig, "roles_by_name");
  const std::map<std::string, int> by_letters = joints_by_letters(rig.names);
  JointOfRole best;  // styles share words, so the one that says most is meant
  for (const auto& style : name_styles) {
    if (style.value == NameStyle::neutral) continue;
    JointOfRole joints = named_in(style.value, by_letters);
    add_spine(joints, rig.parents);
    if (is_human(joints, rig.parents) && joints.size() > best.size()) best = std::move(joints);
  }
  if (best.empty()) return {};
  if (!best.contains("chest")) best.erase("upperChest");  // VRM has none without a chest
  std::vector<std::string> roles(rig.names.size());
  for (const auto& [role, joint] : best) roles[idx(joint)] = role;
  return roles;
}

}  // namespace curveskel
