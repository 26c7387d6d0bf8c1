#include "skeleton/embed/contain/below_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

InnerSide inner_side(const Surface& surface, std::int32_t face) {
  const Point a = surface.positions.row(surface.triangles(face, 0));
  const Point ab = Point(surface.positions.row(surface.triangles(face, 1))) - a;
  const Point ac = Point(surface.positions.row(surface.triangles(face, 2))) - a;
  const Point normal = ab.cross(ac);
  const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
  return {-normal.normalized(), longest > 0 ? normal.norm() / longest : 0};
}

BelowSurface::BelowSurface(const WorkingSurface& working)
    : surface_(working.surface()), half_(working.half_edges()), out_(working.leaving()) {}

std::vector<Point> BelowSurface::round(const std::vector<std::array<int, 2>>& edges) const {
  std::vector<Point> points;
  std::int32_t last = half_edge(edges.back());
  for (const auto& edge : edges) {
    const std::int32_t next = half_edge(edge);
    for (const std::int32_t side : {last, half_.twin[idx(last)]}) {
      if (side / 3 != next / 3 && side / 3 != half_.twin[idx(next)] / 3) continue;
      points.push_back(below_triangle(side / 3));
      break;
    }
    points.push_back(below_edge(next));
    last = next;
  }
  return points;
}

std::vector<Point> BelowSurface::step(int from, int to) const {
  std::vector<Point> points{below_triangle(out_[idx(from)] / 3)};
  const auto turn = [&](std::int32_t h) {
    points.push_back(below_edge(previous_half_edge(h)));
    h = turned(h);
    points.push_back(below_triangle(h / 3));
    return h;
  };
  std::int32_t h = out_[idx(from)];
  while (origin(next_half_edge(h)) != to) h = turn(h);
  h = next_half_edge(h);
  while (h != out_[idx(to)]) h = turn(h);
  return points;
}

std::vector<Point> BelowSurface::around(int vertex) const {
  const std::int32_t first = out_[idx(vertex)];
  std::vector<Point> points{below_triangle(first / 3)};
  for (std::int32_t h = turned(first); h != first; h = turned(h)) {
    points.push_back(below_edge(half_.twin[idx(h)]));
    points.push_back(below_triangle(h / 3));
  }
  return points;
}

std::int32_t BelowSurface::turned(std::int32_t h) const {
  return half_.twin[idx(previous_half_edge(h))];
}

std::int32_t BelowSurface::half_edge(const std::array<int, 2>& edge) const {
  std::int32_t h = out_[idx(edge[0])];
  while (origin(next_half_edge(h)) != edge[1]) h = turned(h);
  return h;
}

BelowSurface::Place BelowSurface::below_face(std::int32_t face) const {
  constexpr double share = 0.01;  // of the least height
  constexpr double least = 5e-7;  // linking numbers need it
  const InnerSide side = inner_side(surface_, face);
  return {side.inwards, std::max(least, share * side.height)};
}

Point BelowSurface::below_triangle(std::int32_t face) const {
  const auto [inwards, depth] = below_face(face);
  return (place(3 * face) + place(3 * face + 1) + place(3 * face + 2)) / 3 + depth * inwards;
}

Point BelowSurface::below_edge(std::int32_t h) const {
  const Place one = below_face(h / 3);
  const Place other = below_face(half_.twin[idx(h)] / 3);
  return 0.5 * (place(h) + place(next_half_edge(h))) +
         std::min(one.depth, other.depth) * (one.inwards + other.inwards).normalized();
}

}  // namespace curveskel
