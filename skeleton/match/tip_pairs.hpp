// Pairs of tips that agree about the distances between them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "skeleton/match/tips.hpp"

namespace curveskel {

/// For each tip of a that of b, -1 = none. Graduated assignment (S. Gold and A. Rangarajan, 1996)
/// over at most 16 candidates for each: the score of a pair grows with the pairs that lie as far
/// from it in both, and with how near the tip comes to the other when it moves as its surroundings.
/// `places_a` are those of a's tips, moved, `places_b` those of b's; over b's unit.
/// Tips are those of paired components.
[[nodiscard]] std::vector<int> pair_tips(const TipFeatures& a, const TipFeatures& b,
                                         const Eigen::MatrixXd& like,
                                         const Eigen::Matrix3Xd& places_a,
                                         const Eigen::Matrix3Xd& places_b,
                                         const std::vector<int>& component_pairs);

}  // namespace curveskel
