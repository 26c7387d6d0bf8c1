// The part of a surface that a curve stands for, as balls.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "skeleton/certify/curve_pieces.hpp"
#include "skeleton/certify/measured_curve.hpp"
#include "skeleton/graph/sequence_tree.hpp"

namespace curveskel {

/// The samples as balls whose radius counts `factor` times. Of a curve whose samples are farther
/// apart than its balls are wide, as in a hair, they are rolled along the piece until they meet.
struct SampleBalls {
  const MeasuredCurve& subject;
  CurvePieces pieces{subject.samples};

  [[nodiscard]] double radius(std::size_t i) const { return std::max(0.0, subject.radius[i]); }
  [[nodiscard]] double rolled(std::size_t i) const {
    return std::max(0.0, pieces.reach(i) - radius(i));
  }
  [[nodiscard]] double gap(std::size_t i, const Eigen::Vector3d& v, double factor) const {
    return pieces.distance(i, v, rolled(i)) - factor * radius(i);
  }
  [[nodiscard]] SequenceTree tree(double factor) const {
    std::vector<SequenceTree::Item> items;
    items.reserve(subject.samples.size());
    for (std::size_t i = 0; i < subject.samples.size(); ++i) {
      items.push_back(pieces.item(i, rolled(i), factor * radius(i)));
    }
    return {items, subject.order};
  }
};

}  // namespace curveskel
