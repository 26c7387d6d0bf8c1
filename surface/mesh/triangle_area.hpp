// The area of one triangle, for all sums over triangles.
#pragma once

#include <Eigen/Geometry>

#include <curveskel/surface.hpp>

namespace curveskel {

/// In square model units; sums of many are halved once.
[[nodiscard]] inline double twice_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                       const Eigen::Vector3d& c) {
  return (b - a).cross(c - a).norm();
}

/// Of a face by its number. Precondition: it is one of the surface's.
[[nodiscard]] inline double twice_area(const Surface& surface, Eigen::Index face) {
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return surface.positions.row(surface.triangles(face, k)).transpose();
  };
  return twice_area(corner(0), corner(1), corner(2));
}

}  // namespace curveskel
