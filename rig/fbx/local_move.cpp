#include "rig/fbx/local_move.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rig/animations/node_move.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

Vector3d angles_of(const Eigen::Matrix3d& turn) {
  const double sine = std::clamp(-turn(2, 0), -1.0, 1.0);
  constexpr double upright = 1 - 1e-12;
  Vector3d angles(0, std::asin(sine), 0);
  if (std::abs(sine) < upright) {
    angles.x() = std::atan2(turn(2, 1), turn(2, 2));
    angles.z() = std::atan2(turn(1, 0), turn(0, 0));
  } else {
    angles.z() = std::atan2(-turn(0, 1), turn(1, 1));
  }
  return angles * (180 / std::numbers::pi);
}

/// By whole turns.
Vector3d moved_near(const Vector3d& angles, const Vector3d& before) {
  constexpr double whole = 360;
  return angles.array() + whole * ((before - angles).array() / whole).round();
}

}  // namespace

FbxMove local_move(const Eigen::Affine3d& frame) {
  const NodeMove move = node_move(frame);
  return {move.shift, angles_of(move.turn.toRotationMatrix()), move.scale};
}

Vector3d nearest_angles(const Vector3d& angles, const Vector3d& before) {
  constexpr double half = 180;
  const Vector3d other(angles.x() + half, half - angles.y(), angles.z() + half);
  const Vector3d first = moved_near(angles, before);
  const Vector3d second = moved_near(other, before);
  return (first - before).squaredNorm() <= (second - before).squaredNorm() ? first : second;
}

}  // namespace curveskel
