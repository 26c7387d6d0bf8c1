#include "skeleton/graph/skeleton_segments.hpp"

#include <cstddef>

#include "surface/spatial/segment.hpp"

namespace curveskel {

using Eigen::Vector3d;

SkeletonSegments::SkeletonSegments(const CurveSkeleton& skeleton) : tree_(collect(skeleton)) {}

double SkeletonSegments::distance(const Vector3d& p) const {
  return tree_.minimum(p, 0, [&](std::size_t i) {
    const auto& [start, end] = ends_[i];
    return (nearest_on_segment(p, start, end) - p).norm();
  });
}

std::vector<SequenceTree::Item> SkeletonSegments::collect(const CurveSkeleton& skeleton) {
  std::vector<bool> lone(static_cast<std::size_t>(skeleton.nodes.rows()), true);
  for (const Branch& branch : branches(skeleton)) {
    for (std::size_t k = 1; k < branch.nodes.size(); ++k) {
      ends_.emplace_back(skeleton.nodes.row(branch.nodes[k - 1]),
                         skeleton.nodes.row(branch.nodes[k]));
    }
    for (const int node : branch.nodes) lone[static_cast<std::size_t>(node)] = false;
  }
  for (std::size_t node = 0; node < lone.size(); ++node) {
    const Vector3d p = skeleton.nodes.row(static_cast<Eigen::Index>(node));
    if (lone[node]) ends_.emplace_back(p, p);
  }
  std::vector<SequenceTree::Item> items;
  items.reserve(ends_.size());
  for (const auto& [start, end] : ends_) {
    items.push_back({start.cwiseMin(end), start.cwiseMax(end)});
  }
  return items;
}

}  // namespace curveskel
