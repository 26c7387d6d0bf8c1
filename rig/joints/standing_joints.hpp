// The joints of a human of whom limbs are hidden.
#pragma once

#include <vector>

#include <curveskel/advanced/joints.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Those of the plan, and one more at the end of each last bone (named ".._end", it moves nothing):
/// at its `end`, or straight on, up to the surface. The curve has no others, and of each node the
/// joint of the nearest bone moves it: where limbs are hidden, it runs through folds of clothes.
/// Precondition: at least one joint. O(#F log #F + nodes * joints).
[[nodiscard]] Joints standing_joints(const Surface& surface, const CurveSkeleton& skeleton,
                                     const std::vector<PlannedJoint>& planned, int threads);

}  // namespace curveskel
