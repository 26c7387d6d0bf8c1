// Branches that divide the paired tips in the same way, and those whose surfaces come to lie on
// each other.
#pragma once

#include <vector>

#include "skeleton/match/motions.hpp"
#include "skeleton/match/tips.hpp"

namespace curveskel {

/// By a. Each branch at most once; none is marked as ambiguous. `partner` is of `pair_tips`,
/// `overlaps` of `branch_overlaps`.
[[nodiscard]] std::vector<BranchPair> pair_branches(const MatchedBodies& bodies,
                                                    const std::vector<int>& partner,
                                                    const Eigen::MatrixXd& overlaps,
                                                    const NodeMotions& motions);

/// Junctions that two branches or more of a pair end at, by a.
[[nodiscard]] std::vector<std::pair<int, int>> pair_junctions(
    const MatchSide& a, const MatchSide& b, const std::vector<BranchPair>& branch_pairs);

}  // namespace curveskel
