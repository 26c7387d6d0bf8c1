#include "rig/plan/frames.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include <curveskel/error.hpp>

namespace curveskel {
namespace {

using Eigen::Vector3d;

Vector3d vector_of(Direction direction) {
  switch (direction) {
    case Direction::x:
      return Vector3d::UnitX();
    case Direction::y:
      return Vector3d::UnitY();
    case Direction::z:
      return Vector3d::UnitZ();
    case Direction::minus_x:
      return -Vector3d::UnitX();
    case Direction::minus_y:
      return -Vector3d::UnitY();
    case Direction::minus_z:
      return -Vector3d::UnitZ();
    case Direction::automatic:
      break;
  }
  return Vector3d::Zero();
}

Eigen::Matrix3d axes_of(const Vector3d& up, const Vector3d& front) {
  Eigen::Matrix3d axes;
  axes << up.cross(front).transpose(), up.transpose(), front.transpose();
  return axes;
}

}  // namespace

Direction direction_of(const Vector3d& axis) {
  const auto is_along = [&](const auto& one) { return vector_of(one.value).dot(axis) > 0.5; };
  return std::find_if(directions.begin(), directions.end(), is_along)->value;
}

std::vector<Eigen::Matrix3d> frames_of(const PlanOptions& options) {
  // The usual ones first: y up and z ahead, as in glTF, or z up and -y ahead, as in Blender; then
  // those of a body that looks aside.
  std::vector<Vector3d> ups{vector_of(options.up)};
  if (options.up == Direction::automatic) ups = {Vector3d::UnitY(), Vector3d::UnitZ()};
  if (options.up == Direction::automatic && options.z_is_up) std::swap(ups[0], ups[1]);
  std::vector<Eigen::Matrix3d> frames;
  const auto add = [&](const Vector3d& up, const Vector3d& front) {
    if (up.cross(front).norm() > 0) frames.push_back(axes_of(up, front));
  };
  for (const Vector3d& up : ups) {
    if (options.front != Direction::automatic) {
      add(up, vector_of(options.front));
      continue;
    }
    const bool lies_along_z = up.cross(Vector3d::UnitZ()).norm() == 0;
    const Vector3d usual =
        lies_along_z ? Vector3d(-Vector3d::UnitY()) : Vector3d(Vector3d::UnitZ());
    add(up, options.faces_minus_z ? Vector3d(-usual) : usual);
    add(up, up.cross(usual));
  }
  if (frames.empty()) {
    throw Error(Fault::usage,
                "up and front are one direction, needed two that are normal to each "
                "other; give another --up or --front");
  }
  return frames;
}

std::vector<Eigen::Matrix3d> frames_of_lying(const PlanOptions& options) {
  std::vector<Eigen::Matrix3d> frames;
  if (options.up != Direction::automatic) return frames;
  for (const Direction up : {Direction::x, Direction::minus_x, Direction::minus_z}) {
    PlanOptions turned = options;
    turned.up = up;
    if (options.front != Direction::automatic &&
        vector_of(up).cross(vector_of(options.front)).norm() == 0) {
      continue;
    }
    const std::vector<Eigen::Matrix3d> more = frames_of(turned);
    frames.insert(frames.end(), more.begin(), more.end());
  }
  return frames;
}

}  // namespace curveskel
