// Defects of a surface as its file has it.
#pragma once

#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel::viewer {

/// Faces that keep the surface from being a closed oriented 2-manifold, ascending.
struct Defects {
  std::vector<int> open;          ///< with an edge that no other face has: on the boundary
  std::vector<int> non_manifold;  ///< with an edge of three faces or more
  std::vector<int> flipped;       ///< with an edge along which a neighbour runs the same way
  std::vector<int> degenerate;    ///< with a corner twice, or no area
  [[nodiscard]] bool none() const {
    return open.empty() && non_manifold.empty() && flipped.empty() && degenerate.empty();
  }
};

/// O(#F log #F). Vertices at the same place count as one, as in a file of loose triangles.
[[nodiscard]] Defects defects_of(const Surface& surface, const Monitor& monitor = {});

}  // namespace curveskel::viewer
