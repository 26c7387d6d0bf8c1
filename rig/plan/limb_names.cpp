#include "rig/plan/limb_names.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/joints/limb_name.hpp"

namespace curveskel {
namespace {

/// "finger_index" of "finger_index_3.L".
std::string without_side_and_number(std::string_view sided) {
  std::string name(without_side(sided));
  std::size_t end = name.size();
  while (end > 0 && std::isdigit(static_cast<unsigned char>(name[end - 1])) != 0) --end;
  const bool is_number =
      end < name.size() && end > 0 && (name[end - 1] == '_' || name[end - 1] == '.');
  if (is_number) name.resize(end - 1);
  return name;
}

std::string word_for(const PlannedJoint& joint, const std::string& readable, BodyKind kind,
                     bool has_side, bool is_bump, bool leads_back) {
  const std::string& role = joint.role;
  const auto is = [&](std::string_view human, std::string_view other) {
    return role.ends_with(human) || role.starts_with(other);
  };
  if (joint.parent < 0 && !has_side && !is_bump) return "tail";
  if ((role == "head" || role == "neck") && has_side) return "ear";
  if (is("Hand", "hand.")) return "finger";
  if (is("Toes", "toe.") || is("Foot", "foot.")) return leads_back ? "heel" : "toe";
  if (role.starts_with("front_toe.") || role.starts_with("front_foot.")) return "front_toe";
  if (kind == BodyKind::bird && role.starts_with("upper_arm.")) return "wing";
  return without_side_and_number(readable);
}

}  // namespace

void name_limbs(Rig& rig, const BodyPlan& plan, const std::vector<std::string>& readable) {
  std::map<std::string, std::map<std::string, int>> numbers;  // by word: of the limbs so far
  std::map<std::string, bool> leads_back;                     // by limb and side
  const std::size_t planned = plan.joints.size();
  for (std::size_t joint = planned; joint < rig.names.size(); ++joint) {
    int above = rig.parents[static_cast<Eigen::Index>(joint)];
    while (above >= static_cast<int>(planned)) above = rig.parents[above];
    if (above < 0) continue;
    LimbName parts = taken_apart(rig.names[joint]);
    const bool is_last = (rig.parents.array() == static_cast<int>(joint)).count() == 0;
    if (parts.rest.empty() && is_last) parts.rest = "_1";  // of a component with one joint
    const double ahead = (rig.joints.row(static_cast<Eigen::Index>(joint)) - rig.joints.row(above))
                             .dot(plan.axes.row(2));
    const bool is_behind = leads_back.emplace(parts.limb + parts.side, ahead < 0).first->second;
    const std::string word =
        word_for(plan.joints[idx(above)], readable[idx(above)], plan.plan, !parts.side.empty(),
                 above == rig.parents[static_cast<Eigen::Index>(joint)] && is_last, is_behind);
    auto& known = numbers[word];
    const int number = known.emplace(parts.limb, static_cast<int>(known.size()) + 1).first->second;
    rig.names[joint] = word + (number > 1 ? std::to_string(number) : "") + parts.rest + parts.side;
  }
}

}  // namespace curveskel
