#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "surface/spatial/traversal.hpp"
#include "surface/spatial/tree_queries.hpp"

namespace curveskel {
namespace {

/// The children whose boxes the plane meets are below 1, the others above.
Float4 misses(const WideNode& node, const std::array<Float4, 3>& p,
              const std::array<Float4, 3>& normal) {
  Float4 least = four(0);
  Float4 most = four(0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Float4 a = (node.lo[axis] - p[axis]) * normal[axis];
    const Float4 b = (node.hi[axis] - p[axis]) * normal[axis];
    least += minimum(a, b);
    most += maximum(a, b);
  }
  const Float4 margin = four(static_cast<double>(box_margin));
  const Float4 unused = node.lo[0] > node.hi[0] ? four(2) : four(0);
  const Float4 below = least <= margin ? four(0) : four(2);
  const Float4 above = most >= -margin ? four(0) : four(2);
  return maximum(maximum(below, above), unused);
}

}  // namespace

std::vector<int> find_near_plane(const WideTree& tree, const Eigen::Vector3d& p,
                                 const Eigen::Vector3d& normal) {
  const std::array<Float4, 3> p_boxes = four(p);
  const std::array<Float4, 3> n_boxes = four(normal);
  std::vector<int> triangles;
  Stack stack;
  stack.push({0, 0});
  while (!stack.empty()) {
    const std::int32_t child = stack.pop().child;
    if (child >= 0) {
      const WideNode& node = tree.nodes[static_cast<std::size_t>(child)];
      stack.push_sorted(node, misses(node, p_boxes, n_boxes), 1);
      continue;
    }
    const TriangleLeaf& leaf = tree.leaf(child);
    for (std::size_t place = 0; place < 4; ++place) {
      if (!leaf.repeated(place)) triangles.push_back(leaf.triangle(place));
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace curveskel
