// The ground on which a planned figure stands.
#pragma once

#include <vector>

#include <curveskel/body_plan.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// The nodes of floors, slabs and pedestals, which would else be toes of the figure: of components
/// of the curve without a planned joint, whose surface reaches beyond that of the components with
/// one to the front, back, left and right, and ends below its middle. None where the skeleton has
/// no node_of_vertex, or the plan no joints. O(#V + #N + planned joints).
[[nodiscard]] std::vector<int> ground_nodes(const Surface& surface, const CurveSkeleton& skeleton,
                                            const BodyPlan& plan);

}  // namespace curveskel
