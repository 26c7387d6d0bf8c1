// Convex bodies have no limbs: their curve is one line, the axis that a person would draw.
#pragma once

#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/surface.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/tuning.hpp"
#include "skeleton/embed/working_surface.hpp"

namespace curveskel {

/// True if the chords between the vertices that lie farthest out in directions all round leave the
/// body nowhere by more than the share `dent` of the largest inscribed radius. O(#V + #F); and
/// queries, some thousand where it is true but for dents, few where it is not.
[[nodiscard]] bool is_convex(const WorkingSurface& working, const SurfaceTree& tree, double dent);

/// One arc that stands for all groups of the partition: along the line through the origin, in
/// canonical form the centroid, from which the surface is nearest in the mean of the fourth power
/// of the distance. It leads to half of the way to the surface on either side, and on until the
/// surface ahead is within `gap` inscribed radii. Without arcs if the origin lies outside.
[[nodiscard]] SkeletonGraph axis_of_convex_body(const Surface& surface,
                                                const PartitionGraph& partition,
                                                const SurfaceTree& tree, double reach, double gap,
                                                const TipTuning& tuning);

}  // namespace curveskel
