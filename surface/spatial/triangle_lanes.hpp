// Distances and ray crossings, two triangles at a time. Internal to surface/.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "surface/spatial/wide_tree.hpp"

namespace curveskel {

struct Lanes3 {
  Double2 x, y, z;
};
[[nodiscard]] inline Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] inline Double2 dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] inline Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline Lanes3 both(const Eigen::Vector3d& v) {
  return {Double2{v.x(), v.x()}, Double2{v.y(), v.y()}, Double2{v.z(), v.z()}};
}
[[nodiscard]] inline Double2 minimum(Double2 a, Double2 b) { return a < b ? a : b; }
[[nodiscard]] inline Double2 maximum(Double2 a, Double2 b) { return a > b ? a : b; }

/// Corner k of places 2 * pair and 2 * pair + 1.
[[nodiscard]] inline Lanes3 corner_lanes(const WideTree& tree, const TriangleLeaf& leaf,
                                         std::size_t k, std::size_t pair) {
  const Eigen::Vector3d& p = tree.vertices[static_cast<std::size_t>(leaf.vertex[k][2 * pair])];
  const Eigen::Vector3d& q = tree.vertices[static_cast<std::size_t>(leaf.vertex[k][2 * pair + 1])];
  return {Double2{p.x(), q.x()}, Double2{p.y(), q.y()}, Double2{p.z(), q.z()}};
}

/// Squared distance from the segment's start + along the offset `from_start` to the segment.
[[nodiscard]] inline Double2 squared_distance_to_segment(const Lanes3& from_start,
                                                         const Lanes3& segment) {
  const Double2 zero{0, 0};
  const Double2 one{1, 1};
  const Double2 tiny{1e-300, 1e-300};
  const Double2 t =
      minimum(one, maximum(zero, dot(from_start, segment) / maximum(dot(segment, segment), tiny)));
  const Lanes3 offset{from_start.x - t * segment.x, from_start.y - t * segment.y,
                      from_start.z - t * segment.z};
  return dot(offset, offset);
}

/// Squared distances from p to the two triangles of the pair. A sliver counts as its edges.
[[nodiscard]] inline Double2 squared_distance(const WideTree& tree, const TriangleLeaf& leaf,
                                              std::size_t pair, const Lanes3& p) {
  const Lanes3 a = corner_lanes(tree, leaf, 0, pair);
  const Lanes3 b = corner_lanes(tree, leaf, 1, pair);
  const Lanes3 c = corner_lanes(tree, leaf, 2, pair);
  const Lanes3 ab = b - a;
  const Lanes3 ac = c - a;
  const Lanes3 ap = p - a;
  const Lanes3 normal = cross(ab, ac);
  const Double2 normal2 = dot(normal, normal);
  const Double2 zero{0, 0};
  const Double2 u = dot(cross(ab, ap), normal);
  const Double2 v = dot(cross(ap, ac), normal);
  const Double2 sliver = Double2{1e-20, 1e-20} * dot(ab, ab) * dot(ac, ac);
  const auto above = (u >= zero) & (v >= zero) & (u + v <= normal2) & (normal2 > sliver);
  const Double2 height = dot(ap, normal);
  const Double2 to_plane = height * height / maximum(normal2, Double2{1e-300, 1e-300});
  const Double2 to_edges = minimum(
      squared_distance_to_segment(ap, ab),
      minimum(squared_distance_to_segment(ap, ac), squared_distance_to_segment(p - b, c - b)));
  return above ? to_plane : to_edges;
}

/// One triangle, for rare work.
struct Corners {
  Eigen::Vector3d a, b, c;
};
[[nodiscard]] inline Corners corners(const WideTree& tree, const TriangleLeaf& leaf,
                                     std::size_t place) {
  const auto corner = [&](std::size_t k) {
    return tree.vertices[static_cast<std::size_t>(leaf.vertex[k][place])];
  };
  return {corner(0), corner(1), corner(2)};
}

/// The point of the triangle closest to p; agrees with squared_distance.
[[nodiscard]] inline Eigen::Vector3d closest_point(const Corners& t, const Eigen::Vector3d& p) {
  const Eigen::Vector3d ab = t.b - t.a;
  const Eigen::Vector3d ac = t.c - t.a;
  const Eigen::Vector3d ap = p - t.a;
  const Eigen::Vector3d normal = ab.cross(ac);
  const double normal2 = normal.squaredNorm();
  const double u = ab.cross(ap).dot(normal);
  const double v = ap.cross(ac).dot(normal);
  if (u >= 0 && v >= 0 && u + v <= normal2 &&
      normal2 > 1e-20 * ab.squaredNorm() * ac.squaredNorm()) {
    return p - (ap.dot(normal) / normal2) * normal;
  }
  const auto on_segment = [&](const Eigen::Vector3d& start, const Eigen::Vector3d& along) {
    const double t01 = (p - start).dot(along) / std::max(along.squaredNorm(), 1e-300);
    return Eigen::Vector3d(start + std::clamp(t01, 0.0, 1.0) * along);
  };
  Eigen::Vector3d best = on_segment(t.a, ab);
  for (const Eigen::Vector3d& other : {on_segment(t.a, ac), on_segment(t.b, t.c - t.b)}) {
    if ((other - p).squaredNorm() < (best - p).squaredNorm()) best = other;
  }
  return best;
}

/// A ray in the sheared frame of Woop et al. 2013, where it starts at the origin and runs along z.
struct ShearedRay {
  ShearedRay(const Eigen::Vector3d& start, const Eigen::Vector3d& direction) : origin(start) {
    int k = 0;
    direction.cwiseAbs().maxCoeff(&k);
    axis = {static_cast<std::size_t>((k + 1) % 3), static_cast<std::size_t>((k + 2) % 3),
            static_cast<std::size_t>(k)};
    shear_z = 1 / direction[k];
    shear_x = direction[(k + 1) % 3] * shear_z;
    shear_y = direction[(k + 2) % 3] * shear_z;
  }
  Eigen::Vector3d origin;
  std::array<std::size_t, 3> axis;
  double shear_x;
  double shear_y;
  double shear_z;
};

/// Edge functions of two triangles: the ray's line crosses a triangle where all three have one
/// sign. They are equal and opposite, to the last bit, on the two sides of a shared edge.
struct Crossings {
  Double2 u, v, w;       ///< opposite to corners 0, 1, 2
  Double2 determinant;   ///< u + v + w; > 0: the line enters through the front (Woop's sign)
  Double2 scaled_depth;  ///< distance along the direction times the determinant
  Double2 size;          ///< of the corners in the sheared plane: rounding of u, v, w is at most a
                         ///< few epsilons of it
};

[[nodiscard]] inline Crossings crossings(const WideTree& tree, const TriangleLeaf& leaf,
                                         std::size_t pair, const ShearedRay& ray) {
  std::array<Double2, 3> x;
  std::array<Double2, 3> y;
  std::array<Double2, 3> z;
  const auto origin = [&](std::size_t k) {
    const double value = ray.origin[static_cast<Eigen::Index>(ray.axis[k])];
    return Double2{value, value};
  };
  const Double2 origin_x = origin(0);
  const Double2 origin_y = origin(1);
  const Double2 origin_z = origin(2);
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d& p = tree.vertices[static_cast<std::size_t>(leaf.vertex[k][2 * pair])];
    const Eigen::Vector3d& q =
        tree.vertices[static_cast<std::size_t>(leaf.vertex[k][2 * pair + 1])];
    const auto along = [&](std::size_t axis) {
      const auto index = static_cast<Eigen::Index>(ray.axis[axis]);
      return Double2{p[index], q[index]};
    };
    const Double2 depth = along(2) - origin_z;
    x[k] = along(0) - origin_x - ray.shear_x * depth;
    y[k] = along(1) - origin_y - ray.shear_y * depth;
    z[k] = ray.shear_z * depth;
  }
  Crossings result;
  result.u = x[2] * y[1] - y[2] * x[1];
  result.v = x[0] * y[2] - y[0] * x[2];
  result.w = x[1] * y[0] - y[1] * x[0];
  result.determinant = result.u + result.v + result.w;
  result.scaled_depth = result.u * z[0] + result.v * z[1] + result.w * z[2];
  const auto size = [](Double2 a, Double2 b) { return maximum(maximum(a, -a), maximum(b, -b)); };
  result.size = size(x[0], y[0]) + size(x[1], y[1]) + size(x[2], y[2]);
  return result;
}

}  // namespace curveskel
