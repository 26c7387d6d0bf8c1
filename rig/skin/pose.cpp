#include <curveskel/pose.hpp>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "rig/joints/sound_rig.hpp"

namespace curveskel {
namespace {

void require_motion_of_each(const Rig& rig, std::size_t found, const char* purpose,
                            const char* things) {
  if (found == idx(rig.joints.rows())) return;
  throw Error(Fault::input, std::string(purpose) + ": found " + std::to_string(found) + " " +
                                things + ", needed one for each of the rig's " +
                                std::to_string(rig.joints.rows()) + " joints");
}

}  // namespace

std::vector<Eigen::Isometry3d> joint_motions(const Rig& rig, const JointTurns& turns) {
  require_hierarchy(rig, "joint_motions");
  require_motion_of_each(rig, turns.size(), "joint_motions", "turns");
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
  require_motion_of_each(rig, motions.size(), "moved_joints", "motions");
  Positions moved = rig.joints;
  for (Eigen::Index joint = 0; joint < moved.rows(); ++joint) {
    moved.row(joint) = (motions[idx(joint)] * rig.joints.row(joint).transpose()).transpose();
  }
  return moved;
}

Positions moved_surface(const Positions& positions, const Rig& rig,
                        const std::vector<Eigen::Isometry3d>& motions) {
  require_motion_of_each(rig, motions.size(), "moved_surface", "motions");
  require_motion_of_each(rig, idx(rig.weights.cols()), "moved_surface", "joints in the weights");
  require_weights_of(rig, positions.rows(), "moved_surface");
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
