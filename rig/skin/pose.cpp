#include <curveskel/pose.hpp>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

std::vector<Eigen::Isometry3d> joint_motions(const Rig& rig, const JointTurns& turns) {
  std::vector<Eigen::Isometry3d> motions;
  motions.reserve(turns.size());
  for (Eigen::Index joint = 0; joint < rig.joints.rows(); ++joint) {
    const Eigen::Vector3d place = rig.joints.row(joint).transpose();
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    if (rig.parents[joint] >= 0) motion = motions[idx(rig.parents[joint])];
    motion.translate(place).rotate(turns[idx(joint)]).translate(-place);
    motions.push_back(motion);
  }
  return motions;
}

Positions moved_joints(const Rig& rig, const std::vector<Eigen::Isometry3d>& motions) {
  Positions moved = rig.joints;
  for (Eigen::Index joint = 0; joint < moved.rows(); ++joint) {
    moved.row(joint) = (motions[idx(joint)] * rig.joints.row(joint).transpose()).transpose();
  }
  return moved;
}

Positions moved_surface(const Positions& positions, const Rig& rig,
                        const std::vector<Eigen::Isometry3d>& motions) {
  Positions moved = positions;
  for (Eigen::Index vertex = 0; vertex < positions.rows(); ++vertex) {
    const Eigen::Vector3d place = positions.row(vertex).transpose();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weight = 0;
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      const auto share = static_cast<double>(it.value());
      sum += share * (motions[idx(it.col())] * place);
      weight += share;
    }
    if (weight > 0) moved.row(vertex) = (sum / weight).transpose();
  }
  return moved;
}

}  // namespace curveskel
