// The place of a graph that each vertex of the surface belongs to.
#pragma once

#include <cstddef>
#include <vector>

#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/surface.hpp>
#include "skeleton/embed/skeleton_graph.hpp"

namespace curveskel {

struct ArcProjection {
  int arc = -1;
  std::size_t segment = 0;  ///< along the arc's polyline
  Point place = Point::Zero();
};

/// Per vertex the place that is nearest to its inscribed ball's centre, of the arcs that its
/// group belongs to: that of the group itself, or all at its node. A ball that does not touch the
/// vertex is one of its neighbours'; the vertex itself stands for it then. Precondition: the balls
/// and the partition are the surface's. O(#V x points of these arcs).
[[nodiscard]] std::vector<ArcProjection> project_on_arcs(const SkeletonGraph& graph,
                                                         const Surface& surface,
                                                         const InscribedBalls& balls,
                                                         const PartitionGraph& partition);

}  // namespace curveskel
