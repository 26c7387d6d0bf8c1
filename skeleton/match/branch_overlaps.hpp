// How much of each branch's surface comes to lie on that of each branch of the other.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/branch_territories.hpp>
#include "skeleton/match/motions.hpp"

namespace curveskel {

/// Branches of a x branches of b, 0..1: the area of a's that comes to lie nearest to b's, over the
/// area that either has, areas as shares of the whole. From some thousand vertices of a.
[[nodiscard]] Eigen::MatrixXd branch_overlaps(const MatchSide& a,
                                              const BranchTerritories& territories_a,
                                              const BranchTerritories& territories_b,
                                              const SurfaceTree& tree_b, const NodeMotions& motions,
                                              int threads);

}  // namespace curveskel
