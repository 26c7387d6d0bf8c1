// The first step of repair: triangles that share vertices where they meet.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/clean.hpp>
#include <curveskel/read.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// The file's triangles after merging: rows of positions are still the file's vertices.
struct Joined {
  Surface surface;
  std::vector<std::int32_t> merged_into;  ///< #V of the file
};

/// Diagonal of the bounding box of the vertices that faces use, in model units: a stray vertex far
/// away sets no scale. 0 without faces.
[[nodiscard]] double extent_of_faces(const Surface& surface);

/// Triangulates, drops degenerate and repeated faces, merges coincident vertices on the boundary,
/// then those within `distance_of_extent` x the extent. Adds its work to `changes`, and how many
/// were merged at a distance to `vertices_joined`. Nothing says that a manifold comes out.
[[nodiscard]] Joined join_soup(const PolygonSoup& soup, double distance_of_extent, Changes& changes,
                               std::int64_t& vertices_joined);

}  // namespace curveskel
