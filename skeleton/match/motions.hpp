// The motion of each stretch of a body from one surface to another.
#pragma once

#include <vector>

#include "skeleton/match/similarity.hpp"
#include "skeleton/match/tips.hpp"

namespace curveskel {

/// Components with a smaller share of the area, such as eyes, teeth and nails: each would be drawn
/// onto whatever is near, so it goes with what it sits on.
inline constexpr double least_body_share = 0.02;

struct NodeMotions {
  std::vector<Similarity> of_node;  ///< per node of a: for its surroundings
};

/// From the middle outwards: the surface within two inscribed radii of a node starts with the
/// motion of the node before it, and is laid onto b from there. So a bent limb is followed, and so
/// is its turn about its own axis. A component begins as the nearest node of a larger one moves,
/// and small ones stay so.
[[nodiscard]] NodeMotions follow_motions(const MatchSide& a, const TipFeatures& of_a,
                                         const SurfaceTree& tree_b, const Similarity& core);

/// That of each node's surroundings, by least squares, where the vertices of a are known in b
/// (#V of a, -1 = not known); the scale is that of the whole. A node with fewer than three moves as
/// the node before it.
[[nodiscard]] NodeMotions known_motions(const MatchSide& a, const TipFeatures& of_a,
                                        const MatchSide& b, const TipFeatures& of_b,
                                        const Eigen::VectorXi& vertex_of_a);

/// From pairs of branches that hang together in both: nodes on them go to the same share
/// of the partner's length, turned as before and then by the least rotation that takes one curve's
/// direction to the other's; all others go with the nearest of these along the curve, those of
/// other components with the nearest in space. O(#N^2).
[[nodiscard]] NodeMotions anchored_motions(const MatchSide& a, const TipFeatures& of_a,
                                           const MatchSide& b, const std::vector<BranchPair>& pairs,
                                           const NodeMotions& motions);

}  // namespace curveskel
