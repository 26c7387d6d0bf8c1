// The mirror plane of a body.
#pragma once

#include <vector>

#include "rig/plan/curve_tree.hpp"

namespace curveskel {

/// The mean distance of the curve's mirror image, across the plane where that axis has the value
/// `middle`, from the curve; of the size. At 300 of its nodes; O(#N log #N).
[[nodiscard]] double asymmetry(const CurveTree& tree, int axis, double middle);

/// Of the size: the asymmetry of a curve that is its own image.
constexpr double symmetric = 0.02;

/// The x, half-way between tips that may be images of each other, of the least asymmetry; the box's
/// where there is no better one.
[[nodiscard]] double middle_of_tips(const CurveTree& tree, const std::vector<int>& tips);

}  // namespace curveskel
