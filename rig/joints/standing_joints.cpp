#include "rig/joints/standing_joints.hpp"

#include <string>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include "rig/skin/skin_bones.hpp"

namespace curveskel {
namespace {

/// Beyond the joint, in the direction in which the bone before it leads to it.
Eigen::RowVector3d straight_on_from(const PlannedJoint& joint, const PlannedJoint& parent,
                                    const SurfaceTree& tree) {
  const Eigen::RowVector3d way = joint.position - parent.position;
  const double length = way.norm();
  if (!(length > 0)) return joint.position;
  const Eigen::RowVector3d ahead = way / length;
  const SurfaceTree::Hit exit = tree.ray(joint.position.transpose(), ahead.transpose());
  return joint.position + (exit.triangle < 0 ? length : exit.distance) * ahead;
}

}  // namespace

Joints standing_joints(const Surface& surface, const CurveSkeleton& skeleton,
                       const std::vector<PlannedJoint>& planned, int threads) {
  const SurfaceTree tree(surface, threads);
  std::vector<char> is_last(planned.size(), 1);
  std::vector<Eigen::RowVector3d> points;
  std::vector<int> parents;
  Joints joints;
  for (const PlannedJoint& joint : planned) {
    points.push_back(joint.position);
    parents.push_back(joint.parent);
    joints.names.push_back(joint.role);
    if (joint.parent >= 0) is_last[idx(joint.parent)] = 0;
  }
  int ends = 0;
  for (std::size_t k = 0; k < planned.size(); ++k) {
    const PlannedJoint& joint = planned[k];
    if (is_last[k] == 0 || joint.parent < 0) continue;
    points.push_back(joint.end ? *joint.end
                               : straight_on_from(joint, planned[idx(joint.parent)], tree));
    parents.push_back(static_cast<int>(k));
    joints.names.push_back("limb" + std::to_string(++ends) + "_end");
  }
  const auto count = static_cast<Eigen::Index>(points.size());
  joints.positions.resize(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) joints.positions.row(k) = points[idx(k)];
  joints.parents = Eigen::Map<const Eigen::VectorXi>(parents.data(), count);
  joints.joint_of_node = joints_of_nodes(skeleton, bones_for_all(joints.positions, joints.parents));
  return joints;
}

}  // namespace curveskel
