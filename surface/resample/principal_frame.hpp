// The place and the orientation of a surface.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

struct PrincipalFrame {
  Eigen::Vector3d origin;  ///< the area's centroid, in model units
  /// Columns unit, largest extent first; of two mirror images one is left-handed, so that both have
  /// one pose. More than one where the shape is symmetric: its candidates, all with the same right.
  std::vector<Eigen::Matrix3d> axes;
};

/// Principal axes of the area's covariance, signs from third moments. Where two of its values are
/// equal, the least angular moment settles the directions: normal to the sides of a square plate.
/// The fourth moments do where all three are: normal to the faces of a cube. A rounder
/// shape points to the vertices farthest out; of these to those farthest along the axis that is
/// settled, and of these to those with the longest edges. At most `most_candidates`; up to these
/// the result is free of the surface's numbering. O(#V + #F).
[[nodiscard]] PrincipalFrame principal_frame(const Surface& surface, std::size_t most_candidates,
                                             int threads = 0);

}  // namespace curveskel
