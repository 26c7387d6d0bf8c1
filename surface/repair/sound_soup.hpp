// Polygons whose numbers are numbers of their own vertices, checked where they enter.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <curveskel/read.hpp>

namespace curveskel {

/// Throws Error(Fault::input) that names the first at fault unless every corner is a vertex and the
/// offsets lead through all corners. One pass over the arrays.
void require_sound(const PolygonSoup& soup);

/// Throws Error(Fault::input) of PolygonSoup{}, which has not even the first offset. O(1).
void require_polygons(const PolygonSoup& soup);

/// As the first, of polygons alone, with so many vertices; the message begins with `purpose`.
void require_sound_polygons(Eigen::Index vertices, const std::vector<std::int32_t>& all_corners,
                            const std::vector<std::int64_t>& offsets, std::string_view purpose);

}  // namespace curveskel
