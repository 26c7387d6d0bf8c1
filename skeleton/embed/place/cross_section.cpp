#include "skeleton/embed/place/cross_section.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

constexpr std::size_t ray_count = 12;

struct Section {
  std::array<Point, ray_count> directions;
  std::array<double, ray_count> distances{};
};

/// The rays from `point` to the surface in the plane normal to `direction`, which is not zero.
Section section_at(const SurfaceTree& tree, const Point& point, const Point& direction,
                   double limit) {
  const Point n = direction.normalized();
  const Point u = n.unitOrthogonal();
  const Point w = n.cross(u);
  Section section;
  for (std::size_t k = 0; k < ray_count; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / ray_count;
    section.directions[k] = std::cos(angle) * u + std::sin(angle) * w;
  }
  tree.rays_in_plane(point, n, section.directions, limit, section.distances);
  return section;
}

/// From the point to the centre.
Point step_of(const Section& section) {
  Point sum = Point::Zero();
  for (std::size_t k = 0; k < ray_count; ++k) sum += section.distances[k] * section.directions[k];
  return 2 * sum / ray_count;
}

bool has_section(const Point& direction, double radius) {
  return radius > 0 && direction.norm() > 0;
}

}  // namespace

Point cross_section_centre(const SurfaceTree& tree, const Point& point, const Point& direction,
                           double radius, const SectionTuning& tuning) {
  if (!has_section(direction, radius)) return point;
  const double limit = tuning.ray_limit * radius;
  Section section = section_at(tree, point, direction, limit);
  for (double& distance : section.distances) distance = std::min(distance, limit);
  return point + step_of(section);
}

Point cross_section_centre(const SurfaceTree& tree, const Point& point, const Point& direction,
                           double radius, const std::function<bool(int)>& is_own,
                           const SectionTuning& tuning) {
  if (!has_section(direction, radius)) return point;
  const double limit = tuning.ray_limit * radius;
  Section section = section_at(tree, point, direction, std::numeric_limits<double>::infinity());
  const auto stays = [&](std::size_t k) {
    if (section.distances[k] <= limit) return true;
    const int triangle = tree.ray(point, section.directions[k]).triangle;
    return triangle >= 0 && is_own(triangle);
  };
  for (std::size_t k = 0; k < ray_count / 2; ++k) {
    double& ahead = section.distances[k];
    double& behind = section.distances[k + ray_count / 2];
    if (std::max(ahead, behind) <= limit) continue;
    if (stays(k) && stays(k + ray_count / 2)) continue;
    ahead = std::min(ahead, limit);
    behind = std::min(behind, limit);
  }
  const Point step = step_of(section);
  return point + step * std::min(1.0, tuning.longest_step * radius / step.norm());
}

}  // namespace curveskel
