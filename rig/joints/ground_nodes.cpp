#include "rig/joints/ground_nodes.hpp"

#include <Eigen/Geometry>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>

namespace curveskel {

std::vector<int> ground_nodes(const Surface& surface, const CurveSkeleton& skeleton,
                              const BodyPlan& plan) {
  if (plan.joints.empty() || skeleton.node_of_vertex.size() != surface.positions.rows()) return {};
  const auto count = static_cast<int>(skeleton.nodes.rows());
  UnionFind joined(count);
  for (const auto& edge : skeleton.edges.rowwise()) joined.unite(edge[0], edge[1]);
  std::vector<char> is_figure(idx(count), 0);  // by root
  for (const PlannedJoint& joint : plan.joints) {
    if (joint.node >= 0) is_figure[idx(joined.root(joint.node))] = 1;
  }
  std::vector<Eigen::AlignedBox3d> boxes(idx(count));  // by root, in the plan's axes
  Eigen::AlignedBox3d figure;
  for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
    const int node = skeleton.node_of_vertex[v];
    if (node < 0) continue;
    const Eigen::Vector3d place = plan.axes * surface.positions.row(v).transpose();
    const std::size_t root = idx(joined.root(node));
    boxes[root].extend(place);
    if (is_figure[root] != 0) figure.extend(place);
  }
  const auto is_ground = [&](std::size_t root) {
    const Eigen::AlignedBox3d& box = boxes[root];
    if (is_figure[root] != 0 || box.isEmpty() || figure.isEmpty()) return false;
    const bool is_below = box.max().y() < figure.center().y();
    return is_below && box.min().x() < figure.min().x() && box.max().x() > figure.max().x() &&
           box.min().z() < figure.min().z() && box.max().z() > figure.max().z();
  };
  std::vector<int> nodes;
  for (int node = 0; node < count; ++node) {
    if (is_ground(idx(joined.root(node)))) nodes.push_back(node);
  }
  return nodes;
}

}  // namespace curveskel
