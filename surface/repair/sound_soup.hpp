// Polygons whose numbers are numbers of their own vertices, checked where they enter.
#pragma once

#include <curveskel/read.hpp>

namespace curveskel {

/// Throws Error(Fault::input) that names the first at fault unless every corner is a vertex and the
/// offsets lead through all corners. One pass over the arrays.
void require_sound(const PolygonSoup& soup);

}  // namespace curveskel
