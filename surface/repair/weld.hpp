// Making one surface out of a polygon soup: vertices that coincide become one, repeated faces go.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Drops faces with a repeated corner and returns how many. Faces without area stay: dropping them
/// would open the surface. O(#F).
std::int64_t drop_degenerate_faces(Triangles& triangles);

/// Of the faces with the same three vertices, oriented either way, keeps the first; returns how
/// many went. In a closed manifold two such faces could only be a component of their own without
/// any volume. O(#V + #F) for bounded valence.
std::int64_t drop_duplicate_faces(Triangles& triangles, std::int32_t vertices);

/// For each vertex the first one at exactly the same position; only vertices marked in `among`
/// count, the others stay themselves. O(#V) unless many coincide, O(#V log #V) at worst.
[[nodiscard]] std::vector<std::int32_t> coincident_vertices(const Positions& positions,
                                                            const std::vector<bool>& among);

/// For each vertex the first one before it that lies within `distance` (model units) and stands for
/// itself; only vertices marked in `among` count, the others stay themselves. O(#V) unless many lie
/// within 32 times as much: little over one look-up a vertex.
[[nodiscard]] std::vector<std::int32_t> nearby_vertices(const Positions& positions,
                                                        const std::vector<bool>& among,
                                                        double distance);

/// Drops the vertices without a face, keeps the order of the others. Returns the new index of each,
/// -1 = dropped. O(#V + #F).
std::vector<std::int32_t> drop_unused_vertices(Surface& surface);

}  // namespace curveskel
