// The unit of time in FBX.
#pragma once

namespace curveskel {

inline constexpr double fbx_ticks_a_second = 46186158000;

}  // namespace curveskel
