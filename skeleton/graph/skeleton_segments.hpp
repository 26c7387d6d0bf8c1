// The curve of a skeleton as segments: how far anything is from it.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include "skeleton/graph/sequence_tree.hpp"

namespace curveskel {

/// Branch by branch; lone nodes are segments of no length. O(#E log #E).
class SkeletonSegments {
 public:
  explicit SkeletonSegments(const CurveSkeleton& skeleton);

  /// Of the nearest segment; infinite if there is none.
  [[nodiscard]] double distance(const Eigen::Vector3d& p) const;

 private:
  [[nodiscard]] std::vector<SequenceTree::Item> collect(const CurveSkeleton& skeleton);

  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> ends_;
  SequenceTree tree_;
};

}  // namespace curveskel
