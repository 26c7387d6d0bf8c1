// Points spread evenly over a surface.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// `count` points in equal steps of area, triangle after triangle; within a triangle by a sequence
/// that fills the square evenly (steps of the plastic number), folded at the diagonal. None if the
/// surface has no area. O(#F + count).
[[nodiscard]] std::vector<Eigen::Vector3d> spread_points(const Surface& surface, int count);

}  // namespace curveskel
