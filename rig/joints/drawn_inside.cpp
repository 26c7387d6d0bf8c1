#include "rig/joints/drawn_inside.hpp"

#include <limits>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>

namespace curveskel {
namespace {

bool is_one_piece(const CurveSkeleton& skeleton) {
  for (const int component : connected_components(skeleton.nodes.rows(), skeleton.edges)) {
    if (component != 0) return false;
  }
  return true;
}

/// -1 if there is none.
Eigen::Index nearest_own_node(const Joints& joints, Eigen::Index joint,
                              const CurveSkeleton& skeleton) {
  Eigen::Index best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index node = 0; node < skeleton.nodes.rows(); ++node) {
    const int owner = joints.joint_of_node[node];
    if (owner != joint && owner != joints.parents[joint]) continue;
    const double off = (skeleton.nodes.row(node) - joints.positions.row(joint)).squaredNorm();
    if (off >= least) continue;
    least = off;
    best = node;
  }
  return best;
}

}  // namespace

void draw_inside(Joints& joints, const Surface& surface, const CurveSkeleton& skeleton,
                 int threads) {
  if (!is_one_piece(skeleton)) return;
  const SurfaceTree tree(surface, threads);
  for (Eigen::Index joint = 0; joint < joints.positions.rows(); ++joint) {
    if (tree.inside(joints.positions.row(joint).transpose())) continue;
    const Eigen::Index node = nearest_own_node(joints, joint, skeleton);
    if (node >= 0) joints.positions.row(joint) = skeleton.nodes.row(node);
  }
}

}  // namespace curveskel
