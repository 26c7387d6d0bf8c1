// One polygon to triangles by ear clipping (Meisters 1975).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// The ends of an edge or diagonal, smaller first, as one number.
[[nodiscard]] inline std::uint64_t edge_key(std::int32_t a, std::int32_t b) {
  const auto [low, high] = std::minmax(a, b);
  return static_cast<std::uint64_t>(low) << 32U | static_cast<std::uint64_t>(high);
}

/// Writes the #corners - 2 triangles of a polygon of at least three corners, in its mean plane.
/// Diagonals in `banned` (keys, sorted) are taken where there is no other ear only. In a degenerate
/// polygon some triangles may have no area or the wrong side up. O(k log k) for k corners as
/// polygons are, O(k^2) at worst. Throws Cancelled on a stop.
void clip_ears(const Positions& positions, std::span<const std::int32_t> corners,
               const std::vector<std::uint64_t>& banned, const std::stop_token& stop,
               std::int32_t* triangle);

}  // namespace curveskel
