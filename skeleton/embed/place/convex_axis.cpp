#include "skeleton/embed/place/convex_axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "skeleton/embed/ends/tips.hpp"
#include "skeleton/embed/place/cross_section.hpp"
#include "surface/resample/fourth_moments.hpp"

namespace curveskel {
namespace {

/// Evenly spread over the sphere: along a spiral, a golden section of a turn apart.
std::vector<Point> directions_all_round(int count) {
  std::vector<Point> directions;
  for (int i = 0; i < count; ++i) {
    const double height = 1 - (2 * i + 1) / double(count);
    const double across = std::sqrt(1 - height * height);
    const double angle = 2 * std::numbers::pi * i / std::numbers::phi;
    directions.emplace_back(across * std::cos(angle), across * std::sin(angle), height);
  }
  return directions;
}

/// Each once.
std::vector<Point> vertices_farthest_out(const WorkingSurface& working) {
  static const std::vector<Point> directions = directions_all_round(32);
  std::vector<Eigen::Index> farthest;
  for (const Point& direction : directions) {
    const Eigen::VectorXd heights = working.surface().positions * direction;
    Eigen::Index vertex = 0;
    heights.maxCoeff(&vertex);
    farthest.push_back(vertex);
  }
  std::sort(farthest.begin(), farthest.end());
  farthest.erase(std::unique(farthest.begin(), farthest.end()), farthest.end());
  std::vector<Point> places;
  places.reserve(farthest.size());
  for (const Eigen::Index vertex : farthest) {
    places.push_back(working.place(static_cast<int>(vertex)));
  }
  return places;
}

/// True if no corner lies in front of the plane of any triangle, but by rounding. No point between
/// corners does then, so it sees all triangles from behind and the surface winds round it: the
/// chords are inside without a query.
bool behind_all_triangles(const std::vector<Point>& corners, const Surface& surface) {
  constexpr double rounding = 1e-12;
  double size = 0;
  for (const Point& corner : corners) size = std::max(size, corner.norm());
  for (const auto& triangle : surface.triangles.rowwise()) {
    const Point at = surface.positions.row(triangle[0]);
    const Point one = surface.positions.row(triangle[1]).transpose() - at;
    const Point other = surface.positions.row(triangle[2]).transpose() - at;
    const Point normal = one.cross(other);
    const double in_front = rounding * size * normal.norm();
    for (const Point& corner : corners) {
      if (normal.dot(corner - at) > in_front) return false;
    }
  }
  return true;
}

/// True if no point between the two is farther out than `deepest`. From a point inside the way
/// leads on to the next triangle at once; outside and along faces steps are twice `deepest` long,
/// or a hundredth of the way, as other chords cross a gap that this one steps over.
bool stays_inside(const SurfaceTree& tree, const Point& from, const Point& to, double deepest) {
  const double length = (to - from).norm();
  const Point ahead = (to - from) / length;
  const double least_step = std::max(2 * deepest, length / 100);
  double along = 0;
  while (along < length) {
    const Point here = from + along * ahead;
    const double depth = tree.inscribed_radius(here);
    if (depth < -deepest) return false;
    const double seen = depth > 0 ? tree.ray(here, ahead, length - along).distance : 0;
    along += std::max({depth, seen, least_step});
  }
  return true;
}

/// The point from the middle half-way to the surface along `ahead`, from there half-way again, and
/// so on as long as half of the way leads out of the inscribed ball and is longer than `shortest`:
/// from a thin rod's middle its end is any number of radii off. Each point but the first goes
/// half-way to the centre of its cross-section.
std::vector<CurvePoint> half_ways(const SurfaceTree& tree, const Point& middle, Point ahead,
                                  double shortest) {
  double half = 0.5 * tree.ray(middle, ahead).distance;
  std::vector<CurvePoint> points{Point(middle + half * ahead)};
  while (true) {
    const Point place = points.back().place();
    half = 0.5 * tree.ray(place, ahead).distance;
    if (half <= std::max(points.back().radius(tree), shortest) || !std::isfinite(half)) break;
    const Point guess = place + half * ahead;
    const Point centre = cross_section_centre(tree, guess, ahead, tree.inscribed_radius(guess));
    const CurvePoint next = Point(0.5 * (guess + centre));
    if (next.radius(tree) <= 0) break;
    points.push_back(next);
    ahead = (next.place() - place).normalized();
  }
  return points;
}

}  // namespace

bool is_convex(const WorkingSurface& working, const SurfaceTree& tree, double dent) {
  const double deepest = dent * working.balls().radii.maxCoeff();
  const std::vector<Point> corners = vertices_farthest_out(working);
  if (behind_all_triangles(corners, working.surface())) return true;
  // Middles first: there most bodies of limbs are found out, but not a comb of five teeth, of which
  // middles and quarters lie in teeth.
  for (const bool whole : {false, true}) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t j = i + 1; j < corners.size(); ++j) {
        const Point middle = 0.5 * (corners[i] + corners[j]);
        if (whole ? !stays_inside(tree, corners[i], corners[j], deepest)
                  : tree.inscribed_radius(middle) < -deepest) {
          return false;
        }
      }
    }
  }
  return true;
}

SkeletonGraph axis_of_convex_body(const Surface& surface, const PartitionGraph& partition,
                                  const SurfaceTree& tree, double reach, double gap,
                                  const TipTuning& tuning) {
  SkeletonGraph graph;
  const Point middle = Point::Zero();
  if (!tree.inside(middle)) return graph;
  const Point axis = nearest_line(fourth_moments_of(surface));
  const std::vector<CurvePoint> back = half_ways(tree, middle, -axis, tuning.least_radius);
  const std::vector<CurvePoint> front = half_ways(tree, middle, axis, tuning.least_radius);
  graph.nodes.push_back({back.back(), {}, true, {0}});
  graph.nodes.push_back({front.back(), {}, true, {0}});
  std::vector<CurvePoint> between(back.rbegin() + 1, back.rend());
  between.insert(between.end(), front.begin(), front.end() - 1);
  std::vector<int> all(idx(partition.nodes()));
  std::iota(all.begin(), all.end(), 0);
  graph.arcs.push_back({0, 1, std::move(between), std::move(all)});
  shape_tips(graph, tree, reach, gap, tuning);
  return graph;
}

}  // namespace curveskel
