// The first step of repair: triangles that share vertices where they meet.
#pragma once

#include <cstdint>
#include <stop_token>
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

struct JoinOptions {
  double distance_of_extent = 0;
  double least_area = 0;  ///< parts of less, of the largest, set no scale
  std::stop_token stop;
};

/// The work of `join_soup` beyond `Changes`.
struct JoinCounts {
  std::int64_t vertices_joined = 0;  ///< merged at a distance
  std::int64_t edges_split = 0;      ///< on the boundary, at vertices that lie on them
};

/// Drops repeated polygons, triangulates, drops degenerate and repeated faces, merges coincident
/// vertices on the boundary, then those within `distance_of_extent` x the extent (of the parts that
/// are no specks; no more than a quarter of the median boundary edge), and splits boundary edges at
/// boundary vertices that lie within that distance of them. Adds its work to `changes` and
/// `counts`. Nothing says that a manifold comes out. Throws Cancelled on a stop.
[[nodiscard]] Joined join_soup(const PolygonSoup& soup, const JoinOptions& options,
                               Changes& changes, JoinCounts& counts);

}  // namespace curveskel
