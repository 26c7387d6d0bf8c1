// Which of somebody's joints moves which part of a curve skeleton.
#pragma once

#include <Eigen/Core>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/rig.hpp>

namespace curveskel {

/// Of each node the joint at the upper end of the nearest bone, or the one at its lower end where
/// the node lies beyond it; of bones as near the last in the hierarchy. A bone leads from a joint
/// to each of its children. One that lies outside of the body (from a root on the ground to the
/// hips) for more than half of its length moves nothing, unless all do. Precondition: parents
/// before their children. O(nodes times joints).
[[nodiscard]] Eigen::VectorXi joints_of_nodes(const CurveSkeleton& skeleton, const Rig& given);

}  // namespace curveskel
