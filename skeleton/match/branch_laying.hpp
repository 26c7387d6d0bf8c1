// The place of a branch along its partner.
#pragma once

#include "skeleton/match/motions.hpp"
#include "skeleton/measure/branch_curve.hpp"

namespace curveskel {

/// Shares of the length go to like shares, from `start` on.
struct BranchLaying {
  double start = 0;  ///< the length on the partner to which the branch's start goes
  bool reversed = false;

  /// May lie beyond the end of a closed partner, which `point_at` goes round.
  [[nodiscard]] double length_on_partner(const BranchCurve& from, const BranchCurve& to,
                                         double s) const {
    const double share = from.length() > 0 ? s / from.length() : 0;
    return start + (reversed ? -share : share) * to.length();
  }
};

/// One branch of a skeleton. Refers to what it is made of.
struct BranchOnSide {
  const MatchSide& side;
  const Branch& branch;
  const BranchCurve& curve;  ///< of the branch
};

/// A pair of branches. Where a ring begins says nothing, as no junction is there: its start goes to
/// where the motions take the ring's nodes, in the circular mean.
[[nodiscard]] BranchLaying laying_of(const BranchOnSide& one, const BranchOnSide& other,
                                     bool reversed, const NodeMotions& motions);

/// True if a closed branch goes round against its closed partner, by the directions of both where
/// the motions take the one's nodes.
[[nodiscard]] bool goes_round_against(const Branch& one, const BranchCurve& from,
                                      const BranchCurve& to, const NodeMotions& motions);

}  // namespace curveskel
