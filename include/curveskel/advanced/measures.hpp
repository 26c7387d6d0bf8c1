// Area, volume, extent, normals.
#pragma once

#include <Eigen/Core>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Sum of the triangles' areas, in square model units.
[[nodiscard]] double area(const Surface& surface);

/// Signed volume, in cubic model units; positive when outward. Taken relative to the first vertex,
/// so a far-off origin costs no digits.
[[nodiscard]] double volume(const Surface& surface);

/// Length of the bounding box's diagonal (D), in model units.
[[nodiscard]] double bounding_box_diagonal(const Positions& positions);

/// #V by 3 outward unit normals, each the angle-weighted mean of its faces' (Baerentzen and Aanaes
/// 2005); (0, 0, 0) at a vertex whose faces all have zero area.
[[nodiscard]] Positions vertex_normals(const Surface& surface);

}  // namespace curveskel
