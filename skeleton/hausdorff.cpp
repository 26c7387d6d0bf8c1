#include <algorithm>
#include <vector>

#include "skeleton/certificate.hpp"
#include "skeleton/curve_samples.hpp"
#include "skeleton/sequence_tree.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

// The segments of a skeleton branch by branch; its lone nodes as segments of no length.
class Segments {
 public:
  explicit Segments(const CurveSkeleton& skeleton) : tree_(collect(skeleton)) {}

  [[nodiscard]] double distance(const Vector3d& p) const {
    return tree_.minimum(p, 0, [&](std::size_t i) {
      const auto& [start, end] = ends_[i];
      const Vector3d along = end - start;
      const double squared = along.squaredNorm();
      const double t = squared > 0 ? std::clamp(along.dot(p - start) / squared, 0.0, 1.0) : 0;
      return (start + t * along - p).norm();
    });
  }

 private:
  [[nodiscard]] std::vector<SequenceTree::Item> collect(const CurveSkeleton& skeleton) {
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

  std::vector<std::pair<Vector3d, Vector3d>> ends_;
  SequenceTree tree_;
};

double farthest(const CurveSkeleton& from, const Segments& to, double spacing) {
  double largest = 0;
  for (Eigen::Index node = 0; node < from.nodes.rows(); ++node) {
    largest = std::max(largest, to.distance(from.nodes.row(node)));
  }
  for (const CurveSample& sample : sample_branches(from, branches(from), spacing, spacing)) {
    largest = std::max(largest, to.distance(sample.position));
  }
  return largest;
}

double mean(const CurveSkeleton& from, const Segments& to, double spacing) {
  double sum = 0;
  double length = 0;
  for (const CurveSample& sample : sample_branches(from, branches(from), spacing, spacing)) {
    sum += sample.length * to.distance(sample.position);
    length += sample.length;
  }
  return length > 0 ? sum / length : farthest(from, to, spacing);
}

}  // namespace

double mean_distance(const CurveSkeleton& a, const CurveSkeleton& b, double spacing) {
  return (mean(a, Segments(b), spacing) + mean(b, Segments(a), spacing)) / 2;
}

double hausdorff_distance(const CurveSkeleton& a, const CurveSkeleton& b, double spacing) {
  const Segments segments_of_a(a);
  const Segments segments_of_b(b);
  return std::max(farthest(a, segments_of_b, spacing), farthest(b, segments_of_a, spacing));
}

}  // namespace curveskel
