// The share of each branch's surface that comes to lie on that of each branch of the other.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/branch_territories.hpp>
#include "skeleton/match/motions.hpp"

namespace curveskel {

/// Of some vertices of a, evenly taken, the branch of b on whose surface they come to lie.
struct Landings {
  std::vector<int> vertices;
  std::vector<int> branches;  ///< -1 = of none
};

/// Of some thousand vertices, that of the nearest face, when each moves as its node.
[[nodiscard]] Landings landings_of(const MatchSide& a, const BranchTerritories& territories_b,
                                   const SurfaceTree& tree_b, const NodeMotions& motions,
                                   int threads);

/// Branches of a x branches of b, 0..1: the area of a's that comes to lie on b's, over the area
/// that either has, areas as shares of the whole.
[[nodiscard]] Eigen::MatrixXd branch_overlaps(const BranchTerritories& territories_a,
                                              const BranchTerritories& territories_b,
                                              const Landings& landings);

}  // namespace curveskel
