#include "surface/repair/lies_in_plane.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>

namespace curveskel {
namespace {

using Eigen::Vector3d;

constexpr double flat = 1e-7;  // of the extent: what single precision leaves of a plane

/// True if a few corners already span more than points near a plane can; most bodies show at once.
bool spans_volume(const PolygonSoup& soup) {
  constexpr std::size_t looked_at = 8;
  const Eigen::RowVector3d lower = soup.positions.colwise().minCoeff();
  const Eigen::RowVector3d upper = soup.positions.colwise().maxCoeff();
  const double extent = (upper - lower).norm();
  const auto corner = [&](std::size_t i) -> Vector3d {
    return soup.positions.row(soup.corners[i * (soup.corners.size() - 1) / looked_at]) - lower;
  };
  // Of a box of two extents by two by twice `flat`.
  const double most = 16 * flat * extent * extent * extent;
  for (std::size_t i = 1; i < looked_at; ++i) {
    for (std::size_t j = i + 1; j <= looked_at; ++j) {
      const Vector3d normal = (corner(i) - corner(0)).cross(corner(j) - corner(0));
      for (std::size_t k = j + 1; k <= looked_at; ++k) {
        if (std::abs(normal.dot(corner(k) - corner(0))) > most) return true;
      }
    }
  }
  return false;
}

}  // namespace

bool lies_in_plane(const PolygonSoup& soup) {
  if (soup.corners.empty() || spans_volume(soup)) return false;
  const Vector3d origin = soup.positions.row(soup.corners.front());
  // The corner for which `size` of its offset is largest.
  const auto farthest = [&](const auto& size) {
    Vector3d found = Vector3d::Zero();
    double most = 0;
    for (const auto v : soup.corners) {
      const Vector3d offset = soup.positions.row(v).transpose() - origin;
      const double one = size(offset);
      if (one <= most) continue;
      most = one;
      found = offset;
    }
    return found;
  };
  for (const auto v : soup.corners) {
    if (!soup.positions.row(v).allFinite()) return false;
  }
  const Vector3d longest = farthest([](const Vector3d& p) { return p.stableNorm(); });
  const double extent = longest.stableNorm();
  if (!(extent > 0)) return false;
  const Vector3d along = longest / extent;
  const auto across = [&along](const Vector3d& p) -> Vector3d { return p - p.dot(along) * along; };
  const Vector3d widest =
      across(farthest([&](const Vector3d& p) { return across(p).stableNorm(); }));
  if (widest.stableNorm() <= flat * extent) return false;
  const Vector3d normal = along.cross(widest.stableNormalized()).normalized();
  const auto height = [&normal](const Vector3d& p) { return std::abs(p.dot(normal)); };
  return height(farthest(height)) <= flat * extent;
}

}  // namespace curveskel
