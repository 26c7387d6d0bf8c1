// A wrap that encloses more than its own thickness.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>
#include "surface/repair/wrap.hpp"

namespace curveskel {

/// Lengths over the extent of the faces that were wrapped.
struct WrappedSolid {
  Surface surface;
  double gap = 0;            ///< the widest gap that the wrap spans
  double offset = 0;         ///< how far it stays away where it spans nothing
  double distance = 0;       ///< the greatest to the faces, of its vertices and triangles' middles
  double mean_distance = 0;  ///< of its triangles' middles, by area
  double followed = 0;       ///< share of its area that lies within D / 100 of the faces
};

/// From narrow to wide, of the extent. The narrower, the more is seen of the surface, and the less
/// is spanned.
inline constexpr std::array wrap_gaps{1.0 / 100, 1.0 / 40, 1.0 / 15};

/// For each wrap whose gap the program chooses: some seconds' work.
inline constexpr WrapBudget budget_of_needed_wraps{10000};
inline constexpr WrapBudget budget_of_wanted_wraps{100000};  ///< that are asked for, all the same

/// For each wrap of one of several components.
[[nodiscard]] inline WrapBudget budget_for_one(std::size_t components) {
  return {budget_of_needed_wraps.vertices / static_cast<std::int64_t>(components)};
}

/// Of a wrap with this gap, of the extent: see WrapBudget.
[[nodiscard]] double vertices_for_expected(const Surface& wrapped, const Surface& faces,
                                           double gap);

/// Wraps (see `wrap`) with this gap, of the extent, or, for 0, with the narrowest of `wrap_gaps`
/// that encloses something and whose vertices the budget allows: the volume is more than twice the
/// offset times the area, and the wrap has not two sides for most of what it wraps. Nothing if none
/// does: these are sheets. The budget is for each wrap. Throws what `wrap` throws, for the widest.
[[nodiscard]] std::optional<WrappedSolid> wrap_solid(const Surface& faces, double gap,
                                                     const WrapBudget& budget,
                                                     const Monitor& monitor);

}  // namespace curveskel
