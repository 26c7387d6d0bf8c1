// From polygons as read to a surface that every later stage may rely on.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/read.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Counts of the changes. `lines` says the same in words, one line per kind of change that
/// happened.
struct Changes {
  std::int64_t unplaced_vertices_dropped = 0;  ///< NaN or infinity in the file
  std::int64_t unplaced_polygons_dropped = 0;  ///< of which such a vertex is a corner
  std::int64_t polygons_triangulated = 0;
  std::int64_t vertices_merged = 0;
  std::int64_t duplicate_faces_dropped = 0;
  std::int64_t degenerate_faces_dropped = 0;
  std::int64_t isolated_vertices_dropped = 0;
  std::int64_t vertices_split_off =
      0;                           ///< copies made of bow-tie vertices, one per further umbrella
  std::int64_t faces_flipped = 0;  ///< to agree with their neighbours
  std::int64_t components_turned = 0;  ///< from inward to outward
  std::vector<std::string> lines;
};

/// Fills `lines` from the counts and says each.
void describe_changes(Changes& changes, const Monitor& monitor);

struct CleanSurface {
  Surface surface;
  Eigen::VectorXi vertex_of_input;  ///< #V of the file; index into surface, -1 = dropped
  int components = 0;
  Changes changes;
};

/// Splits each polygon into triangles by ear clipping in its mean plane; concave polygons come out
/// right, corners keep their order. Returns the triangles in the polygons' order: #corners - 2 for
/// each after leaving out corners that repeat the one before them, and one triangle with a repeated
/// corner for a polygon with one or two. Where it can, it avoids diagonals that are an edge or a
/// diagonal of another polygon too. O(k log k) for a polygon of k corners, O(k^2) at worst. Throws
/// Error(Fault::input) where a corner is no vertex or the offsets skip corners, as `clean` and
/// `repair` do; Cancelled on a stop.
[[nodiscard]] Triangles triangulate(const PolygonSoup& given, const std::stop_token& stop = {});

/// Triangulates, merges coincident vertices (exactly equal positions, and only where that does not
/// make a manifold edge or vertex non-manifold), drops duplicate and degenerate faces and isolated
/// vertices, orients each component consistently and outward.
/// Throws Error(Fault::input) if the result is no closed orientable 2-manifold; the message names
/// the first offending edge by its vertices (0-based, as in the file). `threads` as everywhere: 0 =
/// one per core, the result does not depend on it.
[[nodiscard]] CleanSurface clean(const PolygonSoup& soup, const Monitor& monitor = {},
                                 int threads = 0);

}  // namespace curveskel
