#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "base/wide_vectors.hpp"
#include "surface/spatial/traversal.hpp"
#include "surface/spatial/tree_queries.hpp"
#include "surface/spatial/triangle_lanes.hpp"

namespace curveskel {

CURVESKEL_WIDE_VECTORS
LocalNearest find_nearest(const WideTree& tree, const Eigen::Vector3d& p, double limit) {
  const auto p_lanes = spread<Double4>(p);
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
    const Double4 distance2 =
        squared_distance(corners_of_leaf(tree, leaf, 0), corners_of_leaf(tree, leaf, 1),
                         corners_of_leaf(tree, leaf, 2), p_lanes);
    if (!(least_of(distance2) <= best)) continue;
    for (int place = 0; place < 4; ++place) {
      if (distance2[place] < best || (best_child >= 0 && distance2[place] == best)) {
        best = distance2[place];
        best_child = child;
        best_slot = static_cast<std::size_t>(place);
      }
    }
  }
  if (best_child >= 0) return {p, -1};
  const TriangleLeaf& leaf = tree.leaf(best_child);
  return {closest_point(corners(tree, leaf, best_slot), p), leaf.triangle(best_slot)};
}

}  // namespace curveskel
