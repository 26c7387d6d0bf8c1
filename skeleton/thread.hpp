// Cycles that go round the handles, where straight lines between a graph's nodes do not.
#pragma once

#include "skeleton/circles.hpp"
#include "skeleton/handle_keeper.hpp"
#include "skeleton/network.hpp"
#include "surface/inscribed_balls.hpp"
#include "surface/surface.hpp"

namespace curveskel {

/// Leads the strands on cycles along the surface itself, group by group and circle by circle,
/// through its vertices' inscribed balls, after those along tunnels have become rings round them.
///
/// A strand whose circles bound no disc inside runs along a tunnel, and its cycle goes round no
/// handle of the inside; but the circle does. The circles of the strands that a spanning tree
/// leaves over span a Lagrangian subspace of the surface's homology. Of those that do not vanish
/// inside a basis becomes rings; the other cycles are dual to discs, so all together are as many
/// independent cycles inside as the surface has handles. Precondition: the network is as
/// `network_of_graph` made it.
void thread_through(Network& network, const Surface& surface, const SurfaceTree& tree,
                    const InscribedBalls& balls, const VertexGraph& graph, HandleKeeper& keeper);

}  // namespace curveskel
