#include "skeleton/graph/node_balls.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "surface/spatial/morton.hpp"

namespace curveskel {
namespace {

double radius_of(const CurveSkeleton& skeleton, int node) {
  return skeleton.radii.size() > 0 ? skeleton.radii[node] : 0;
}

SequenceTree tree_of(const CurveSkeleton& skeleton, const std::vector<std::int32_t>& order) {
  std::vector<SequenceTree::Item> items;
  items.reserve(order.size());
  for (const std::int32_t node : order) {
    const Eigen::Vector3d centre = skeleton.nodes.row(node).transpose();
    items.push_back({centre, centre, radius_of(skeleton, node)});
  }
  return SequenceTree(std::move(items));
}

}  // namespace

NodeBalls::NodeBalls(const CurveSkeleton& skeleton)
    : skeleton_(skeleton),
      order_(along_morton_curve(skeleton.nodes, 1)),
      tree_(tree_of(skeleton, order_)) {}

int NodeBalls::nearest(const Eigen::Vector3d& point) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double rounding = 1e-14;  // so that balls that are equally near are all looked at
  int nearest = -1;
  double least = infinity;
  (void)tree_.minimum(point, -infinity, [&](std::size_t i) {
    const int node = order_[i];
    const double to_centre = (point.transpose() - skeleton_.nodes.row(node)).norm();
    const double radius = radius_of(skeleton_, node);
    const double distance = to_centre - radius;
    if (distance < least || (distance == least && node < nearest)) {
      least = distance;
      nearest = node;
    }
    return distance + rounding * (to_centre + std::abs(radius));
  });
  return nearest;
}

}  // namespace curveskel
