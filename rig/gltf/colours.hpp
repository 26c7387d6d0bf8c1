// Colours of vertices.
#pragma once

#include <algorithm>
#include <cmath>

namespace curveskel {

/// The share of light of a value of sRGB (IEC 61966-2-1), both 0..1.
[[nodiscard]] inline float linear_from_srgb(double value) {
  const double within = std::clamp(value, 0.0, 1.0);
  return static_cast<float>(within <= 0.04045 ? within / 12.92
                                              : std::pow((within + 0.055) / 1.055, 2.4));
}

inline constexpr const char* coloured_material = "vertex colours";

}  // namespace curveskel
