// The triangulation of a hole by its corners.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Corner numbers of a triangle, ascending: it turns as the hole's border does.
using HoleTriangle = std::array<std::int32_t, 3>;

/// Triangulates a closed polygon in space with triangles of the Delaunay tetrahedralization of its
/// corners: of all such triangulations the one whose sharpest fold, the faces beyond the border
/// included, is the least, and of those the one with the least area (Liepa 2003, "Filling holes in
/// meshes"). Of several as good as one another, as on a regular polygon, the corners' numbers
/// choose, so that the result depends on nothing but the arguments. Where the Delaunay
/// tetrahedralization lacks an edge of the border, all triangles upon that edge are candidates.
/// CGAL's triangulate_hole searches the same triangles in the order of their cells' addresses, and
/// so fills such a polygon in one way or another.
///
/// @param corners n x 3, in the order of the border
/// @param beyond n x 3: row i is the third corner of the face beyond the edge from corner i to the
///   next
/// @param joined whether an edge outside the hole joins these two corners already, which no new
///   edge may then do
/// @return n - 2 triangles, each after those upon its first two edges (i, j) and (j, k), so that
///   one can add them one by one to the border; none where the candidates hold no triangulation
/// @throws Cancelled when a stop was requested
/// O(n log n) for corners on a smooth curve or in a plane, O(n^3) time and O(n^2) memory at worst.
[[nodiscard]] std::vector<HoleTriangle> triangulate_hole(
    const Positions& corners, const Positions& beyond,
    const std::function<bool(std::int32_t, std::int32_t)>& joined, const std::stop_token& stop);

}  // namespace curveskel
