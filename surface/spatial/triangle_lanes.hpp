// Distances and ray crossings of several triangles at a time. Internal to surface/.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "base/wide_vectors.hpp"
#include "surface/spatial/wide_tree.hpp"

namespace curveskel {

/// Points or vectors side by side: of two triangles (Double2), or of a leaf's four.
template <typename Double>
struct Lanes3 {
  Double x, y, z;
};
template <typename Double>
[[nodiscard]] inline Lanes3<Double> operator-(const Lanes3<Double>& a, const Lanes3<Double>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <typename Double>
[[nodiscard]] inline Double dot(const Lanes3<Double>& a, const Lanes3<Double>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename Double>
[[nodiscard]] inline Lanes3<Double> cross(const Lanes3<Double>& a, const Lanes3<Double>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The number in each lane.
template <typename Double>
[[nodiscard]] inline Double spread(double value) {
  if constexpr (sizeof(Double) == sizeof(Double2)) {
    return Double{value, value};
  } else {
    return Double{value, value, value, value};
  }
}
template <typename Double>
[[nodiscard]] inline Lanes3<Double> spread(const Eigen::Vector3d& v) {
  return {spread<Double>(v.x()), spread<Double>(v.y()), spread<Double>(v.z())};
}
template <typename Double>
[[nodiscard]] inline Double lesser(const Double& a, const Double& b) {
  return a < b ? a : b;
}
template <typename Double>
[[nodiscard]] inline Double greater(const Double& a, const Double& b) {
  return a > b ? a : b;
}
[[nodiscard]] inline double least_of(const Double4& v) {
  return std::min(std::min(v[0], v[2]), std::min(v[1], v[3]));
}
[[nodiscard]] inline bool any_of(const Mask4& mask) {
  return ((mask[0] | mask[2]) | (mask[1] | mask[3])) != 0;
}

/// Corner k of places 2 * pair and 2 * pair + 1.
[[nodiscard]] inline Lanes3<Double2> corners_of_pair(const WideTree& tree, const TriangleLeaf& leaf,
                                                     std::size_t k, std::size_t pair) {
  const Eigen::Vector3d& p = tree.vertices[static_cast<std::size_t>(leaf.vertex[k][2 * pair])];
  const Eigen::Vector3d& q = tree.vertices[static_cast<std::size_t>(leaf.vertex[k][2 * pair + 1])];
  return {Double2{p.x(), q.x()}, Double2{p.y(), q.y()}, Double2{p.z(), q.z()}};
}
/// Along the axis, of corner k of all places.
[[nodiscard]] inline Double4 coordinates(const WideTree& tree, const TriangleLeaf& leaf,
                                         std::size_t k, std::size_t axis) {
  const auto at = [&](std::size_t place) {
    return tree
        .vertices[static_cast<std::size_t>(leaf.vertex[k][place])][static_cast<Eigen::Index>(axis)];
  };
  return Double4{at(0), at(1), at(2), at(3)};
}
/// Corner k of all places.
[[nodiscard]] inline Lanes3<Double4> corners_of_leaf(const WideTree& tree, const TriangleLeaf& leaf,
                                                     std::size_t k) {
  return {coordinates(tree, leaf, k, 0), coordinates(tree, leaf, k, 1),
          coordinates(tree, leaf, k, 2)};
}

/// Squared distance from the segment's start + along the offset `from_start` to the segment.
template <typename Double>
[[nodiscard]] inline Double squared_distance_to_segment(const Lanes3<Double>& from_start,
                                                        const Lanes3<Double>& segment) {
  const auto tiny = spread<Double>(1e-300);
  const Double t = lesser(
      spread<Double>(1),
      greater(spread<Double>(0), dot(from_start, segment) / greater(dot(segment, segment), tiny)));
  const Lanes3<Double> offset{from_start.x - t * segment.x, from_start.y - t * segment.y,
                              from_start.z - t * segment.z};
  return dot(offset, offset);
}

/// Squared distances from p to triangles with these corners. A sliver counts as its edges.
template <typename Double>
[[nodiscard]] inline Double squared_distance(const Lanes3<Double>& a, const Lanes3<Double>& b,
                                             const Lanes3<Double>& c, const Lanes3<Double>& p) {
  const Lanes3<Double> ab = b - a;
  const Lanes3<Double> ac = c - a;
  const Lanes3<Double> ap = p - a;
  const Lanes3<Double> normal = cross(ab, ac);
  const Double normal2 = dot(normal, normal);
  const auto zero = spread<Double>(0);
  const Double u = dot(cross(ab, ap), normal);
  const Double v = dot(cross(ap, ac), normal);
  const Double sliver = spread<Double>(1e-20) * dot(ab, ab) * dot(ac, ac);
  const auto above = (u >= zero) & (v >= zero) & (u + v <= normal2) & (normal2 > sliver);
  const Double height = dot(ap, normal);
  const Double to_plane = height * height / greater(normal2, spread<Double>(1e-300));
  const Double to_edges = lesser(
      squared_distance_to_segment(ap, ab),
      lesser(squared_distance_to_segment(ap, ac), squared_distance_to_segment(p - b, c - b)));
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

/// Edge functions of a leaf's triangles: the ray's line crosses one where all three have one sign.
/// They are equal and opposite, to the last bit, on the two sides of a shared edge.
struct Crossings {
  Double4 u, v, w;       ///< opposite to corners 0, 1, 2
  Double4 determinant;   ///< u + v + w; > 0: the line enters through the front (Woop's sign)
  Double4 scaled_depth;  ///< distance along the direction times the determinant
  Double4 size;          ///< of the corners in the sheared plane: rounding of u, v, w is at most a
                         ///< few epsilons of it
};

[[nodiscard]] inline Crossings crossings(const WideTree& tree, const TriangleLeaf& leaf,
                                         const ShearedRay& ray) {
  std::array<Double4, 3> x;
  std::array<Double4, 3> y;
  std::array<Double4, 3> z;
  const auto origin = [&](std::size_t k) {
    return ray.origin[static_cast<Eigen::Index>(ray.axis[k])];
  };
  const auto origin_x = spread<Double4>(origin(0));
  const auto origin_y = spread<Double4>(origin(1));
  const auto origin_z = spread<Double4>(origin(2));
  const auto shear_x = spread<Double4>(ray.shear_x);
  const auto shear_y = spread<Double4>(ray.shear_y);
  const auto shear_z = spread<Double4>(ray.shear_z);
  for (std::size_t k = 0; k < 3; ++k) {
    const Double4 depth = coordinates(tree, leaf, k, ray.axis[2]) - origin_z;
    x[k] = coordinates(tree, leaf, k, ray.axis[0]) - origin_x - shear_x * depth;
    y[k] = coordinates(tree, leaf, k, ray.axis[1]) - origin_y - shear_y * depth;
    z[k] = shear_z * depth;
  }
  Crossings result;
  result.u = x[2] * y[1] - y[2] * x[1];
  result.v = x[0] * y[2] - y[0] * x[2];
  result.w = x[1] * y[0] - y[1] * x[0];
  result.determinant = result.u + result.v + result.w;
  result.scaled_depth = result.u * z[0] + result.v * z[1] + result.w * z[2];
  const auto size = [](const Double4& a, const Double4& b) {
    return greater(greater<Double4>(a, -a), greater<Double4>(b, -b));
  };
  result.size = size(x[0], y[0]) + size(x[1], y[1]) + size(x[2], y[2]);
  return result;
}

}  // namespace curveskel
