// Which branches mean something.
#pragma once

#include "skeleton/circles.hpp"
#include "skeleton/network.hpp"
#include "surface/surface.hpp"
#include "surface/tree.hpp"

namespace curveskel {

/// Prunes leaf strands whose slenderness (see SlendernessSweep), from the vertex of theirs that is
/// farthest from the junction towards it, is below the limit, least first, as long as something is
/// left; those that nowhere stick out before all others, least area first.
/// `graph` is what the network was made from.
void prune_blunt(Network& network, const Surface& surface, const VertexGraph& graph, double limit);

/// Prunes leaf strands shorter than `factor` x the inscribed radius at their junction, shortest
/// ratio first. Returns whether any was.
bool prune_spurs(Network& network, const SurfaceTree& tree, double factor);

}  // namespace curveskel
