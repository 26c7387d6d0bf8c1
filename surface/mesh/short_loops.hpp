// The loops of small handles.
#pragma once

#include <cstdint>
#include <stop_token>
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

/// Loops no longer than `longest` that do not part the surface, the shortest first: at each vertex
/// of a basis of the homology the shortest loop through it, if it is as short, with coefficients in
/// Z/2. Each loop that does not part the surface meets such a vertex. None passes a vertex twice;
/// the same loop may be there several times. The basis has the loops that leave a tree of shortest
/// ways and come back to it by one edge (Eppstein 2003), the shortest first, without the part that
/// both ways have in common, so that those of a small handle are of its own size. A loop that parts
/// nothing is known by the sum of its edges' classes (Busaryev, Cabello, Chen, Dey and Wang 2012),
/// of which 64 random bits are kept: a wrong answer has a chance of 2^-64. O(n log n), and the
/// vertices within half of `longest` of each of the basis.
[[nodiscard]] std::vector<EdgeLoop> short_loops(const Stars& stars, double longest,
                                                const std::stop_token& stop);

[[nodiscard]] double length_of(const Stars& stars, const EdgeLoop& loop);

/// True if on either side of the loop, at some distance d from it between its length l and `reach`,
/// the surface as near as that has more area than 2 l d, twice that of a tube round which the loop
/// leads: the loop lies round a short neck, not round a wire or in a deep hole. Distances are along
/// edges and do not cross the loop. O(m log m) for m vertices within reach.
[[nodiscard]] bool opens_out(const Stars& stars, const EdgeLoop& loop, double reach);

}  // namespace curveskel
