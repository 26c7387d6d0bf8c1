#include "rig/plan/trunk.hpp"

#include <algorithm>
#include <cmath>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

using Eigen::Vector3d;

Vector3d Along::at(double wanted) const {
  std::size_t k = 0;
  while (k + 2 < points.size() && way[k + 1] < wanted) ++k;
  if (points.size() < 2) return points.front();
  const double step = way[k + 1] - way[k];
  const double share = step > 0 ? std::clamp((wanted - way[k]) / step, 0.0, 1.0) : 0;
  return points[k] + share * (points[k + 1] - points[k]);
}

Along along(const CurveTree& tree, const std::vector<int>& path) {
  Along line;
  for (const int node : path) {
    line.points.push_back(tree.nodes[idx(node)]);
    line.points.back().x() = tree.middle;
    line.way.push_back(line.way.empty()
                           ? 0
                           : line.way.back() +
                                 (line.points.back() - line.points[line.points.size() - 2]).norm());
  }
  return line;
}

int nose_of(const CurveTree& tree, int front, const Ways& ways) {
  int nose = front;
  for (int node = 0; node < static_cast<int>(tree.nodes.size()); ++node) {
    const bool is_ahead =
        tree.nodes[idx(node)].z() > tree.nodes[idx(front)].z() - 0.02 * tree.size &&
        std::abs(tree.aside(node)) < 0.03 * tree.size;
    if (is_ahead && ways.distance[idx(node)] > ways.distance[idx(nose)]) nose = node;
  }
  return nose;
}

int tail_of(const CurveTree& tree, int hips, const Ways& ways) {
  int tail = hips;
  for (int node = 0; node < static_cast<int>(tree.nodes.size()); ++node) {
    const bool is_behind = tree.nodes[idx(node)].z() < tree.nodes[idx(hips)].z() &&
                           std::abs(tree.aside(node)) < 0.03 * tree.size;
    if (is_behind && ways.distance[idx(node)] > ways.distance[idx(tail)]) tail = node;
  }
  return tail;
}

}  // namespace curveskel
