#include "skeleton/embed/place/cross_section.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

constexpr std::size_t ray_count = 12;

struct Section {
  std::array<Point, ray_count> directions;
  std::array<double, ray_count> distances{};
};

/// Cosines and sines of the rays' angles.
const std::array<std::array<double, 2>, ray_count>& circle() {
  static const auto made = [] {
    std::array<std::array<double, 2>, ray_count> places{};
    for (std::size_t k = 0; k < ray_count; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / ray_count;
      places[k] = {std::cos(angle), std::sin(angle)};
    }
    return places;
  }();
  return made;
}

/// The rays from `point` to the surface in the plane normal to `direction`, which is not zero.
Section section_at(const SurfaceTree& tree, const Point& point, const Point& direction,
                   double limit) {
  const Point n = direction.normalized();
  const Point u = n.unitOrthogonal();
  const Point w = n.cross(u);
  Section section;
  for (std::size_t k = 0; k < ray_count; ++k) {
    section.directions[k] = circle()[k][0] * u + circle()[k][1] * w;
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

/// Two opposite rays, of which at least one has met nothing up to the limit.
void lengthen_if_own(Section& section, std::size_t k, std::size_t opposite, const SurfaceTree& tree,
                     const Point& point, double limit, const std::function<bool(int)>& is_own) {
  const std::array<std::size_t, 2> both{k, opposite};
  std::array<double, 2> lengths{};
  bool own = true;
  for (std::size_t i = 0; i < 2; ++i) {
    double& distance = section.distances[both[i]];
    lengths[i] = distance;
    if (distance <= limit) continue;
    distance = limit;
    if (!own) continue;
    const auto hit = tree.ray(point, section.directions[both[i]]);
    lengths[i] = hit.distance;
    own = hit.triangle >= 0 && is_own(hit.triangle);
  }
  if (!own) {
    for (std::size_t i = 0; i < 2; ++i) lengths[i] = std::min(lengths[i], limit);
  }
  for (std::size_t i = 0; i < 2; ++i) section.distances[both[i]] = lengths[i];
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

CrossSection flat_cross_section(const SurfaceTree& tree, const Point& point, const Point& direction,
                                double radius, const std::function<bool(int)>& is_own,
                                const SectionTuning& tuning) {
  if (!has_section(direction, radius)) return {point, std::max(radius, 0.0)};
  const double limit = tuning.ray_limit * radius;
  Section section = section_at(tree, point, direction, limit);
  for (std::size_t k = 0; k < ray_count / 2; ++k) {
    lengthen_if_own(section, k, k + ray_count / 2, tree, point, limit, is_own);
  }
  const double width =
      std::accumulate(section.distances.begin(), section.distances.end(), 0.0) / ray_count;
  const Point step = step_of(section);
  const double share = std::min(1.0, tuning.longest_step * width / step.norm());
  return {point + share * step, width};
}

}  // namespace curveskel
