// The curve of the trunk, from the tail to the nose, in the frame of the curve's tree.
#pragma once

#include <vector>

#include "rig/plan/curve_tree.hpp"

namespace curveskel {

/// A path in the mirror plane by its length.
struct Along {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> way;  ///< from the first point

  [[nodiscard]] Eigen::Vector3d at(double wanted) const;
  [[nodiscard]] double whole() const { return way.back(); }
};
/// Precondition: the path has a node.
[[nodiscard]] Along along(const CurveTree& tree, const std::vector<int>& path);

/// The farthest node ahead of `front` near the mirror plane, by `ways` from there; else `front`.
[[nodiscard]] int nose_of(const CurveTree& tree, int front, const Ways& ways);
/// The farthest node behind `hips` near the mirror plane, by `ways` from there; else `hips`.
[[nodiscard]] int tail_of(const CurveTree& tree, int hips, const Ways& ways);

}  // namespace curveskel
