// The neighbours of every vertex, in their order round it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Per vertex the faces that it is a corner of, as corners 3 f + k: those of vertex v are
/// corner[start[v]] .. corner[start[v + 1] - 1], ascending.
struct CornersByVertex {
  std::vector<std::int64_t> start;  ///< #V + 1
  std::vector<std::int32_t> corner;

  [[nodiscard]] std::span<const std::int32_t> of(std::size_t v) const {
    return {corner.data() + start[v], static_cast<std::size_t>(start[v + 1] - start[v])};
  }
};

/// O(#V + #F).
[[nodiscard]] CornersByVertex corners_by_vertex(const Triangles& triangles, Eigen::Index vertices);

/// Vertex v has the neighbours neighbours[start[v]] .. neighbours[start[v + 1] - 1]: a
/// counter-clockwise cycle, successive ones share a face with v. None where the faces round v are
/// not one closed fan: on a boundary, where the surface is not a manifold, or without faces.
struct OneRings {
  std::vector<std::int64_t> start;  ///< #V + 1
  std::vector<std::int32_t> neighbours;

  [[nodiscard]] std::span<const std::int32_t> of(std::size_t v) const {
    return {neighbours.data() + start[v], static_cast<std::size_t>(start[v + 1] - start[v])};
  }
  [[nodiscard]] std::size_t vertices() const { return start.size() - 1; }
};

/// O(#V + #F).
[[nodiscard]] OneRings one_rings(const Triangles& triangles, Eigen::Index vertices);

}  // namespace curveskel
