// Pictures that are tiled, moved or turned on a material.
#pragma once

#include <array>
#include <cmath>

namespace curveskel {

/// At (u, v) one sees the picture's place (u, v) scaled, then turned about the origin, then
/// shifted.
struct TextureTransform {
  std::array<double, 2> scale{1, 1};
  double turn = 0;  ///< radians, from u to v
  std::array<double, 2> shift{0, 0};

  bool operator==(const TextureTransform&) const = default;
};

/// The same where v counts from the other edge, as in glTF.
[[nodiscard]] inline TextureTransform flipped(const TextureTransform& given) {
  const auto& [scale, turn, shift] = given;
  return {scale,
          turn == 0 ? 0 : -turn,
          {shift[0] - scale[1] * std::sin(turn), 1 - shift[1] - scale[1] * std::cos(turn)}};
}

inline constexpr const char* texture_transform_extension = "KHR_texture_transform";
inline constexpr const char* emissive_strength_extension = "KHR_materials_emissive_strength";

}  // namespace curveskel
