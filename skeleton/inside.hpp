// A skeleton that never leaves its surface.
#pragma once

#include "skeleton/circles.hpp"
#include "skeleton/handle_keeper.hpp"
#include "skeleton/network.hpp"
#include "surface/inscribed_balls.hpp"
#include "surface/surface.hpp"
#include "surface/tree.hpp"

namespace curveskel {

/// Moves and adds points until the inscribed balls of the ends of every edge overlap: then the
/// whole edge lies in two balls that lie inside the surface, and no sampling is needed to know it.
///
/// Points outside, and midpoints of edges that are not covered, go to the centre of the inscribed
/// ball at the nearest surface point. Where that does not close the gap, the strand follows the
/// cheapest chain of the vertices' own inscribed balls through the strand's part of the surface, or
/// goes along just below the surface from one ball to the next. An edge whose ends are inside and
/// that meets no triangle counts as covered, too.
/// What would lead a strand on a cycle off its handle is left out. Returns the number of edges that
/// are still not covered. Precondition: D = 1.
int keep_inside(Network& network, const Surface& surface, const InscribedBalls& balls,
                const VertexGraph& graph, const SurfaceTree& tree, HandleKeeper& handles);

}  // namespace curveskel
