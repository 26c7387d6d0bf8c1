// A human of whom limbs are hidden, in a robe, in armour of plates, or with crossed arms: those
// that the curve does not show stand where a standing human has them.
#pragma once

#include <optional>

#include <curveskel/body_plan.hpp>
#include "rig/plan/looks.hpp"

namespace curveskel {

/// The body as a humanoid's: of its pairs those that are a human's legs and arms by their heights,
/// and places for those that are hidden. Precondition: looked at by `images` or `own`, as `other`.
/// O(#N) for each of the surface's spread points.
[[nodiscard]] Outlook as_standing(Outlook outlook);

/// True if the humanoid is upright, its legs and arms a human's by their heights and lengths; of
/// one in a pose, if it has both.
[[nodiscard]] bool shows_all_limbs(const Outlook& outlook);

/// Of looks by place and by own sides the one that shows most of a human's limbs, of several the
/// first that is not from the side, as `as_standing`. Nothing where the body is
/// upright in none; where up is said, it is.
[[nodiscard]] std::optional<Outlook> best_standing(LookedAt& body, const PlanOptions& options);

/// True of a body whose upper half is as people's is from their side: about half as wide as deep.
[[nodiscard]] bool shows_side(const CurveTree& tree);

}  // namespace curveskel
