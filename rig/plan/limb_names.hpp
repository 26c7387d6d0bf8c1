// Names of the joints that no plan asks for, by the joint of the plan that they hang from.
#pragma once

#include <string>
#include <vector>

#include <curveskel/body_plan.hpp>
#include <curveskel/rig.hpp>

namespace curveskel {

/// tail_1, ear_end.L, toe2_1.R: the limb's word, its number from the second limb of that word on,
/// the rest of its name so far (`place_joints`, `name_sides`). `readable` are the readable names of
/// the plan's joints, which are the rig's first.
void name_limbs(Rig& rig, const BodyPlan& plan, const std::vector<std::string>& readable);

}  // namespace curveskel
