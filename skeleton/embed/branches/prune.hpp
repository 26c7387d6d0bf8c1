// Pruning of branches that stand for no limb.
#pragma once

#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/working_surface.hpp"

namespace curveskel {

/// Prunes leaf arcs whose prominence (see ProminenceSweep), from the vertex of theirs that is
/// farthest from the junction towards it, is below the limit, least first, as long as something is
/// left; those that nowhere stick out before all others, least area first.
/// `partition` is the source of the SkeletonGraph.
void prune_blunt(SkeletonGraph& graph, const WorkingSurface& working,
                 const PartitionGraph& partition, double limit);

/// Prunes leaf arcs shorter than `factor` x the inscribed radius at their junction, shortest
/// ratio first. Returns whether any was.
bool prune_spurs(SkeletonGraph& graph, const SurfaceTree& tree, double factor);

}  // namespace curveskel
