// Colours of vertices.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace curveskel {

/// The share of light of a value of sRGB (IEC 61966-2-1), both 0..1.
[[nodiscard]] inline float linear_from_srgb(double value) {
  const double within = std::clamp(value, 0.0, 1.0);
  return static_cast<float>(within <= 0.04045 ? within / 12.92
                                              : std::pow((within + 0.055) / 1.055, 2.4));
}

/// The inverse of `linear_from_srgb`.
[[nodiscard]] inline double srgb_from_linear(double share) {
  const double within = std::clamp(share, 0.0, 1.0);
  return within <= 0.0031308 ? 12.92 * within : 1.055 * std::pow(within, 1 / 2.4) - 0.055;
}

/// A colour of sRGB, its opacity as it is, within 0..1.
[[nodiscard]] inline std::array<float, 4> linear_colour(const std::array<double, 4>& srgb) {
  return {linear_from_srgb(srgb[0]), linear_from_srgb(srgb[1]), linear_from_srgb(srgb[2]),
          static_cast<float>(std::clamp(srgb[3], 0.0, 1.0))};
}

inline constexpr const char* coloured_material = "vertex colours";

}  // namespace curveskel
