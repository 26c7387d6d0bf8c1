// The axes of joints.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include <curveskel/rig.hpp>

namespace curveskel {

/// Each joint's rotation at rest, in the model's frame: its y axis points along its bone, as
/// Blender's do, at a tip straight on; to an only child; of several to the one that is most
/// straight on and longest, with all that hangs from it (cos of the turn + 0.65 share of the
/// longest; of equals the first). A joint without a side (".L", ".R" of its readable name) points
/// to children without one, else to the middle of a pair: a chest to the neck, not to an arm. Its
/// parent's axes, turned by the least angle, so that limbs that mirror each other are turned
/// alike. O(joints), and of a joint's children those of the left times those of the right.
[[nodiscard]] std::vector<Eigen::Quaterniond> bone_axes(const Rig& rig);

}  // namespace curveskel
