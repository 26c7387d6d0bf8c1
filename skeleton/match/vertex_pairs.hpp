// Vertices that lie around paired branches in the same place.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include <curveskel/branch_territories.hpp>
#include "skeleton/match/motions.hpp"

namespace curveskel {

struct VertexPairs {
  Eigen::VectorXi partner;  ///< #V of a, -1 = none
  /// #V of a: from the partner's surface to where the vertex is thought to be.
  Eigen::VectorXd distance;
};

/// The surfaces of all branches of b, made once for many trials. Refers to what it is made of.
class VertexPairing {
 public:
  VertexPairing(const MatchSide& a, const BranchTerritories& territories_a, const MatchSide& b,
                const BranchTerritories& territories_b, int threads);
  ~VertexPairing();
  VertexPairing(const VertexPairing&) = delete;
  VertexPairing& operator=(const VertexPairing&) = delete;

  /// Of each vertex: the place on its branch, laid onto the partner by shares of the length, and
  /// from there the way to the vertex, turned as the node is and then by the least rotation that
  /// takes the curve's direction to the partner's; the vertex of the partner's territory nearest to
  /// where that ends. Of these vertices of a only, once each. O(vertices log #V).
  [[nodiscard]] VertexPairs pair(const std::vector<BranchPair>& branch_pairs,
                                 const NodeMotions& motions,
                                 const std::vector<int>& vertices_of_a) const;

 private:
  struct Implementation;
  std::unique_ptr<const Implementation> implementation_;
};

}  // namespace curveskel
