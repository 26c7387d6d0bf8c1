// Branches that reach to the ends of what they stand for.
#pragma once

#include "skeleton/network.hpp"
#include "surface/tree.hpp"

namespace curveskel {

/// Cuts each leaf strand back to where its rest and the surface ahead are within `reach` x the
/// local inscribed radius, or its rest turns away within the ball; then prolongs it straight ahead,
/// centring as it goes, until the surface ahead is within `gap` x the radius, or nearest.
void shape_tips(Network& network, const SurfaceTree& tree, double reach, double gap);

/// Prolongs leaf strands that end inside the inscribed ball of their junction to just beyond it, if
/// there is room: their tip must keep 0.4 of the junction's radius.
void lengthen_short_leaves(Network& network, const SurfaceTree& tree);

}  // namespace curveskel
