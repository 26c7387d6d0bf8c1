// A node's frame as glTF has it: a shift, a turn and a scale. Internal to rig/.
#pragma once

#include <Eigen/Geometry>

namespace curveskel {

struct NodeMove {
  Eigen::Vector3d shift;
  Eigen::Quaterniond turn;
  Eigen::Vector3d scale;
};

/// Without the shear, if there is any.
[[nodiscard]] NodeMove node_move(const Eigen::Affine3d& frame);

/// The frame at a share, 0 to 1, of the way from one to another, as glTF goes it.
[[nodiscard]] Eigen::Affine3d frame_between(const Eigen::Affine3d& from, const Eigen::Affine3d& to,
                                            double share);

}  // namespace curveskel
