// Closed curves on a surface that tell its handles apart.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// A basis of the first homology (with coefficients in Z/2) of a closed surface: twice as many
/// loops as it has handles.
struct HandleLoops {
  std::vector<std::array<std::int32_t, 2>> edges;  ///< vertices; those on any loop, each once
  std::vector<std::vector<int>> loops;             ///< the edges of each, in no order
  int components = 0;                              ///< of the surface
};

/// Spanning trees of the vertices and, across the other edges, of the faces leave some edges over.
/// Each of these closes one loop through the former (Eppstein 2003). Both are breadth-first.
/// Precondition: closed oriented 2-manifold; throws Error(Fault::input) for faces that are none,
/// where there are handles. O(#F + edges of all loops).
[[nodiscard]] HandleLoops handle_loops(const Surface& surface);

}  // namespace curveskel
