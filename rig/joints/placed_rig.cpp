#include "rig/joints/placed_rig.hpp"

#include <cmath>

namespace curveskel {

Rig placed(Rig rig, const Eigen::Affine3d& place) {
  rig.to_y_up.setIdentity();
  if (place.matrix() == Eigen::Matrix4d::Identity()) return rig;
  rig.joints =
      (rig.joints * place.linear().transpose()).rowwise() + place.translation().transpose();
  const double scale = std::cbrt(place.linear().determinant());
  const Eigen::Quaterniond turn(Eigen::Matrix3d(place.linear() / scale));
  for (Eigen::Quaterniond& rests : rig.turns) rests = turn * rests * turn.conjugate();
  return rig;
}

}  // namespace curveskel
