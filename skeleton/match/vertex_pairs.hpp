// Vertices that lie around paired branches in the same place.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "skeleton/match/motions.hpp"

namespace curveskel {

struct VertexPairs {
  Eigen::VectorXi partner;  ///< #V of a, -1 = none
  Eigen::VectorXd
      distance;  ///< #V of a: from the partner's surface to where the vertex is thought to be
};

/// Of each vertex: the place on its branch, laid onto the partner by shares of the length, and from
/// there the way to the vertex, turned as the node is and then by the least rotation that takes the
/// curve's direction to the partner's; the vertex of the partner's territory nearest to where that
/// ends. Of every `step`th vertex only. O(#V log #V).
[[nodiscard]] VertexPairs pair_vertices(const MatchSide& a, const MatchSide& b,
                                        const std::vector<BranchPair>& branch_pairs,
                                        const NodeMotions& motions, int step, int threads);

}  // namespace curveskel
