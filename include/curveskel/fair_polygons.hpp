// Fairing of what a file holds, closed or not.
#pragma once

#include <curveskel/fair.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/read.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// `fair` of the file's own vertices, in triangles. A closed surface is faired as one, seams or
/// not. Any other is faired as it is in the file: its boundaries and seams stay where they are, and
/// a note says so. Errors as `fair`.
[[nodiscard]] Surface fair_polygons(const PolygonSoup& soup, const FairOptions& options = {},
                                    const Monitor& monitor = {});

}  // namespace curveskel
