// Drawings: surfaces of which all vertices lie in one plane.
#pragma once

#include <curveskel/read.hpp>

namespace curveskel {

/// True if the corners of all faces lie within 1e-7 of their extent of one plane. False where that
/// plane is not the only one, for no faces, and for positions that are no finite numbers: others
/// refuse those. O(#corners).
[[nodiscard]] bool lies_in_plane(const PolygonSoup& soup);

}  // namespace curveskel
