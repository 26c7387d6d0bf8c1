// Bodies that are their own mirror images: their curves are so, too.
#pragma once

#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/surface.hpp>
#include "skeleton/embed/skeleton_graph.hpp"

namespace curveskel {

/// Through the origin, normal to an axis.
struct MirrorPlane {
  int axis;    ///< 0, 1, 2
  bool exact;  ///< the image of every vertex lies on the surface
};

/// The planes across which a surface is its own mirror image: the images of nine in ten vertices
/// lie within `tolerance` of the surface. In canonical form these planes are normal to the
/// principal axes, in which every mirror plane of a body lies unless two of its moments are equal.
/// Precondition: `tree` is over the surface. #V queries for each plane that is found, fewer for the
/// others.
[[nodiscard]] std::vector<MirrorPlane> mirror_planes(const Surface& surface,
                                                     const SurfaceTree& tree, double tolerance,
                                                     int threads = 0);

/// Moves arcs that are each other's mirror images across the plane normal to `axis` to the mean of
/// the one and the other's image, and onto the plane those that are their own. Arcs are images if
/// their nodes are, and if their balls overlap each other's images in the mean; their own, if they
/// also lie, from end to end, within 30 degrees of the plane or of its normal. They stay where a
/// point would keep less than the share `keep` of its inscribed radius. O(nodes^2 + arcs^2).
/// Returns the number of arcs that moved.
int mirror_arcs(SkeletonGraph& graph, int axis, const SurfaceTree& tree, double keep);

}  // namespace curveskel
