#include "surface/mesh/flat_edges.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include <curveskel/advanced/indices.hpp>
#include "surface/mesh/half_edges.hpp"

namespace curveskel {
namespace {

Eigen::Vector3d unit_normal(const Surface& surface, std::int32_t face) {
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return surface.positions.row(surface.triangles(face, k)).transpose();
  };
  // Sides first brought to a length whose square is a number.
  const Eigen::Vector3d first = (corner(1) - corner(0)).stableNormalized();
  const Eigen::Vector3d second = (corner(2) - corner(0)).stableNormalized();
  return first.cross(second).stableNormalized();
}

}  // namespace

double share_of_flat_edges(const Surface& surface) {
  constexpr double least_turn = 0.01 * std::numbers::pi / 180;  // rounding to single makes less
  const HalfEdges edges =
      pair_half_edges(surface.triangles, static_cast<std::int32_t>(surface.positions.rows()));
  std::size_t all = 0;
  std::size_t flat = 0;
  for (std::size_t h = 0; h < edges.twin.size(); ++h) {
    const std::int32_t twin = edges.twin[h];
    if (twin < static_cast<std::int32_t>(h)) continue;
    ++all;
    const Eigen::Vector3d one = unit_normal(surface, static_cast<std::int32_t>(h) / 3);
    const Eigen::Vector3d other = unit_normal(surface, twin / 3);
    const double cosine = one.dot(other);
    if (cosine > 0 && std::atan2(one.cross(other).norm(), cosine) < least_turn) ++flat;
  }
  return all > 0 ? static_cast<double>(flat) / static_cast<double>(all) : 0;
}

}  // namespace curveskel
