// Branches that the surgery did not make, and limbs that it left short.
#pragma once

#include <stop_token>

#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/tuning.hpp"
#include "skeleton/embed/working_surface.hpp"

namespace curveskel {

/// Gives a branch to each part of the surface that the graph does not enter and that sticks out:
/// from the place of the graph nearest to the part's apex, or the junction next to that, the
/// prominence (see ProminenceSweep) is at least `limit` and the apex 1.5 inscribed radii away.
/// From a tip the arc goes on to the apex instead, from 1.5 and 2 inscribed radii on. The
/// inscribed ball at the apex must have at least 0.12 of the radius where the branch begins (from
/// a tip 0.25), or it is a crease, and less than 1.2 of it. A part with fewer than 8 vertices where
/// it is measured may be noise. The branch ends where the part's cap has its middle, not in the
/// corner that the apex of a blunt end is. The new points may lie outside.
/// `partition` is the source of the SkeletonGraph, `tree` the surface's. Returns their number.
int grow_branches(SkeletonGraph& graph, const WorkingSurface& working, const SurfaceTree& tree,
                  const PartitionGraph& partition, double limit, const GrowthTuning& tuning = {},
                  const std::stop_token& stop = {}, int threads = 1);

}  // namespace curveskel
