// From triangles that share edges anyhow to closed 2-manifolds: cut, stitched, holes filled.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct ClosedParts {
  Surface surface;  ///< every edge has two faces, neighbours agree; components may lie inward
  std::vector<std::int32_t> vertex_given;  ///< #V; where each comes from, -1 = added in a hole
  std::vector<std::int32_t> face_given;    ///< #F; where each comes from, -1 = closes a hole
  std::vector<std::vector<std::int32_t>> holes;  ///< the vertices round each hole that was closed,
                                                 ///< in order, what closes it on the left
  std::int64_t holes_narrowed = 0;               ///< of those, by rings since they were too long
  std::int64_t vertices_copied = 0;              ///< where the given faces met in no 2-manifold
};

/// A longer hole is narrowed before it is triangulated: the search among triangulations takes time
/// that grows with the cube of its edges at worst, and memory with their square.
inline constexpr std::int64_t most_edges_without_rings = 500;
/// Of a hole that no triangles of the Delaunay tetrahedralization fill, so that all are searched:
/// 0.3 s, where 500 edges take 10.
inline constexpr std::int64_t most_edges_without_delaunay = 150;

/// Cuts the triangles apart along edges with three faces or more, at vertices with several
/// umbrellas and where a one-sided surface cannot be oriented; stitches again what matches two by
/// two, first within a component; fills each hole with triangles about as large as those around it
/// (Liepa 2003), a long one after rings of triangles, each ring with half as many edges as the one
/// before. Positions of the given vertices stay. Precondition: no face with a repeated
/// corner, no two faces with the same vertices. O(#F log #F) and, per hole of k edges, O(k^3) at
/// worst for k <= 500, O(k) beyond.
[[nodiscard]] ClosedParts close_surface(const Surface& given, const Monitor& monitor);

}  // namespace curveskel
