#include "surface/repair/lies_in_plane.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace curveskel {

bool lies_in_plane(const PolygonSoup& soup) {
  using Eigen::Vector3d;
  constexpr double flat = 1e-7;  // of the extent: what single precision leaves of a plane
  if (soup.corners.empty()) return false;
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
