// Pairs of tips that agree about the distances between them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "skeleton/match/motions.hpp"
#include "skeleton/match/tips.hpp"

namespace curveskel {

/// For each tip of a that of b, -1 = none. Graduated assignment (S. Gold and A. Rangarajan, 1996)
/// over at most 16 candidates for each: the score of a pair grows with the pairs that lie as far
/// from it in both, and with how near the tip comes to the other when it moves as its surroundings.
/// Tips are those of paired components.
[[nodiscard]] std::vector<int> pair_tips(const MatchedBodies& bodies, const NodeMotions& motions,
                                         const std::vector<int>& component_pairs);

}  // namespace curveskel
