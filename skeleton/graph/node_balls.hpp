// The balls around a skeleton's nodes, to be asked for the nearest. Internal to the library.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include "skeleton/graph/sequence_tree.hpp"

namespace curveskel {

/// Nodes of a skeleton without radii are balls of radius 0. O(#N).
class NodeBalls {
 public:
  /// The skeleton must outlive the balls.
  explicit NodeBalls(const CurveSkeleton& skeleton);

  /// The node with the least distance to its ball, negative within; the first of equally near
  /// ones; -1 where there is no node. O(log #N) for nodes along curves, in any order.
  [[nodiscard]] int nearest(const Eigen::Vector3d& point) const;

 private:
  const CurveSkeleton& skeleton_;
  std::vector<std::int32_t> order_;  // nodes whose neighbours in space are neighbours in the tree
  SequenceTree tree_;
};

}  // namespace curveskel
