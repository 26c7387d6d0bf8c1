// Curves that do not squeeze past a hollow where there is more room on its other side.
#pragma once

#include "skeleton/circles.hpp"
#include "skeleton/network.hpp"
#include "surface/inscribed_balls.hpp"
#include "surface/surface.hpp"
#include "surface/tree.hpp"

namespace curveskel {

/// A strand that is on no cycle and passes a place half as wide as what lies before and behind it
/// takes another way between two of its places, if there is one through the surface that costs a
/// third (length in inscribed radii) and is twice as wide where it is narrowest: the neck instead
/// of the cheek, beside a hollow mouth. At least a third of the strand's length stays. The new
/// points may lie outside. Returns the number of ways taken. D = 1. O(n log n) where such a place
/// is.
int take_wider_ways(Network& network, const Surface& surface, const InscribedBalls& balls,
                    const VertexGraph& graph, const SurfaceTree& tree);

}  // namespace curveskel
