// Closed tubes of which every section is known.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Around the x axis from 0 to `length`, `rings` rings of `sides` corners; half axes a(x) along y
/// and b(x) along z. The ends are closed by one vertex each.
template <typename HalfAxis>
Surface straight_tube(double length, int rings, int sides, const HalfAxis& a, const HalfAxis& b) {
  Surface tube;
  const int count = rings * sides;
  tube.positions.resize(count + 2, 3);
  for (int ring = 0; ring < rings; ++ring) {
    const double x = length * ring / (rings - 1);
    for (int side = 0; side < sides; ++side) {
      const double angle = 2 * std::numbers::pi * side / sides;
      const int vertex = ring * sides + side;
      tube.positions.row(vertex) << x, a(x) * std::cos(angle), b(x) * std::sin(angle);
    }
  }
  tube.positions.row(count) << 0, 0, 0;
  tube.positions.row(count + 1) << length, 0, 0;
  const int faces = 2 * count;
  tube.triangles.resize(faces, 3);
  int face = 0;
  for (int side = 0; side < sides; ++side) {
    const int next = (side + 1) % sides;
    tube.triangles.row(face++) << count, next, side;
    for (int ring = 0; ring + 1 < rings; ++ring) {
      const int here = ring * sides;
      tube.triangles.row(face++) << here + side, here + next, here + sides + next;
      tube.triangles.row(face++) << here + side, here + sides + next, here + sides + side;
    }
    const int last = (rings - 1) * sides;
    tube.triangles.row(face++) << count + 1, last + side, last + next;
  }
  return tube;
}

/// Both, side by side in one.
inline Surface together(const Surface& a, const Surface& b) {
  Surface both;
  both.positions.resize(a.positions.rows() + b.positions.rows(), 3);
  both.positions << a.positions, b.positions;
  both.triangles.resize(a.triangles.rows() + b.triangles.rows(), 3);
  const Triangles moved = b.triangles.array() + static_cast<std::int32_t>(a.positions.rows());
  both.triangles << a.triangles, moved;
  return both;
}

inline Surface turned_inside_out(Surface surface) {
  surface.triangles.col(1).swap(surface.triangles.col(2));
  return surface;
}

inline Surface moved(Surface surface, const Eigen::Matrix3d& by, const Eigen::Vector3d& to) {
  surface.positions = (surface.positions * by.transpose()).rowwise() + to.transpose();
  return surface;
}

/// Through the points, the radii as given.
inline CurveSkeleton chain(const Positions& points, double radius) {
  CurveSkeleton skeleton;
  skeleton.nodes = points;
  skeleton.radii = Eigen::VectorXd::Constant(points.rows(), radius);
  skeleton.edges.resize(points.rows() - 1, 2);
  for (int k = 0; k + 1 < points.rows(); ++k) skeleton.edges.row(k) << k, k + 1;
  return skeleton;
}

inline Positions points_on_x(double from, double to, int count) {
  Positions points = Positions::Zero(count, 3);
  points.col(0) = Eigen::VectorXd::LinSpaced(count, from, to);
  return points;
}

}  // namespace curveskel
