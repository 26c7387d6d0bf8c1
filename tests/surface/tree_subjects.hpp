// Surfaces for laws of the tree, and slow answers to hold its against.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel::tree_subjects {

using Eigen::Vector3d;

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct Shape {
  std::string name;
  Surface surface;
};

inline Surface surface_of(const std::vector<Vector3d>& points,
                          const std::vector<std::array<int, 3>>& faces) {
  Surface surface;
  surface.positions.resize(static_cast<Eigen::Index>(points.size()), 3);
  surface.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    surface.positions.row(static_cast<Eigen::Index>(i)) = points[i];
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    surface.triangles.row(static_cast<Eigen::Index>(i)) << faces[i][0], faces[i][1], faces[i][2];
  }
  return surface;
}

inline Surface unit_cube() {
  return surface_of(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
      {{0, 2, 1},
       {0, 3, 2},
       {4, 5, 6},
       {4, 6, 7},
       {0, 1, 5},
       {0, 5, 4},
       {1, 2, 6},
       {1, 6, 5},
       {2, 3, 7},
       {2, 7, 6},
       {3, 0, 4},
       {3, 4, 7}});
}

// Unit sphere of rings and sectors; `bump` moves the radius by that share.
inline Surface sphere(int rings, double bump = 0) {
  const int sectors = 2 * rings;
  std::vector<Vector3d> points;
  const auto point = [&](double latitude, double longitude) {
    const double r = 1 + bump * std::sin(5 * latitude) * std::cos(3 * longitude + latitude);
    return Vector3d(r * std::sin(latitude) * std::cos(longitude),
                    r * std::sin(latitude) * std::sin(longitude), r * std::cos(latitude));
  };
  for (int i = 1; i < rings; ++i) {
    for (int j = 0; j < sectors; ++j) points.push_back(point(pi * i / rings, 2 * pi * j / sectors));
  }
  const auto north = static_cast<int>(points.size());
  const int south = north + 1;
  points.emplace_back(0, 0, 1);
  points.emplace_back(0, 0, -1);
  std::vector<std::array<int, 3>> faces;
  for (int j = 0; j < sectors; ++j) {
    const int k = (j + 1) % sectors;
    faces.push_back({north, j, k});
    faces.push_back({south, (rings - 2) * sectors + k, (rings - 2) * sectors + j});
    for (int i = 0; i + 2 < rings; ++i) {
      const int a = i * sectors + j;
      const int b = i * sectors + k;
      faces.push_back({a, a + sectors, b});
      faces.push_back({b, a + sectors, b + sectors});
    }
  }
  return surface_of(points, faces);
}

// Around the z axis, main radius 1.
inline Surface torus(double tube, int around, int across) {
  std::vector<Vector3d> points;
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2 * pi * i / around;
      const double v = 2 * pi * j / across;
      const double r = 1 + tube * std::cos(v);
      points.emplace_back(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
      const int a = i * across + j;
      const int b = (i + 1) % around * across + j;
      const int c = i * across + (j + 1) % across;
      const int d = (i + 1) % around * across + (j + 1) % across;
      faces.push_back({a, b, c});
      faces.push_back({c, b, d});
    }
  }
  return surface_of(points, faces);
}

inline Surface placed(Surface surface, double scale, const Vector3d& offset) {
  surface.positions *= scale;
  surface.positions.rowwise() += offset.transpose();
  return surface;
}

inline std::vector<Shape> all_shapes() {
  return {{"cube", unit_cube()},
          {"sphere", sphere(12)},
          {"bumpy sphere", sphere(24, 0.3)},
          {"torus", torus(0.3, 24, 12)},
          {"long triangles", torus(0.01, 5, 40)},
          {"tiny", placed(sphere(8, 0.2), 1e-12, {0, 0, 0})},
          {"huge", placed(torus(0.4, 16, 8), 1e12, {0, 0, 0})},
          {"far off", placed(sphere(8, 0.2), 1, {200, -300, 100})}};
}

class Points {
 public:
  explicit Points(const Surface& surface)
      : lower_(surface.positions.colwise().minCoeff()),
        extent_(surface.positions.colwise().maxCoeff().transpose() - lower_) {}
  // Within the bounding box, grown by half on every side.
  Vector3d next() {
    return lower_ + extent_.cwiseProduct(Vector3d(uniform(), uniform(), uniform()));
  }
  Vector3d direction() {
    Vector3d d(uniform() - 0.5, uniform() - 0.5, uniform() - 0.5);
    return d.normalized();
  }

 private:
  double uniform() { return std::uniform_real_distribution<>(-0.5, 1.5)(generator_); }
  std::mt19937 generator_{7};
  Vector3d lower_;
  Vector3d extent_;
};

// Ericson's region test, a different way than the tree's.
inline Vector3d closest_in_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                                    const Vector3d& c) {
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  return a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc));
}

inline Vector3d corner(const Surface& surface, int face, int k) {
  return surface.positions.row(surface.triangles(face, k));
}

inline double brute_distance(const Surface& surface, const Vector3d& p) {
  double best = std::numeric_limits<double>::infinity();
  for (int f = 0; f < surface.triangles.rows(); ++f) {
    const Vector3d q =
        closest_in_triangle(p, corner(surface, f, 0), corner(surface, f, 1), corner(surface, f, 2));
    best = std::min(best, (q - p).norm());
  }
  return best;
}

// Sum of the triangles' solid angles / 4 pi (Van Oosterom and Strackee 1983).
inline double winding_number(const Surface& surface, const Vector3d& p) {
  double sum = 0;
  for (int f = 0; f < surface.triangles.rows(); ++f) {
    const Vector3d a = corner(surface, f, 0) - p;
    const Vector3d b = corner(surface, f, 1) - p;
    const Vector3d c = corner(surface, f, 2) - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    sum +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2 * pi);
}

}  // namespace curveskel::tree_subjects
