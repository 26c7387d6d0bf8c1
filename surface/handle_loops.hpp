// Closed curves on a surface that tell its handles apart.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/surface.hpp"

namespace curveskel {

/// A basis of the first homology (with coefficients in Z/2) of a closed surface: twice as many
/// loops as it has handles.
struct HandleLoops {
  std::vector<std::array<std::int32_t, 2>> edges;  ///< vertices; those on any loop, each once
  std::vector<std::vector<int>> loops;             ///< the edges of each, in no order
  int components = 0;                              ///< of the surface
};

/// What a spanning tree of the vertices and one of the faces across the other edges leave over
/// closes one loop each through the former (Eppstein 2003). Both are breadth-first.
/// Precondition: closed 2-manifold. O(#F + edges of all loops).
[[nodiscard]] HandleLoops handle_loops(const Surface& surface);

}  // namespace curveskel
