// The XML of a 3MF model part. Internal to surface/.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include <curveskel/monitor.hpp>
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// An object placed: by the build or inside another object.
struct Placed3mf {
  std::size_t object = 0;  ///< number in `objects`
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
};

/// Either a mesh or components, each of which is an earlier object.
struct Object3mf {
  std::vector<double> coordinates;    ///< x y z x y z ...
  std::vector<std::int32_t> corners;  ///< three per triangle, all within its vertices
  std::vector<Placed3mf> components;
  bool is_support = false;  ///< holds others while they are printed, and is broken off
};

struct Model3mf {
  double millimetres = 1;  ///< of the file's unit
  std::vector<Object3mf> objects;
  std::vector<Placed3mf> items;  ///< what is to be built, without supports
};

/// Throws Error(Fault::input) with the line, and for extensions that are required and unknown here,
/// the production extension's parts in other files among them, by name. O(bytes).
[[nodiscard]] Model3mf parse_3mf_model(const FileBytes& part, const Monitor& monitor);

}  // namespace curveskel
