// Fairing of what a file holds, closed or not.
#pragma once

#include <curveskel/fair.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/read.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// `fair` of the file's own vertices, in triangles. Seams, where vertices of the boundary coincide,
/// are faired as if there were none. The boundaries of a surface that is not closed stay where they
/// are, and a note says so. Errors as `fair`.
[[nodiscard]] Surface fair_polygons(const PolygonSoup& soup, const FairOptions& options = {},
                                    const Monitor& monitor = {});

}  // namespace curveskel
