#include "rig/plan/mirror_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

using Eigen::Vector3d;

double asymmetry(const CurveTree& tree, int axis, double middle) {
  constexpr std::size_t samples = 300;
  const std::size_t stride = 1 + tree.nodes.size() / samples;
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < tree.nodes.size(); k += stride) {
    Vector3d image = tree.nodes[k];
    image[axis] = 2 * middle - image[axis];
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3d& other : tree.nodes) least = std::min(least, (other - image).squaredNorm());
    sum += std::sqrt(least);
    ++count;
  }
  return sum / (std::max(count, 1) * tree.size);
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
  double least = asymmetry(tree, 0, best);
  for (const double middle : middles_of(tree, tips)) {
    const double off = asymmetry(tree, 0, middle);
    if (off >= least) continue;
    least = off;
    best = middle;
  }
  return best;
}

}  // namespace curveskel
