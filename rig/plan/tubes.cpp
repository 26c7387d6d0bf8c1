#include "rig/plan/tubes.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// The nearest node to a point, of several the lowest: sought both ways along x, no farther than
/// the nearest so far.
class NearestNode {
 public:
  explicit NearestNode(const std::vector<Vector3d>& nodes) : nodes_(nodes), by_x_(nodes.size()) {
    std::iota(by_x_.begin(), by_x_.end(), 0);
    std::sort(by_x_.begin(), by_x_.end(), [&](int a, int b) { return x_of(a) < x_of(b); });
  }

  [[nodiscard]] int to(const Vector3d& point) const {
    auto after = std::lower_bound(by_x_.begin(), by_x_.end(), point.x(),
                                  [&](int node, double x) { return x_of(node) < x; });
    auto before = after;
    std::pair<double, int> nearest{std::numeric_limits<double>::infinity(), -1};
    const auto take = [&](int node) {
      nearest = std::min(nearest, {(nodes_[idx(node)] - point).squaredNorm(), node});
    };
    const auto may_be_nearer = [&](int node) {
      const double off = x_of(node) - point.x();
      return off * off <= nearest.first;
    };
    bool goes_on = true;
    while (goes_on) {
      goes_on = false;
      if (after != by_x_.end() && may_be_nearer(*after)) {
        take(*after++);
        goes_on = true;
      }
      if (before != by_x_.begin() && may_be_nearer(*std::prev(before))) {
        take(*--before);
        goes_on = true;
      }
    }
    return nearest.second;
  }

 private:
  [[nodiscard]] double x_of(int node) const { return nodes_[idx(node)].x(); }

  const std::vector<Vector3d>& nodes_;
  std::vector<int> by_x_;
};

}  // namespace

std::vector<PointOfNode> points_by_nodes(const CurveTree& tree) {
  constexpr std::size_t every = 8;  // of 20,000
  std::vector<PointOfNode> points;
  const NearestNode nearest(tree.nodes);
  for (std::size_t k = 0; k < tree.spread.size(); k += every) {
    points.push_back({tree.spread[k], nearest.to(tree.spread[k])});
  }
  return points;
}

bool is_near_curve(const CurveTree& tree, const PointOfNode& at) {
  constexpr double tube_factor = 2.5;  // as the certificate's
  return (tree.nodes[idx(at.node)] - at.point).norm() <= tube_factor * tree.radii[idx(at.node)];
}

double tubes_among(const CurveTree& tree, const std::function<bool(int)>& counts) {
  int near = 0;
  int all = 0;
  for (const PointOfNode& at : points_by_nodes(tree)) {
    if (!counts(at.node)) continue;
    ++all;
    near += is_near_curve(tree, at) ? 1 : 0;
  }
  return all > 0 ? near / static_cast<double>(all) : 0;
}

}  // namespace curveskel
