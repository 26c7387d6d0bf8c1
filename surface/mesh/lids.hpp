// The faces that repair put over holes, told from those of the file.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// #F: 1 of the faces that close a hole, those on the left of its rim (`RepairedSurface::rims`), 0
/// of all others. A rim of which an edge is an edge of the surface no more has none. Precondition:
/// closed, oriented surface; rims name its vertices. O(#V + #F).
[[nodiscard]] std::vector<char> faces_in_rims(const Surface& surface,
                                              const std::vector<std::vector<std::int32_t>>& rims);

/// The surface as open as it was given: without these faces. Vertices stay. Empty, without any
/// vertex, where no face closes a hole, or all would. O(#V + #F).
[[nodiscard]] Surface without_lids(const Surface& surface,
                                   const std::vector<std::vector<std::int32_t>>& rims);

}  // namespace curveskel
