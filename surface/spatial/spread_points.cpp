#include "surface/spatial/spread_points.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace curveskel {

using Eigen::Vector3d;

std::vector<Eigen::Vector3d> spread_points(const Surface& surface, int count) {
  const Eigen::Index triangles = surface.triangles.rows();
  const auto corner = [&](Eigen::Index t, int k) -> Vector3d {
    return surface.positions.row(surface.triangles(t, k));
  };
  if (triangles == 0) return {};
  // Squares of areas leave the range of numbers at sizes of 1e-79 and 1e77; a power of two changes
  // no digit.
  int exponent = 0;
  const Vector3d extent =
      surface.positions.colwise().maxCoeff() - surface.positions.colwise().minCoeff();
  (void)std::frexp(extent.maxCoeff(), &exponent);
  const double scale = std::ldexp(1, -exponent);
  std::vector<double> area_up_to;
  area_up_to.reserve(static_cast<std::size_t>(triangles));
  double area = 0;
  for (Eigen::Index t = 0; t < triangles; ++t) {
    const Vector3d a = corner(t, 0);
    const Vector3d one = scale * (corner(t, 1) - a);
    const Vector3d other = scale * (corner(t, 2) - a);
    area += 0.5 * one.cross(other).norm();
    area_up_to.push_back(area);
  }
  std::vector<Vector3d> points;
  if (!(area > 0)) return points;
  points.reserve(static_cast<std::size_t>(count));
  Eigen::Index t = 0;
  for (int i = 0; i < count; ++i) {
    const double wanted = area * (i + 0.5) / count;
    while (t + 1 < triangles && area_up_to[static_cast<std::size_t>(t)] < wanted) ++t;
    double whole = 0;
    double u = std::modf(0.5 + i * 0.7548776662466927, &whole);
    double v = std::modf(0.5 + i * 0.5698402909980532, &whole);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vector3d a = corner(t, 0);
    points.emplace_back(a + u * (corner(t, 1) - a) + v * (corner(t, 2) - a));
  }
  return points;
}

}  // namespace curveskel
