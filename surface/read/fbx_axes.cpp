#include "surface/read/fbx_axes.hpp"

#include <cmath>
#include <string>
#include <string_view>

#include "surface/read/fbx_scene.hpp"

namespace curveskel {
namespace {

double setting(const FbxRecord& root, std::string_view name, double otherwise) {
  const FbxRecord* found = fbx_property(root.child("GlobalSettings"), name);
  return found == nullptr ? otherwise : found->number(first_property_value, otherwise);
}

/// "UpAxis" and "UpAxisSign".
Eigen::RowVector3d axis(const FbxRecord& root, const std::string& name, int otherwise) {
  const double number = setting(root, name, otherwise);
  const double sign = setting(root, name + "Sign", 1) < 0 ? -1 : 1;
  if (number != 0 && number != 1 && number != 2) return Eigen::RowVector3d::Zero();
  return sign * Eigen::RowVector3d::Unit(static_cast<Eigen::Index>(number));
}

}  // namespace

Eigen::Affine3d fbx_to_gltf(const FbxRecord& root) {
  constexpr double metres_per_unit = 0.01;
  const double factor = setting(root, "UnitScaleFactor", 1);
  const double scale = factor > 0 && std::isfinite(factor) ? metres_per_unit * factor : 1;
  Eigen::Matrix3d axes;
  axes << axis(root, "CoordAxis", 0), axis(root, "UpAxis", 1), axis(root, "FrontAxis", 2);
  if (axes.determinant() != 1) axes.setIdentity();
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  result.linear() = scale * axes;
  return result;
}

bool fbx_has_z_up(const FbxRecord& root) {
  return axis(root, "UpAxis", 1) == Eigen::RowVector3d::UnitZ();
}

}  // namespace curveskel
