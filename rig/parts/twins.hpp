// Components that are mirror images of one another. Internal to rig/.
#pragma once

#include <Eigen/Core>
#include <stop_token>
#include <vector>

namespace curveskel {

/// Of each component its centroid and its area; `by_area` has their numbers, the largest first but
/// for rounding.
struct MeasuredComponents {
  const std::vector<Eigen::Vector3d>& middles;
  const std::vector<double>& areas;
  const std::vector<int>& by_area;
};

/// By component the first later one by area, of those that have none so far, which is as large and
/// whose centroid lies within the tolerance of where a mirror would show its own; -1 = none, or it
/// lies in the mirror itself. Of the planes through `middle` along two axes it is the one that
/// pairs most area. O(n sqrt n), and the pairs of an image with centroids that lie near it.
/// Throws Cancelled on a stop.
[[nodiscard]] std::vector<int> mirrored_twins(const MeasuredComponents& components,
                                              const Eigen::Vector3d& middle, double tolerance,
                                              const std::stop_token& stop);

}  // namespace curveskel
