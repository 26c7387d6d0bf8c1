// Legs of a human in a pose, each as it lies. Internal to rig/.
#pragma once

#include <vector>

#include "rig/plan/curve_tree.hpp"

namespace curveskel {

/// Vertices of the surface about one side's limb and all that hangs from it; a right one's are
/// mirrored.
[[nodiscard]] std::vector<Eigen::Vector3d> surface_of_side(const CurveTree& tree,
                                                           const Limbs& limbs, const LimbWay& way,
                                                           bool is_left);

/// The ankle's place along a leg's course, as a share of it, the mean of both sides: as high above
/// the sole as that of one who stands, with the shin for what is upright and the way along the leg
/// for the height of its hip, which is at share `hip` of the course. `tree` is that of the pose.
[[nodiscard]] double ankle_in_pose(const CurveTree& tree, const Limbs& limbs, const LimbWay& way,
                                   double hip);

}  // namespace curveskel
