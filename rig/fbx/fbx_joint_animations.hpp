// The joints of an FBX file over time. Internal to rig/.
#pragma once

#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/animations/joint_animation.hpp"
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// The joints of `read_joints`, one animation for each stack that moves them or models above them,
/// at the keys and 30 times a second between them. Of several layers the first that moves a number
/// counts, and `notes` says so. Throws Error(Fault::input) for curves without sense. O(models times
/// moments).
[[nodiscard]] AnimatedJoints read_fbx_joint_animations(const FileBytes& file,
                                                       std::vector<std::string>& notes,
                                                       const Monitor& monitor);

}  // namespace curveskel
