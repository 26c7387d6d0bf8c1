// The animations of a file's own joints. Internal to rig/.
#pragma once

#include <curveskel/monitor.hpp>
#include "rig/animations/joint_animation.hpp"
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// Of FBX and COLLADA; joints are those of `read_joints`. Throws Error(Fault::input) for what makes
/// no sense.
[[nodiscard]] AnimatedJoints read_joint_animations(const FileBytes& file, const Monitor& monitor);

struct FileJoints {
  int joints = 0;
  int channels = 0;  ///< that move them, of all animations
};

/// Of FBX and COLLADA; none in other files. O(bytes).
[[nodiscard]] FileJoints count_joints(const FileBytes& file, const Monitor& monitor);

}  // namespace curveskel
