#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "surface/spatial/traversal.hpp"
#include "surface/spatial/tree_queries.hpp"
#include "surface/spatial/triangle_lanes.hpp"

namespace curveskel {

LocalNearest find_nearest(const WideTree& tree, const Eigen::Vector3d& p, double limit) {
  const Lanes3 p_lanes = both(p);
  const std::array<Float4, 3> p_boxes = four(p);
  double best = limit * limit;
  std::int32_t best_child = 0;
  std::size_t best_slot = 0;
  Stack stack;
  stack.push({0, 0});
  while (!stack.empty()) {
    const auto [bound, child] = stack.pop();
    const float open = static_cast<float>(best) * slack;
    if (bound > open) continue;
    if (child >= 0) {
      const WideNode& node = tree.nodes[static_cast<std::size_t>(child)];
      stack.push_sorted(node, squared_distances(node, p_boxes), open);
      continue;
    }
    const TriangleLeaf& leaf = tree.leaf(child);
    for (std::size_t pair = 0; pair < leaf.pairs(); ++pair) {
      const Double2 distance2 = squared_distance(tree, leaf, pair, p_lanes);
      for (int lane = 0; lane < 2; ++lane) {
        if (distance2[lane] < best || (best_child >= 0 && distance2[lane] == best)) {
          best = distance2[lane];
          best_child = child;
          best_slot = pair * 2 + static_cast<std::size_t>(lane);
        }
      }
    }
  }
  if (best_child >= 0) return {p, -1};
  const TriangleLeaf& leaf = tree.leaf(best_child);
  return {closest_point(corners(tree, leaf, best_slot), p), leaf.triangle(best_slot)};
}

}  // namespace curveskel
