// The bones that a limb is cut into. Internal to rig/.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace curveskel {

/// A place on a limb, from its upper end on.
struct LimbSample {
  Eigen::Vector3d point;
  double radius;
  double way;       ///< from the upper end, in radii of where it is
  std::size_t at;   ///< index of the last node up to here
  bool is_at_node;  ///< else before the next one
};

/// Of a bone: 1, its length in `bone_length` ways squared, and the largest distance of the curve
/// from it in `bend` radii squared.
struct BoneCost {
  double bone_length;
  double bend;
  double least_radius;  ///< in which distances are measured
  double least_length;  ///< no bone but one for the whole limb is shorter
};

/// Samples where joints are, from `first` to `last`: the bones that cost least in all. Between two
/// nodes the curve is straight and its radius linear. O(n^2 m) for n samples about m nodes, of what
/// is three bones long; O(m) where one bone does.
[[nodiscard]] std::vector<std::size_t> best_joints(const std::vector<LimbSample>& samples,
                                                   std::size_t first, std::size_t last,
                                                   const BoneCost& cost);

}  // namespace curveskel
