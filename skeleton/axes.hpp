// Where the limbs at a junction point to.
#pragma once

#include "skeleton/network.hpp"
#include "surface/tree.hpp"

namespace curveskel {

/// The point nearest to the axes of all strands at a hub of the given inscribed `radius`, each
/// taken outside of its ball: within it a strand goes to wherever the hub is. Held back a little,
/// as axes that are nearly parallel meet anywhere.
[[nodiscard]] Point meeting_of_axes(const Network& network, int hub, double radius);

/// Whether a leaf strand would come nearer to being a spur, and hardly be longer than the inscribed
/// radius at its hub, if that moved from the ball `from` to the ball `to`.
[[nodiscard]] bool makes_spur(const Network& network, int hub, const SurfaceTree::Ball& from,
                              const SurfaceTree::Ball& to);

}  // namespace curveskel
