#include "rig/plan/tubes.hpp"

#include <algorithm>
#include <cstddef>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

using Eigen::Vector3d;

int node_next_to(const CurveTree& tree, const Vector3d& point) {
  const auto off = [&](const Vector3d& node) { return (node - point).squaredNorm(); };
  const auto nearest =
      std::min_element(tree.nodes.begin(), tree.nodes.end(),
                       [&](const Vector3d& a, const Vector3d& b) { return off(a) < off(b); });
  return static_cast<int>(nearest - tree.nodes.begin());
}

}  // namespace

std::vector<PointOfNode> points_by_nodes(const CurveTree& tree) {
  constexpr std::size_t every = 8;  // of 20,000
  std::vector<PointOfNode> points;
  for (std::size_t k = 0; k < tree.spread.size(); k += every) {
    points.push_back({tree.spread[k], node_next_to(tree, tree.spread[k])});
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
