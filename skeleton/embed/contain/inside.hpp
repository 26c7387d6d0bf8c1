// A skeleton that never leaves its surface.
#pragma once

#include <stop_token>

#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/working_surface.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {

struct InsideOptions {
  const Surface* below =
      nullptr;                  ///< the surface of the tree, to go below where nothing else leads
  bool all_or_nothing = false;  ///< ends with the first arc that has an edge not covered
  std::stop_token stop = {};
};

/// Moves and adds points until the inscribed balls of the ends of every edge overlap: then the
/// whole edge lies in two balls that lie inside the surface, and no sampling is needed to know it.
///
/// Points outside, and midpoints of edges that are not covered, go to the centre of the inscribed
/// ball at the nearest surface point. If that does not close the gap, the arc follows the
/// cheapest chain of the vertices' own inscribed balls through the arc's part of the surface, or
/// goes along just below the surface from one ball to the next. An edge whose ends are inside and
/// that meets no triangle counts as covered, too.
/// An arc for which that leads outside, too, goes just below the surface, if it is given, see
/// WaysBelow.
/// An arc that needs more than four such ways takes a single one from node to node instead.
/// Changes that would lead an arc on a cycle off its handle are left out. Returns the number of
/// edges that are still not covered. Precondition: D = 1. Throws Cancelled if a stop was requested.
int keep_inside(SkeletonGraph& graph, const WorkingSurface& working,
                const PartitionGraph& partition, const SurfaceTree& tree, HomologyGuard& handles,
                const InsideOptions& options = {});

}  // namespace curveskel
