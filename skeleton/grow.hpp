// Branches that the surgery did not make, and limbs that it left short.
#pragma once

#include "skeleton/circles.hpp"
#include "skeleton/network.hpp"
#include "surface/inscribed_balls.hpp"
#include "surface/surface.hpp"
#include "surface/tree.hpp"

namespace curveskel {

/// Gives a branch to each part of the surface that the network does not enter and that sticks out:
/// from the place of the network nearest to the part's summit, or the junction next to that, the
/// slenderness (see SlendernessSweep) is at least `limit` and the summit 1.5 inscribed radii away.
/// From a tip the strand goes on to the summit instead, from 1.5 and 2 inscribed radii on. The
/// inscribed ball at the summit must have at least 0.12 of the radius where the branch begins (from
/// a tip 0.25), or it is a crease, and less than 1.2 of it. What has fewer than 8 vertices where it
/// is measured may be noise. It ends where the part's crown has its middle, not in the corner that
/// the summit of a blunt end is. The new points may lie outside.
/// `graph` is what the network was made from, `tree` the surface's. Returns how many were made.
int grow_branches(Network& network, const Surface& surface, const SurfaceTree& tree,
                  const InscribedBalls& balls, const VertexGraph& graph, double limit);

}  // namespace curveskel
