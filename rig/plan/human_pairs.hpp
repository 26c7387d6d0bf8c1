// The pairs of limbs that are a human's.
#pragma once

#include "rig/plan/curve_tree.hpp"

namespace curveskel {

/// The pairs that are a human's by their heights; where there are none, the two longest if they are
/// images of each other and the lower one reaches the ground, as of those who sit. -1 = none.
struct HumanPairs {
  int legs = -1;  ///< from between knees and waist: what parts lower is a hem, or feet
  int arms = -1;  ///< from between hips and head, a third of the legs or longer
};

/// Of a body that stands upright. O(spread points).
[[nodiscard]] HumanPairs human_pairs(const CurveTree& tree, const Limbs& limbs);

}  // namespace curveskel
