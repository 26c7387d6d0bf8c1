// Boxes that meet, without asking each of each.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

/// Calls visit(a, b) once for any two boxes with a point in common, in no order of use. Empty boxes
/// meet none. Sweeps along the longest side of all: O(n log n), and what overlaps along that side.
template <typename Visit>
void for_meeting_boxes(const std::vector<Eigen::AlignedBox3d>& boxes, const Visit& visit) {
  Eigen::AlignedBox3d all;
  std::vector<int> by_start;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    if (boxes[k].isEmpty()) continue;
    all.extend(boxes[k]);
    by_start.push_back(static_cast<int>(k));
  }
  if (by_start.empty()) return;
  Eigen::Index axis = 0;
  all.sizes().maxCoeff(&axis);
  std::stable_sort(by_start.begin(), by_start.end(), [&](int a, int b) {
    return boxes[idx(a)].min()[axis] < boxes[idx(b)].min()[axis];
  });
  for (std::size_t i = 0; i < by_start.size(); ++i) {
    const Eigen::AlignedBox3d& one = boxes[idx(by_start[i])];
    for (std::size_t j = i + 1; j < by_start.size(); ++j) {
      const Eigen::AlignedBox3d& other = boxes[idx(by_start[j])];
      if (other.min()[axis] > one.max()[axis]) break;
      if (one.intersects(other)) visit(by_start[i], by_start[j]);
    }
  }
}

}  // namespace curveskel
