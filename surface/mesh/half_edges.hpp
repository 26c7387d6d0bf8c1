// Faces that share an edge; orientation is not assumed, so that it can be judged.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Half-edge h = 3 f + k runs from corner k of face f to its next corner.
struct HalfEdges {
  std::vector<std::int32_t> twin;  ///< 3 #F; the other half-edge of an edge with exactly two faces,
                                   ///< -1 at any other edge
  std::int64_t boundary_edges = 0;       ///< with one face
  std::int64_t crowded_edges = 0;        ///< with three or more
  std::int32_t first_unpaired = -1;      ///< lowest half-edge without a twin, -1 = none
  std::int32_t faces_at_first = 0;       ///< faces at that one's edge
  std::vector<bool> vertex_on_boundary;  ///< #V, whether it ends an edge with one face
};

/// O(#V + #F) for bounded valence. Precondition: no face has a repeated corner, 3 #F < 2^31.
[[nodiscard]] HalfEdges pair_half_edges(const Triangles& triangles, std::int32_t vertices);

inline std::int32_t next_half_edge(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline std::int32_t previous_half_edge(std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

}  // namespace curveskel
