// The joints of a COLLADA file over time. Internal to rig/.
#pragma once

#include <curveskel/monitor.hpp>
#include "rig/animations/joint_animation.hpp"
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// The joints of `read_joints`: an animation for each <animation_clip>, from its start on, in a
/// file without clips one of all channels. At the keys, and between them, unless whole matrices are
/// all that moves, 30 times a second. Throws Error(Fault::input) with the line. O(nodes times
/// moments).
[[nodiscard]] AnimatedJoints read_dae_joint_animations(const FileBytes& file,
                                                       const Monitor& monitor);

}  // namespace curveskel
