// The place of a segment that is nearest to a point.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace curveskel {

/// One end where the segment has no length.
inline Eigen::Vector3d nearest_on_segment(const Eigen::Vector3d& point, const Eigen::Vector3d& from,
                                          const Eigen::Vector3d& to) {
  const Eigen::Vector3d way = to - from;
  const double squared = way.squaredNorm();
  if (!(squared > 0)) return from;
  return from + std::clamp((point - from).dot(way) / squared, 0.0, 1.0) * way;
}

}  // namespace curveskel
