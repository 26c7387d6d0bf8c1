// Leaves that lead into a hollow, such as the lining of a mouth.
#pragma once

#include <curveskel/advanced/surface_partition.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/working_surface.hpp"

namespace curveskel {

/// Contraction pulls the lining of a hollow through the rim and back along the limb, so that a leaf
/// turns at the rim and ends at the hollow's bottom. Cuts each such leaf back to the rim: there the
/// volume between the surface beyond and the cut curve is least, and negative, as the lining shows
/// its front to the middle. Only hollows as prominent (height over the boundary's mean radius) as
/// a limb must be are cut off, and only if what stays of the leaf, or another arc at its junction,
/// passes the bottom at less than the hollow's depth. No arc with two tips goes whole. All that is
/// cut off belongs to the new tip, or to the node at which a leaf that was all hollow hung; that
/// node stays where two arcs are left, so that along each arc groups and cut curves still take
/// turns. `graph` is as `skeleton_graph_of` made it of `partition`. O(#V), and for each hollow
/// O(the points of the arcs at its junction).
void cut_pockets(SkeletonGraph& graph, const WorkingSurface& working,
                 const PartitionGraph& partition, double limit);

}  // namespace curveskel
