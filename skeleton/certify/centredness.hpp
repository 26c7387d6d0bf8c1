// The distance of a curve from the middle of the shape that it runs through.
#pragma once

#include <utility>
#include <vector>

#include <curveskel/monitor.hpp>
#include "skeleton/certify/measured_curve.hpp"

namespace curveskel {

/// Per sample the standard deviation over the mean of the ray lengths in the plane normal to the
/// curve: infinite outside, -1 within the ball of a junction at an end of its branch, where that
/// plane cuts the other branches. If that leaves nothing, junctions count as well.
[[nodiscard]] std::vector<double> ray_variations(const MeasuredCurve& curve, int rays,
                                                 const Monitor& monitor);

/// The smallest value that at least `share` of the weight does not exceed; infinite without any.
[[nodiscard]] double weighted_quantile(std::vector<std::pair<double, double>> value_and_weight,
                                       double share);

}  // namespace curveskel
