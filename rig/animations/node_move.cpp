#include "rig/animations/node_move.hpp"

namespace curveskel {

NodeMove node_move(const Eigen::Affine3d& frame) {
  NodeMove move{frame.translation(), Eigen::Quaterniond::Identity(),
                frame.linear().colwise().norm()};
  if (frame.linear().determinant() < 0) move.scale.x() *= -1;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    if (move.scale[axis] != 0) turn.col(axis) = frame.linear().col(axis) / move.scale[axis];
  }
  move.turn = Eigen::Quaterniond(turn).normalized();
  return move;
}

Eigen::Affine3d frame_between(const Eigen::Affine3d& from, const Eigen::Affine3d& to,
                              double share) {
  const NodeMove first = node_move(from);
  const NodeMove last = node_move(to);
  const Eigen::Vector3d shift = (1 - share) * first.shift + share * last.shift;
  const Eigen::Vector3d scale = (1 - share) * first.scale + share * last.scale;
  return Eigen::Translation3d(shift) * first.turn.slerp(share, last.turn) * Eigen::Scaling(scale);
}

}  // namespace curveskel
