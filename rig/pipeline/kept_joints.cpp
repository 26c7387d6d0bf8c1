#include "rig/pipeline/kept_joints.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "rig/joints/figure_name.hpp"
#include "rig/joints/keep_joints.hpp"

namespace curveskel {
namespace {

const BodyPlan& plan_of(const CharacterRig& character, std::size_t figure) {
  const bool is_other = figure > 0 && figure <= character.other_plans.size();
  return is_other ? character.other_plans[figure - 1] : character.plan;
}

/// `first` is the rig's joint that is the plan's first.
void keep_planned(BodyPlan& plan, const std::vector<int>& number, std::size_t first) {
  std::vector<PlannedJoint> kept;
  for (std::size_t k = 0; k < plan.joints.size(); ++k) {
    if (number[first + k] < 0) continue;
    kept.push_back(std::move(plan.joints[k]));
    int& parent = kept.back().parent;
    if (parent >= 0) parent = number[first + idx(parent)] - number[first];
  }
  plan.joints = std::move(kept);
}

}  // namespace

bool is_required(const CharacterRig& character, std::size_t joint) {
  if (joint >= character.rig.roles.size()) return false;
  const FigureName role = of_figure(character.rig.roles[joint]);
  if (plan_of(character, role.figure).plan == BodyKind::humanoid) {
    return std::find(required_human_roles.begin(), required_human_roles.end(), role.own) !=
           required_human_roles.end();
  }
  const std::array<std::string_view, 3> trunk{"spine", "neck", "head"};
  return std::any_of(trunk.begin(), trunk.end(),
                     [&role](std::string_view word) { return role.own.starts_with(word); });
}

void require_planned_joints(const CharacterRig& character, std::string_view purpose) {
  const auto joints = static_cast<std::size_t>(character.rig.joints.rows());
  for (std::size_t figure = 0; figure <= character.other_plans.size(); ++figure) {
    const std::vector<PlannedJoint>& planned = plan_of(character, figure).joints;
    const std::size_t first = figure == 0 ? 0 : first_joint_of(character.rig, figure);
    const auto count = static_cast<int>(planned.size());
    const bool has_parents = std::all_of(planned.begin(), planned.end(), [&](const auto& joint) {
      return joint.parent >= -1 && joint.parent < count;
    });
    if (first + planned.size() <= joints && has_parents) continue;
    throw Error(Fault::input,
                std::string(purpose) + ": found a plan of " + std::to_string(count) +
                    " joints, needed one whose joints are the first of its figure's " +
                    "in the rig, of " + std::to_string(joints) + ", with parents among them");
  }
}

CharacterRig with_joints(CharacterRig character, const std::vector<char>& stays) {
  const std::vector<int> number = numbers_of(stays);
  std::vector<std::size_t> firsts;
  for (std::size_t k = 0; k < character.other_plans.size(); ++k) {
    firsts.push_back(first_joint_of(character.rig, k + 1));
  }
  character.rig = keep_joints(character.rig, number);
  keep_planned(character.plan, number, 0);
  for (std::size_t k = 0; k < character.other_plans.size(); ++k) {
    keep_planned(character.other_plans[k], number, firsts[k]);
  }
  return character;
}

}  // namespace curveskel
