// The place of a network that each vertex of the surface belongs to.
#pragma once

#include <cstddef>
#include <vector>

#include "skeleton/circles.hpp"
#include "skeleton/network.hpp"
#include "surface/inscribed_balls.hpp"
#include "surface/surface.hpp"

namespace curveskel {

struct Host {
  int strand = -1;
  std::size_t segment = 0;  ///< along the strand's polyline
  Point place = Point::Zero();
};

/// Per vertex the place that is nearest to its inscribed ball's centre, of the strands that its
/// group belongs to: that of the group itself, or all at its hub. A ball that does not touch the
/// vertex is one of its neighbours'; the vertex itself stands for it then. Precondition: the balls
/// and the graph are the surface's. O(#V x points of these strands).
[[nodiscard]] std::vector<Host> hosts_of_vertices(const Network& network, const Surface& surface,
                                                  const InscribedBalls& balls,
                                                  const VertexGraph& graph);

}  // namespace curveskel
