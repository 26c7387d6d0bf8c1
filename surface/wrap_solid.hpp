// A wrap that encloses more than its own thickness.
#pragma once

#include <optional>

#include "surface/monitor.hpp"
#include "surface/surface.hpp"

namespace curveskel {

/// Lengths over the extent of the faces that were wrapped.
struct WrappedSolid {
  Surface surface;
  double opening = 0;        ///< the widest gap that the wrap spans
  double distance = 0;       ///< the greatest distance of its vertices to the faces
  double mean_distance = 0;  ///< over its vertices
};

/// Wraps (see `wrap`) with the narrowest of three openings that encloses something: the volume is
/// more than twice the offset times the area, and the wrap has not two sides for most of what it
/// wraps. Nothing if there is none: these are sheets.
[[nodiscard]] std::optional<WrappedSolid> wrap_solid(const Surface& faces, const Monitor& monitor);

}  // namespace curveskel
