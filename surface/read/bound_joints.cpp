#include "surface/read/bound_joints.hpp"

#include <algorithm>

namespace curveskel {

bool are_posed(const std::vector<BoundJoint>& joints) {
  if (joints.empty()) return false;
  constexpr double alike = 1e-4;
  Eigen::AlignedBox3d box;
  for (const BoundJoint& joint : joints) box.extend(joint.bound.translation().eval());
  const Eigen::Affine3d first = joints.front().move();
  const double scale = first.linear().norm();
  return std::any_of(joints.begin(), joints.end(), [&](const BoundJoint& joint) {
    const Eigen::Affine3d move = joint.move();
    const Eigen::Vector3d place = joint.bound.translation();
    return (move.linear() - first.linear()).norm() > alike * scale ||
           (move * place - first * place).norm() > alike * scale * box.diagonal().norm();
  });
}

bool are_alike(const std::vector<Eigen::Affine3d>& frames, double size) {
  constexpr double alike = 1e-3;
  return std::all_of(frames.begin(), frames.end(), [&](const Eigen::Affine3d& frame) {
    const Eigen::Affine3d& first = frames.front();
    return (frame.linear() - first.linear()).norm() <= alike * first.linear().norm() &&
           (frame.translation() - first.translation()).norm() <= alike * size;
  });
}

}  // namespace curveskel
