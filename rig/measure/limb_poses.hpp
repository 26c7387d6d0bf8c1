// The same limbs turned by two rigs of one surface.
#pragma once

#include <curveskel/compare_rigs.hpp>
#include <curveskel/monitor.hpp>

namespace curveskel {

/// Both rigs have the same vertices, those of `truth.surface`; `size` is L.
[[nodiscard]] PoseDistance compare_poses(const Rig& rig, const RiggedSurface& truth, double size,
                                         const Monitor& monitor);

}  // namespace curveskel
