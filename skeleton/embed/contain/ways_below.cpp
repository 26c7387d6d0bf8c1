#include "skeleton/embed/contain/ways_below.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/monitor.hpp>
#include "skeleton/embed/contain/below_surface.hpp"

namespace curveskel {
namespace {

constexpr double depth_share = 1e-3;  // of a triangle's height

/// True if no part of the straight line is outside. Where the surface meets itself a line may cross
/// it and yet stay inside, so the middle between any two crossings is asked.
bool line_stays_inside(const SurfaceTree& tree, const Point& from, const Point& to) {
  constexpr double past = 1e-12;  // beyond the crossing, D = 1
  const double length = (to - from).norm();
  if (length == 0) return true;
  const Point direction = (to - from) / length;
  for (double at = 0; at < length;) {
    const auto hit = tree.ray(from + at * direction, direction, length - at);
    const double next = hit.triangle < 0 ? length : at + hit.distance;
    if (!tree.inside(from + 0.5 * (at + next) * direction)) return false;
    at = next + past;
  }
  return true;
}

}  // namespace

std::optional<std::vector<Point>> WaysBelow::between(const CurvePoint& from, const CurvePoint& to) {
  constexpr int most_tries = 100;  // each finds a way round the places where the last one left
  const auto first = tree_.nearest(from.place());
  const auto last = tree_.nearest(to.place());
  if (first.triangle < 0 || last.triangle < 0) return std::nullopt;
  const Point start = below(first.triangle, first.point);
  const Point end = below(last.triangle, last.point);
  const auto stays = [this](const Point& p, const Point& q) {
    return line_stays_inside(tree_, p, q);
  };
  if (!stays(from.place(), start) || !stays(end, to.place())) return std::nullopt;
  std::set<Step> avoided;
  for (int t = 0; t < most_tries && more_fruitless_tries_ > 0; ++t) {
    throw_if_stopped(stop_);
    const auto edges = edges_between(first, last, avoided);
    if (!edges) return std::nullopt;
    std::vector<Point> line{start};
    for (const std::int32_t h : *edges) line.push_back(below_edge(h));
    line.push_back(end);
    const std::size_t known = avoided.size();
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      if (stays(line[k], line[k + 1])) continue;
      avoided.insert({k == 0 ? -1 : (*edges)[k - 1], k == edges->size() ? -1 : (*edges)[k]});
    }
    if (avoided.size() == known) return line;
    --more_fruitless_tries_;
  }
  return std::nullopt;
}

/// A* over the edges' middles; each edge by the half-edge of the face that it is reached from.
std::optional<std::vector<std::int32_t>> WaysBelow::edges_between(const SurfaceTree::Nearest& from,
                                                                  const SurfaceTree::Nearest& to,
                                                                  const std::set<Step>& avoided) {
  if (!half_edges_) {
    half_edges_ =
        pair_half_edges(surface_.triangles, static_cast<std::int32_t>(surface_.positions.rows()));
  }
  reached_.resize(idx(3 * surface_.triangles.rows() + 1));
  ++searches_;
  const auto reached = [this](std::int32_t h) -> Reached& { return reached_[idx(h + 1)]; };
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](std::int32_t h, std::int32_t by, const Point& at, double length) {
    if (avoided.count({by, h}) != 0) return;
    const Point place = h < 0 ? Point(to.point) : middle(h);
    const double its = length + (place - at).norm();
    Reached& entry = reached(h);
    if (entry.search == searches_ && (entry.done || entry.length <= its)) return;
    entry = {its, by, false, searches_};
    open.emplace(its + (to.point - place).norm(), h);
  };
  const auto leave = [&](std::int32_t face, std::int32_t by, const Point& at, double length) {
    if (face == to.triangle) reach(-1, by, at, length);
    for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) {
      if (by < 0 || h != half_edges_->twin[idx(by)]) reach(h, by, at, length);
    }
  };
  leave(from.triangle, -1, from.point, 0);
  while (!open.empty()) {
    const std::int32_t h = open.top().second;
    open.pop();
    Reached& here = reached(h);
    if (std::exchange(here.done, true)) continue;
    if (h >= 0) {
      leave(half_edges_->twin[idx(h)] / 3, h, middle(h), here.length);
      continue;
    }
    std::vector<std::int32_t> way;
    for (std::int32_t e = here.before; e >= 0; e = reached(e).before) way.push_back(e);
    std::reverse(way.begin(), way.end());
    return way;
  }
  return std::nullopt;
}

Point WaysBelow::below(std::int32_t face, const Point& place) const {
  const InnerSide side = inner_side(surface_, face);
  return place + depth_share * side.height * side.inwards;
}

Point WaysBelow::below_edge(std::int32_t h) const {
  const InnerSide one = inner_side(surface_, h / 3);
  const InnerSide other = inner_side(surface_, half_edges_->twin[idx(h)] / 3);
  const double depth = depth_share * std::min(one.height, other.height);
  return middle(h) + depth * (one.inwards + other.inwards).normalized();
}

Point WaysBelow::middle(std::int32_t h) const {
  const Point a = surface_.positions.row(surface_.triangles(h / 3, h % 3));
  const Point b = surface_.positions.row(surface_.triangles(h / 3, (h + 1) % 3));
  return 0.5 * (a + b);
}

}  // namespace curveskel
