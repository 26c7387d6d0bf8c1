// Components that are the same part.
#pragma once

#include <stop_token>
#include <vector>

#include "skeleton/match/motions.hpp"
#include "skeleton/match/tips.hpp"

namespace curveskel {

/// For each component of a that of b, -1 = none: by the place of its centroid, moved as itself and
/// then as its neighbours are paired, and its area, such that the sum of differences is least.
[[nodiscard]] std::vector<int> pair_components(const TipFeatures& a, const TipFeatures& b,
                                               const NodeMotions& motions,
                                               const std::stop_token& stop);

}  // namespace curveskel
