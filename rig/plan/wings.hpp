// Wings: flat limbs, so that no criterion of tubes is about them.
#pragma once

#include "rig/plan/curve_tree.hpp"
#include "rig/plan/roles.hpp"

namespace curveskel {

/// The pair of limbs that carries a bird in the air: flat, together about as wide as all the rest
/// is long or wider, beside a level, straight trunk that is thicker than they are, without a fin
/// that stands on it. -1 if it is none. O(#N).
[[nodiscard]] int flat_wings(const CurveTree& tree, const Limbs& limbs);

/// Of a bird's surface without its wings the share that lies near the curve, as of a certificate's
/// `tube_share`. Precondition: `wings` is a pair. O(#N).
[[nodiscard]] double tubes_but_for_wings(const CurveTree& tree, const Limbs& limbs, int wings);

/// True if one end of a bird is clearly flatter than the other: tails are flat, heads are not.
[[nodiscard]] bool has_a_flat_end(const CurveTree& tree, const Limbs& limbs, int wings);

/// True if the tail is at a bird's front; where neither end is flat, if its wings sweep ahead.
[[nodiscard]] bool flies_back(const CurveTree& tree, const Limbs& limbs, int wings);

}  // namespace curveskel
