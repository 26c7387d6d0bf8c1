// A skeleton's curve as the certificate looks at it: in samples, each with its distance to the
// surface.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/certificate.hpp>
#include "base/parallel.hpp"
#include "skeleton/certify/curve_samples.hpp"

namespace curveskel {

/// Refers to the tree and the skeleton.
struct MeasuredCurve {
  const SurfaceTree& tree;
  const CurveSkeleton& skeleton;
  std::vector<Branch> branches;
  std::vector<int> degree;           ///< per node
  Eigen::VectorXd clearance;         ///< per node: signed distance to the surface; junctions only
  std::vector<CurveSample> samples;  ///< the branches', then the lone nodes', worth one step each
  std::vector<int> lone_nodes;       ///< those of the last samples
  std::vector<std::int32_t> order;   ///< of the samples: near ones mostly near each other
  std::vector<double> radius;  ///< per sample: signed distance to the surface, positive inside
  double diagonal = 0;
  int threads = 0;

  [[nodiscard]] bool is_junction(int node) const { return degree[idx(node)] >= 3; }
};

/// Throws Error(Fault::input) if a node's position is no finite number.
[[nodiscard]] MeasuredCurve measured_curve(const SurfaceTree& tree, double diagonal,
                                           const CurveSkeleton& skeleton,
                                           const CertificateOptions& options,
                                           const Monitor& monitor);

/// The leaf branches shorter than the inscribed radius at their junction: rows of `branches`.
[[nodiscard]] std::vector<int> spurs_of(const MeasuredCurve& curve);

/// Runs body(begin, end) for ranges of all samples, in blocks, so that progress and cancellation
/// come from this thread.
template <typename Body>
void for_sample_ranges(const MeasuredCurve& curve, double from, double to, const Monitor& monitor,
                       const Body& body) {
  constexpr std::size_t block = 2048;
  const std::size_t all = curve.samples.size();
  for (std::size_t first = 0; first < all; first += block) {
    const double share = static_cast<double>(first) / static_cast<double>(all);
    monitor.report("certify", from + (to - from) * share);
    parallel_for(std::min(block, all - first), 32, curve.threads,
                 [&](std::size_t begin, std::size_t end) { body(first + begin, first + end); });
  }
}

/// The same, body(i) for each sample.
template <typename Body>
void for_samples(const MeasuredCurve& curve, double from, double to, const Monitor& monitor,
                 const Body& body) {
  for_sample_ranges(curve, from, to, monitor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

}  // namespace curveskel
