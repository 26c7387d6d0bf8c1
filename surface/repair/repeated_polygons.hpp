// Polygons that a file has twice.
#pragma once

#include <cstdint>
#include <optional>

#include <curveskel/read.hpp>

namespace curveskel {

/// Without the polygons of more than three corners that have the corners of one before them, in the
/// same or the opposite order, wherever each begins: their triangles might take other diagonals,
/// and would not be known as repeats. Nothing if there are none. `triangles` counts the triangles
/// of those that went. O(#corners + p log p) for p polygons of more than three corners.
[[nodiscard]] std::optional<PolygonSoup> without_repeated_polygons(const PolygonSoup& soup,
                                                                   std::int64_t& triangles);

}  // namespace curveskel
