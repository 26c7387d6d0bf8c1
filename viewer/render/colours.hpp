// Colours: maps for numbers, a palette for names.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include <curveskel/advanced/names.hpp>

namespace curveskel::viewer {

/// sRGB with alpha, each 0..255.
using Rgba = std::array<std::uint8_t, 4>;

[[nodiscard]] Rgba rgba(const glm::vec3& colour, float alpha = 1);

enum class ColourMap { viridis, magma, cividis };

inline constexpr NameTable<ColourMap, 3> colour_maps{{
    {ColourMap::viridis, "viridis", "dark blue to yellow"},
    {ColourMap::magma, "magma", "black over purple to cream"},
    {ColourMap::cividis, "cividis", "blue to yellow, safe for colour-blind eyes"},
}};

/// Perceptually uniform; `value` is clamped to 0..1, NaN is grey.
[[nodiscard]] glm::vec3 mapped(ColourMap map, float value);

/// `branch_colour` for any numbered things.
[[nodiscard]] glm::vec3 category(std::size_t number);

}  // namespace curveskel::viewer
