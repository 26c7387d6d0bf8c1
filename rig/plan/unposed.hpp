// A body in a pose as one whose sides are images of each other.
#pragma once

#include "rig/plan/curve_tree.hpp"

namespace curveskel {

struct Unposed {
  CurveTree tree;
  Limbs limbs;  ///< `length` is the mean of both sides, `lowest` the lower one's, above the ground
};

/// The tree with its trunk in a mirror plane and each limb as the mean of both, by shares of their
/// lengths. The surface's vertices move with their nodes; nodes keep their numbers. The spread
/// points stay.
[[nodiscard]] Unposed unpose(const CurveTree& tree, const Limbs& limbs);

/// Moves the spread points with the nodes, each with that whose ball is nearest.
void move_spread(const CurveTree& posed, CurveTree& unposed);

}  // namespace curveskel
