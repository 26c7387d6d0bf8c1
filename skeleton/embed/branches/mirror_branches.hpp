// Bodies that are their own mirror images have each branch on both sides.
#pragma once

#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/working_surface.hpp"

namespace curveskel {

/// Adds the mirror image, across the plane through the origin normal to `axis`, of each leaf arc
/// that lacks one: the image of its tip lies farther from the graph than half as far as the tip
/// from the rest of the graph, a face lies between the tip and its image (else both are in one
/// limb), and the image's points keep half of their inscribed radii. An image begins at the node
/// that has the image of the leaf's base in the base's ball, else at the nearest place of an arc,
/// if that is in the ball. Why: which branch is drawn hangs on the triangles, and a limit that one
/// of two ears passes the other may miss.
///
/// Then a junction of leaves becomes one with the next where on the other side, in the image of its
/// ball, there is no junction, but a leaf from the next one's image.
///
/// Precondition: the surface is its own mirror image there (`mirror_planes`). O(leaves * points),
/// and #V projections for each image. Returns the number of changes.
int mirror_branches(SkeletonGraph& graph, int axis, const WorkingSurface& working,
                    const SurfaceTree& tree, const PartitionGraph& partition);

}  // namespace curveskel
