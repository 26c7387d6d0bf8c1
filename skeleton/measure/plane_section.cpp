#include "skeleton/measure/plane_section.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

using Loop = SectionLoop;

/// A triangle that the plane crosses, from the half-edge that goes below it to the one that rises
/// above it: so the solid lies on the left as seen from the normal.
struct PlaneCrossing {
  std::array<std::int32_t, 2> falling;  ///< from a vertex above to one below
  std::array<std::int32_t, 2> rising;   ///< from a vertex below to one above
  int triangle;
};

std::vector<PlaneCrossing> crossings(const Surface& surface, const SurfaceTree& tree,
                                     const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  std::vector<PlaneCrossing> all;
  for (const int triangle : tree.near_plane(point, normal)) {
    std::array<bool, 3> above{};
    for (int k = 0; k < 3; ++k) {
      const auto vertex = surface.triangles(triangle, k);
      above[idx(k)] = (surface.positions.row(vertex).transpose() - point).dot(normal) >= 0;
    }
    if (above[0] == above[1] && above[1] == above[2]) continue;
    PlaneCrossing crossing{{}, {}, triangle};
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const std::array<std::int32_t, 2> edge{surface.triangles(triangle, k),
                                             surface.triangles(triangle, next)};
      if (above[idx(k)] && !above[idx(next)]) crossing.falling = edge;
      if (!above[idx(k)] && above[idx(next)]) crossing.rising = edge;
    }
    all.push_back(crossing);
  }
  return all;
}

/// In the plane, of the edge's point there; the same for both of its half-edges.
Eigen::Vector2d crossing_point(const Surface& surface, const PlaneSection& frame,
                               std::array<std::int32_t, 2> edge) {
  if (edge[0] > edge[1]) std::swap(edge[0], edge[1]);
  const Eigen::Vector3d normal = frame.axes.col(0).cross(frame.axes.col(1));
  const Eigen::Vector3d a = surface.positions.row(edge[0]).transpose() - frame.origin;
  const Eigen::Vector3d b = surface.positions.row(edge[1]).transpose() - frame.origin;
  const double height_a = a.dot(normal);
  const double height_b = b.dot(normal);
  const double share = std::clamp(height_a / (height_a - height_b), 0.0, 1.0);
  return frame.axes.transpose() * ((1 - share) * a + share * b);
}

/// Triangles joined where one rises and its neighbour falls. Chains that do not close are left out.
std::vector<Loop> loops_of(const Surface& surface, const PlaneSection& frame,
                           std::vector<PlaneCrossing> all) {
  std::sort(all.begin(), all.end(),
            [](const PlaneCrossing& a, const PlaneCrossing& b) { return a.falling < b.falling; });
  const auto next_of = [&all](const PlaneCrossing& crossing) -> int {
    const std::array<std::int32_t, 2> twin{crossing.rising[1], crossing.rising[0]};
    const auto found = std::lower_bound(
        all.begin(), all.end(), twin,
        [](const PlaneCrossing& one, const auto& edge) { return one.falling < edge; });
    return found != all.end() && found->falling == twin ? static_cast<int>(found - all.begin())
                                                        : -1;
  };
  std::vector<bool> used(all.size(), false);
  std::vector<Loop> loops;
  for (std::size_t first = 0; first < all.size(); ++first) {
    std::vector<Eigen::Vector2d> corners;
    Loop loop;
    int at = static_cast<int>(first);
    while (at >= 0 && !used[idx(at)]) {
      used[idx(at)] = true;
      corners.push_back(crossing_point(surface, frame, all[idx(at)].falling));
      loop.triangles.push_back(all[idx(at)].triangle);
      at = next_of(all[idx(at)]);
    }
    if (at != static_cast<int>(first) || corners.size() < 3) continue;
    loop.corners.resize(2, static_cast<Eigen::Index>(corners.size()));
    for (std::size_t k = 0; k < corners.size(); ++k) {
      loop.corners.col(static_cast<Eigen::Index>(k)) = corners[k];
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Eigen::Vector2d corner_after(const Loop& loop, Eigen::Index corner) {
  return loop.corners.col((corner + 1) % loop.corners.cols());
}

/// Positive of one that goes counter-clockwise.
double signed_area(const Loop& loop) {
  double twice = 0;
  for (Eigen::Index k = 0; k < loop.corners.cols(); ++k) {
    twice += cross(loop.corners.col(k), corner_after(loop, k));
  }
  return twice / 2;
}

/// By the number of sides that a ray crosses.
bool encloses(const Loop& loop, const Eigen::Vector2d& point) {
  bool inside = false;
  for (Eigen::Index k = 0; k < loop.corners.cols(); ++k) {
    const Eigen::Vector2d a = loop.corners.col(k) - point;
    const Eigen::Vector2d b = corner_after(loop, k) - point;
    if ((a.y() > 0) == (b.y() > 0)) continue;
    if ((cross(a, b) > 0) == (b.y() > a.y())) inside = !inside;
  }
  return inside;
}

/// The smallest of the loops that enclose a place, -1 = none.
int innermost(const std::vector<Loop>& loops, const std::vector<double>& areas,
              const Eigen::Vector2d& place, std::size_t but_not) {
  int best = -1;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    if (k == but_not || !encloses(loops[k], place)) continue;
    if (best < 0 || std::abs(areas[k]) < std::abs(areas[idx(best)])) best = static_cast<int>(k);
  }
  return best;
}

}  // namespace

std::optional<PlaneSection> section_around(const Surface& surface, const SurfaceTree& tree,
                                           const Eigen::Vector3d& point,
                                           const Eigen::Vector3d& normal) {
  PlaneSection section;
  section.origin = point;
  section.axes.col(0) = normal.unitOrthogonal();
  section.axes.col(1) = normal.cross(section.axes.col(0));
  std::vector<Loop> loops = loops_of(surface, section, crossings(surface, tree, point, normal));
  std::vector<double> areas;
  areas.reserve(loops.size());
  for (const Loop& loop : loops) areas.push_back(signed_area(loop));

  const int outer = innermost(loops, areas, Eigen::Vector2d::Zero(), loops.size());
  if (outer < 0 || areas[idx(outer)] <= 0) return std::nullopt;
  section.boundary.push_back(loops[idx(outer)]);
  for (std::size_t k = 0; k < loops.size(); ++k) {
    if (areas[k] >= 0) continue;
    if (innermost(loops, areas, loops[k].corners.col(0), k) == outer) {
      section.boundary.push_back(loops[k]);
    }
  }
  return section;
}

bool contains(const PlaneSection& section, const Eigen::Vector3d& point) {
  const Eigen::Vector2d place = section.axes.transpose() * (point - section.origin);
  return std::count_if(section.boundary.begin(), section.boundary.end(),
                       [&](const Loop& loop) { return encloses(loop, place); }) == 1;
}

SectionMeasures measure(const PlaneSection& section) {
  SectionMeasures measures;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (const Loop& loop : section.boundary) {
    for (Eigen::Index k = 0; k < loop.corners.cols(); ++k) {
      const Eigen::Vector2d a = loop.corners.col(k);
      const Eigen::Vector2d b = corner_after(loop, k);
      const double twice = cross(a, b);  // of the triangle with the origin
      const Eigen::Vector2d sum = a + b;
      measures.area += twice / 2;
      measures.perimeter += (b - a).norm();
      first += twice / 6 * sum;
      second += twice / 24 * (a * a.transpose() + b * b.transpose() + sum * sum.transpose());
    }
  }
  measures.second_moments = second - first * first.transpose() / measures.area;
  return measures;
}

}  // namespace curveskel
