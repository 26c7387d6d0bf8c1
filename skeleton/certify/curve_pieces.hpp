// The pieces of the curve that its samples stand for.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "skeleton/certify/curve_samples.hpp"
#include "skeleton/graph/sequence_tree.hpp"

namespace curveskel {

/// Straight but for bends within a step: a hair may be thinner than the steps are long.
struct CurvePieces {
  const std::vector<CurveSample>& samples;

  [[nodiscard]] double reach(std::size_t i) const {
    return samples[i].branch < 0 ? 0 : 0.5 * samples[i].length;  // a lone node is no line
  }
  /// From the piece without what its ends have more than `along` from its middle.
  [[nodiscard]] double distance(std::size_t i, const Eigen::Vector3d& p, double along) const {
    const CurveSample& sample = samples[i];
    const Eigen::Vector3d offset = p - sample.position;
    const double place = std::clamp(offset.dot(sample.tangent), -along, along);
    return (offset - place * sample.tangent).norm();
  }
  /// The box of that, to look for it.
  [[nodiscard]] SequenceTree::Item item(std::size_t i, double along, double weight) const {
    const Eigen::Vector3d half = (samples[i].tangent * along).cwiseAbs();
    return {samples[i].position - half, samples[i].position + half, weight};
  }
};

}  // namespace curveskel
