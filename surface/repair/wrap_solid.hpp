// A wrap that encloses more than its own thickness.
#pragma once

#include <array>
#include <optional>

#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Lengths over the extent of the faces that were wrapped.
struct WrappedSolid {
  Surface surface;
  double gap = 0;            ///< the widest gap that the wrap spans
  double offset = 0;         ///< how far it stays away where it spans nothing
  double distance = 0;       ///< the greatest to the faces, of its vertices and triangles' middles
  double mean_distance = 0;  ///< of its triangles' middles, by area
};

/// From narrow to wide, of the extent. The narrower, the more is seen of the surface, and the less
/// is spanned.
inline constexpr std::array wrap_gaps{1.0 / 100, 1.0 / 40, 1.0 / 15};

/// Wraps (see `wrap`) with this gap, of the extent, or, for 0, with the narrowest of
/// `wrap_gaps` that encloses something: the volume is more than twice the offset times the
/// area, and the wrap has not two sides for most of what it wraps. Nothing if none does: these are
/// sheets. Throws what `wrap` throws.
[[nodiscard]] std::optional<WrappedSolid> wrap_solid(const Surface& faces, double gap,
                                                     const Monitor& monitor);

}  // namespace curveskel
