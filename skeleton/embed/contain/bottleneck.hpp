// Curves that do not squeeze past a hollow where there is more room on its other side.
#pragma once

#include <stop_token>

#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/tuning.hpp"
#include "skeleton/embed/working_surface.hpp"

namespace curveskel {

/// An arc that is on no cycle and passes a place half as wide as places before and behind it
/// takes another way between two of its places, if there is one through the surface that costs a
/// third (length in inscribed radii) and is twice as wide where it is narrowest: the neck instead
/// of the cheek, beside a hollow mouth. At least a third of the arc's length stays. The new
/// points may lie outside. Returns the number of ways taken. D = 1. Where such a place
/// is, O(points of the arc x vertices of its groups + n log n).
int reroute_bottlenecks(SkeletonGraph& graph, const WorkingSurface& working,
                        const PartitionGraph& partition, const SurfaceTree& tree,
                        const BottleneckTuning& tuning = {}, const std::stop_token& stop = {});

}  // namespace curveskel
