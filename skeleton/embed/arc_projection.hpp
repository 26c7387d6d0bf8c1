// The place of a graph that each vertex of the surface belongs to.
#pragma once

#include <cstddef>
#include <vector>

#include <curveskel/advanced/surface_partition.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/working_surface.hpp"

namespace curveskel {

struct ArcProjection {
  int arc = -1;
  std::size_t segment = 0;  ///< along the arc's polyline
  Point place = Point::Zero();
};

/// Per vertex the place that is nearest to its inscribed ball's centre, of the arcs that its
/// group belongs to: that of the group itself, or all at its node. A ball that does not touch the
/// vertex is one of its neighbours'; the vertex itself stands for it then. Precondition: the
/// partition is the surface's. O(#V x points of these arcs).
[[nodiscard]] std::vector<ArcProjection> project_on_arcs(const SkeletonGraph& graph,
                                                         const WorkingSurface& working,
                                                         const PartitionGraph& partition,
                                                         int threads);

/// The groups whose vertices are projected onto one of the arcs, ascending.
[[nodiscard]] std::vector<int> groups_on(const std::vector<int>& arcs,
                                         const std::vector<ArcProjection>& projections,
                                         const PartitionGraph& partition);

}  // namespace curveskel
