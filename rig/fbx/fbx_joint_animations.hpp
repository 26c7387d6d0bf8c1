// The joints of an FBX file over time. Internal to rig/.
#pragma once

#include <curveskel/monitor.hpp>
#include "rig/animations/joint_animation.hpp"
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// The joints of `read_joints`, one animation for each stack that moves them or models above them,
/// at the keys and 30 times a second between them. Throws Error(Fault::input) for curves without
/// sense. O(models times moments).
[[nodiscard]] AnimatedJoints read_fbx_joint_animations(const FileBytes& file,
                                                       const Monitor& monitor);

}  // namespace curveskel
