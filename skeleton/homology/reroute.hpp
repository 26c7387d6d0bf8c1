// Cycles that go round the handles, where straight lines between a partition's nodes do not.
#pragma once

#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/surface.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/working_surface.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {

/// Leads the arcs on cycles along the surface itself, group by group and cut curve by cut curve,
/// through its vertices' inscribed balls, after those along tunnels have become rings round them.
///
/// An arc whose cut curves bound no disc inside runs along a tunnel, and its cycle goes round no
/// handle of the inside; but the cut curve does. The cut curves of the arcs that a spanning tree
/// leaves over span a Lagrangian subspace of the surface's homology. Of those that do not vanish
/// inside a basis becomes rings; the other cycles are dual to discs, so all together are as many
/// independent cycles inside as the surface has handles. Precondition: the graph is as
/// `skeleton_graph_of` made it, or `cut_pockets` left it.
void reroute_around_handles(SkeletonGraph& graph, const WorkingSurface& working,
                            const SurfaceTree& tree, const PartitionGraph& partition,
                            HomologyGuard& guard);

}  // namespace curveskel
