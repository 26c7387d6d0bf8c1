#include "rig/pipeline/kept_joints.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/joints/keep_joints.hpp"

namespace curveskel {

bool is_required(const CharacterRig& character, std::size_t joint) {
  if (joint >= character.rig.roles.size()) return false;
  const std::string& role = character.rig.roles[joint];
  if (character.plan.plan == BodyKind::humanoid) {
    return std::find(required_human_roles.begin(), required_human_roles.end(), role) !=
           required_human_roles.end();
  }
  const std::array<std::string_view, 3> trunk{"spine", "neck", "head"};
  return std::any_of(trunk.begin(), trunk.end(),
                     [&](std::string_view word) { return role.starts_with(word); });
}

CharacterRig with_joints(CharacterRig character, std::vector<char> stays) {
  const std::vector<int> number = numbers_of_kept(character.rig, stays);
  character.rig = keep_joints(character.rig, number);
  std::vector<PlannedJoint> kept;
  for (std::size_t k = 0; k < character.plan.joints.size(); ++k) {
    if (number[k] < 0) continue;
    kept.push_back(std::move(character.plan.joints[k]));
    int& parent = kept.back().parent;
    if (parent >= 0) parent = number[idx(parent)];
  }
  character.plan.joints = std::move(kept);
  return character;
}

}  // namespace curveskel
