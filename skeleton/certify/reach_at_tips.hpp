// Tips that stop on the way through their limbs.
#pragma once

#include "skeleton/certify/measured_curve.hpp"

namespace curveskel {

/// The largest, over the tips inside, of the distance to the nearest inscribed ball of the curve
/// from the point of the surface straight ahead of the tip, over D. Ahead is the way to the tip
/// from the place where the curve enters the tip's inscribed ball, or a ball of D/100 if that is
/// larger. If another branch stands for the surface ahead, the tip has no more to reach.
[[nodiscard]] double reach_at_tips(const MeasuredCurve& curve);

}  // namespace curveskel
