// Boundary edges cut where vertices of another boundary lie on them.
#pragma once

#include <cstdint>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Splits each edge with one face at the vertices of such edges that lie within `distance` (model
/// units) of it and farther from its ends, and the face with it, so that rims that coincide but
/// have different vertices share theirs. Positions stay. Returns how many edges were split.
/// O(n log^3 n + k) for n boundary edges and k vertices in their boxes. Precondition: no face has a
/// repeated corner.
std::int64_t split_edges_at_vertices(Surface& surface, double distance);

}  // namespace curveskel
