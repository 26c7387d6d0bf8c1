// Which way joints are turned.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "rig/rig.hpp"

namespace curveskel {

/// Each joint's rotation at rest, in the model's frame: its y axis points along its bone, as
/// Blender's do, that is, to the child that most joints hang from (of equals the first), at a tip
/// straight on. Its parent's axes, turned by the least angle, so that limbs that mirror each other
/// are turned alike. O(joints).
[[nodiscard]] std::vector<Eigen::Quaterniond> bone_axes(const Rig& rig);

}  // namespace curveskel
