#include "rig/plan/mirror_plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

using Eigen::Vector3d;

namespace {

/// A curve beside its images across planes normal to one axis.
class Mirrored {
 public:
  Mirrored(const CurveTree& tree, int axis)
      : tree_(tree),
        axis_(axis),
        along_(longer_beside()),
        order_(tree.nodes.size()),
        rank_(tree.nodes.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return tree.nodes[a][along_] < tree.nodes[b][along_];
    });
    for (std::size_t rank = 0; rank < order_.size(); ++rank) rank_[order_[rank]] = rank;
  }

  /// See `asymmetry`; infinite if it is `enough` or more.
  [[nodiscard]] double asymmetry(double middle, double enough = endless) const {
    constexpr std::size_t samples = 300;
    const std::size_t stride = 1 + order_.size() / samples;
    const std::size_t count = (order_.size() + stride - 1) / stride;
    const double whole = static_cast<double>(std::max<std::size_t>(count, 1)) * tree_.size;
    double sum = 0;
    for (std::size_t k = 0; k < order_.size(); k += stride) {
      sum += off_curve(k, middle);
      if (sum / whole >= enough) return endless;
    }
    return sum / whole;
  }

 private:
  static constexpr double endless = std::numeric_limits<double>::infinity();

  /// The axis beside the mirrored one along which the curve is longer.
  [[nodiscard]] int longer_beside() const {
    Eigen::AlignedBox3d box;
    for (const Vector3d& node : tree_.nodes) box.extend(node);
    const int one = (axis_ + 1) % 3;
    const int other = (axis_ + 2) % 3;
    return tree_.nodes.empty() || box.sizes()[one] >= box.sizes()[other] ? one : other;
  }

  /// From the image of a node; an image has its node's place in the order.
  [[nodiscard]] double off_curve(std::size_t node, double middle) const {
    Vector3d image = tree_.nodes[node];
    image[axis_] = 2 * middle - image[axis_];
    double least = endless;
    const auto is_near = [&](std::size_t rank) {
      const Vector3d way = tree_.nodes[order_[rank]] - image;
      if (way[along_] * way[along_] > least) return false;
      least = std::min(least, way.squaredNorm());
      return true;
    };
    const std::size_t own = rank_[node];
    for (std::size_t rank = own; rank < order_.size() && is_near(rank);) ++rank;
    for (std::size_t rank = own; rank > 0 && is_near(rank - 1);) --rank;
    return std::sqrt(least);
  }

  const CurveTree& tree_;
  int axis_;
  int along_;
  std::vector<std::size_t> order_;  // of the nodes along that axis
  std::vector<std::size_t> rank_;   // in it, by node
};

}  // namespace

double asymmetry(const CurveTree& tree, int axis, double middle) {
  return Mirrored(tree, axis).asymmetry(middle);
}

namespace {

/// Between tips that may be images of each other, as hands are and feet: where most pairs agree.
std::vector<double> middles_of(const CurveTree& tree, const std::vector<int>& tips) {
  constexpr double unlike = 0.06;  // of the size, that tips differ but for their sides
  constexpr double apart = 0.002;  // of the size: nearer ones are one
  constexpr std::size_t most = 20;
  std::vector<double> middles;
  for (std::size_t a = 0; a < tips.size(); ++a) {
    for (std::size_t b = a + 1; b < tips.size(); ++b) {
      const Vector3d& p = tree.nodes[idx(tips[a])];
      const Vector3d& q = tree.nodes[idx(tips[b])];
      if (std::hypot(p.y() - q.y(), p.z() - q.z()) > unlike * tree.size) continue;
      middles.push_back(0.5 * (p.x() + q.x()));
    }
  }
  std::sort(middles.begin(), middles.end());
  std::vector<std::pair<int, double>> groups;  // minus how many agree, the middle one of them
  for (std::size_t first = 0; first < middles.size();) {
    std::size_t end = first + 1;
    while (end < middles.size() && middles[end] - middles[first] < apart * tree.size) ++end;
    groups.emplace_back(-static_cast<int>(end - first), middles[(first + end) / 2]);
    first = end;
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> result;
  for (const auto& [count, middle] : groups) {
    if (result.size() < most) result.push_back(middle);
  }
  return result;
}

}  // namespace

double middle_of_tips(const CurveTree& tree, const std::vector<int>& tips) {
  double best = tree.middle;
  const Mirrored curve(tree, 0);
  double least = curve.asymmetry(best);
  for (const double middle : middles_of(tree, tips)) {
    const double off = curve.asymmetry(middle, least);
    if (off >= least) continue;
    least = off;
    best = middle;
  }
  return best;
}

}  // namespace curveskel
