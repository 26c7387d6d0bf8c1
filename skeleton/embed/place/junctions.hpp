// Junctions: where they lie, which of them are one, how arcs leave them.
#pragma once

#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {

/// Moves each junction away from the nearest surface as long as that widens its inscribed ball, by
/// one radius at most.
void centre_junctions(SkeletonGraph& graph, const SurfaceTree& tree);

/// Junctions whose arc is shorter than `factor` x the larger of their inscribed radii become one,
/// at the larger ball, the nearest first. No cycle leaves its handle.
void merge_junctions(SkeletonGraph& graph, const SurfaceTree& tree, HomologyGuard& guard,
                     double factor);

/// Drops the points of each arc that lie within `share` of the ball of its junction, so that it
/// leaves straight; all of them where the balls of both ends reach so far. Where the arc is
/// `covered` by balls that overlap, it stays so.
void straighten_at_junctions(SkeletonGraph& graph, const SurfaceTree& tree, double share,
                             bool covered);

}  // namespace curveskel
