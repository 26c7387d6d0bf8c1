// The loops of small handles.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>
#include "surface/mesh/half_edges.hpp"

namespace curveskel {

/// The vertices of a closed way along edges, in order.
using EdgeLoop = std::vector<std::int32_t>;

/// Half-edges out of each vertex.
class Stars {
 public:
  /// Refers to both. Precondition: a closed oriented 2-manifold.
  Stars(const Surface& surface, const HalfEdges& pairs);

  [[nodiscard]] std::int32_t from(std::int32_t h) const { return surface_.triangles(h / 3, h % 3); }
  [[nodiscard]] std::int32_t to(std::int32_t h) const { return from(next_half_edge(h)); }
  /// Some half-edge out of the vertex, -1 = it has no face.
  [[nodiscard]] std::int32_t first(std::int32_t vertex) const {
    return out_[static_cast<std::size_t>(vertex)];
  }
  /// The next one out of the same vertex, against the clock as seen from outside.
  [[nodiscard]] std::int32_t turned(std::int32_t h) const {
    return pairs_.twin[static_cast<std::size_t>(previous_half_edge(h))];
  }
  [[nodiscard]] std::int32_t twin(std::int32_t h) const {
    return pairs_.twin[static_cast<std::size_t>(h)];
  }
  /// The one between these two vertices, which an edge joins.
  [[nodiscard]] std::int32_t between(std::int32_t from, std::int32_t to) const;
  [[nodiscard]] double length(std::int32_t h) const;
  [[nodiscard]] std::int32_t half_edges() const {
    return static_cast<std::int32_t>(pairs_.twin.size());
  }
  [[nodiscard]] const Surface& surface() const { return surface_; }

 private:
  const Surface& surface_;
  const HalfEdges& pairs_;
  std::vector<std::int32_t> out_;
};

/// Of a basis of the homology (with coefficients in Z/2) the loops no longer than `longest`,
/// shortest first. The loops are those that leave a tree of shortest ways from one vertex of each
/// component and come back to it by one edge, without the part of their way that they have in
/// common; the basis is the one of the least length among these, found greedily (Erickson and
/// Whittlesey 2005). So a small handle has two loops of its own size here, however far from the
/// root it is. None passes a vertex twice. O(n log n), and for each edge as many steps as edges
/// make `longest`.
[[nodiscard]] std::vector<EdgeLoop> short_loops(const Stars& stars, double longest);

/// True if on either side of the loop the surface within the distance `reach` of it has more area
/// than reach^2, as a tube round which the loop is no longer than `reach` has not: the loop lies
/// round a short neck, not round a wire or in a deep hole. Distances are along edges and do not
/// cross the loop. O(m log m) for m vertices within reach.
[[nodiscard]] bool opens_out(const Stars& stars, const EdgeLoop& loop, double reach);

}  // namespace curveskel
