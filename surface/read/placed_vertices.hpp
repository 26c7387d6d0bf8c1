// Vertices whose coordinates are NaN or infinity. Internal to surface/.
#pragma once

#include <curveskel/read.hpp>
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// Drops the polygons of vertices that have no place, notes both numbers in the soup, and puts
/// these vertices, which keep their rows, at the first vertex that has one. So positions are finite
/// on return. Throws Error(Fault::input) where more polygons would go than stay.
void drop_unplaced_vertices(PolygonSoup& soup, const FileBytes& file);

}  // namespace curveskel
