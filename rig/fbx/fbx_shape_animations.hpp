// The shapes of an FBX file over time. Internal to rig/.
#pragma once

#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/animations/shape_animation.hpp"
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// Parts and shapes as of `read_fbx_looks`; an animation for each stack that moves some, at the
/// keys, where curves bend also 30 times a second between them. A shape that a stack does not move
/// stays on as at rest. Throws Error(Fault::input) for curves without sense. O(shapes times
/// moments).
[[nodiscard]] std::vector<ShapeAnimation> read_fbx_shape_animations(const FileBytes& file,
                                                                    const Monitor& monitor);

}  // namespace curveskel
