// The moments at which animations are written in another way than they were made. Internal to rig/.
#pragma once

#include <vector>

namespace curveskel {

/// Seconds before a step at which its curve still has the value before it.
inline constexpr double step_seconds = 1e-4;

/// Sorted, each once.
[[nodiscard]] std::vector<double> sorted_moments(std::vector<double> keys);

/// The same, and as many moments between two as make 30 a second, but no more than a thousand.
[[nodiscard]] std::vector<double> moments_between(std::vector<double> keys);

}  // namespace curveskel
