#include "skeleton/embed/contain/ways_below.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/monitor.hpp>
#include "skeleton/embed/contain/below_surface.hpp"
#include "surface/resample/canonical.hpp"

namespace curveskel {
namespace {

/// A share of a triangle's height, and more than the rounding of its corners.
double depth_below(double height) {
  constexpr double share = 1e-3;
  constexpr double least = 4 * canonical_step;
  return std::max(least, share * height);
}

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
  return way_for(from, to, nullptr, nullptr);
}

std::optional<std::vector<Point>> WaysBelow::between(const CurvePoint& from, const CurvePoint& to,
                                                     HomologyGuard& handles,
                                                     const IsGood& is_good) {
  return way_for(from, to, &handles, &is_good);
}

std::optional<std::vector<Point>> WaysBelow::way_for(const CurvePoint& from, const CurvePoint& to,
                                                     HomologyGuard* handles,
                                                     const IsGood* is_good) {
  Task task{tree_.nearest(from.place()), tree_.nearest(to.place())};
  task.handles = handles;
  task.is_good = is_good;
  if (task.from.triangle < 0 || task.to.triangle < 0) return std::nullopt;
  task.start = below(task.from.triangle, task.from.point);
  task.end = below(task.to.triangle, task.to.point);
  if (!line_stays_inside(tree_, from.place(), task.start) ||
      !line_stays_inside(tree_, task.end, to.place())) {
    return std::nullopt;
  }
  return search(task);
}

std::vector<Point> WaysBelow::line_of(const Task& task,
                                      const std::vector<std::int32_t>& edges) const {
  std::vector<Point> line{task.start};
  for (const std::int32_t h : edges) line.push_back(below_edge(h));
  line.push_back(task.end);
  return line;
}

/// A* over the edges' middles; each edge by the half-edge of the face that it is reached from, and
/// as often as ways to it go round other handles. A step is looked at when its turn has come, so
/// that few are.
std::optional<std::vector<Point>> WaysBelow::search(const Task& task) {
  constexpr std::int64_t most_places = 300000;
  constexpr int most_ways = 20;
  pair_edges();
  std::unordered_map<Place, Place, HashOfPlace> before;  // of those that were reached
  struct OpenStep {
    double estimate = 0;  // of the whole way
    double length = 0;    // up to its end
    Place by;
    Place to;
    [[nodiscard]] bool operator>(const OpenStep& other) const {
      return std::tie(estimate, to, by) > std::tie(other.estimate, other.to, other.by);
    }
  };
  std::priority_queue<OpenStep, std::vector<OpenStep>, std::greater<>> open;
  const auto leave = [&](std::int32_t face, const Place& by, const Point& at, double length) {
    const auto reach = [&](std::int32_t h) {
      Place to{h, by.number};
      if (task.handles != nullptr) to.number ^= number_of_step(task, by.half_edge, h);
      if (before.contains(to)) return;
      const Point place = h < 0 ? Point(task.to.point) : middle(h);
      const double its = length + (place - at).norm();
      open.push({its + (task.to.point - place).norm(), its, by, to});
    };
    if (face == task.to.triangle) reach(-1);
    for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) {
      if (by.half_edge < 0 || h != half_edges_->twin[idx(by.half_edge)]) reach(h);
    }
  };
  leave(task.from.triangle, {}, task.from.point, 0);
  std::int64_t more = task.handles == nullptr ? more_places_ : std::min(most_places, more_places_);
  for (int ways = 0; !open.empty() && ways < most_ways && more > 0;) {
    const OpenStep step = open.top();
    open.pop();
    if (before.contains(step.to) || !stays_inside(task, step.by.half_edge, step.to.half_edge)) {
      continue;
    }
    throw_if_stopped(stop_);
    before.emplace(step.to, step.by);
    --more;
    --more_places_;
    if (step.to.half_edge >= 0) {
      leave(half_edges_->twin[idx(step.to.half_edge)] / 3, step.to, middle(step.to.half_edge),
            step.length);
      continue;
    }
    ++ways;
    std::vector<std::int32_t> edges;
    for (Place e = step.by; e.half_edge >= 0; e = before.at(e)) edges.push_back(e.half_edge);
    std::reverse(edges.begin(), edges.end());
    std::vector<Point> line = line_of(task, edges);
    if (task.is_good == nullptr || (*task.is_good)(line)) return line;
  }
  return std::nullopt;
}

void WaysBelow::pair_edges() {
  if (half_edges_) return;
  half_edges_ =
      pair_half_edges(surface_.triangles, static_cast<std::int32_t>(surface_.positions.rows()));
  steps_.resize(2 * half_edges_->twin.size());
}

std::uint64_t WaysBelow::number_of_step(const Task& task, std::int32_t from, std::int32_t to) {
  const auto computed = [&] {
    const auto [start, end] = ends_of_step(task, from, to);
    return task.handles->number(start, end);
  };
  if (from < 0 || to < 0) return computed();
  auto& known = known_of(from, to).number;
  if (!known) known = computed();
  return *known;
}

bool WaysBelow::stays_inside(const Task& task, std::int32_t from, std::int32_t to) {
  const auto computed = [&] {
    const auto [start, end] = ends_of_step(task, from, to);
    return line_stays_inside(tree_, start, end);
  };
  if (from < 0 || to < 0) return computed();
  auto& known = known_of(from, to).is_inside;
  if (!known) known = computed();
  return *known;
}

std::pair<Point, Point> WaysBelow::ends_of_step(const Task& task, std::int32_t from,
                                                std::int32_t to) const {
  return {from < 0 ? task.start : below_edge(from), to < 0 ? task.end : below_edge(to)};
}

WaysBelow::KnownStep& WaysBelow::known_of(std::int32_t from, std::int32_t to) {
  const bool is_next = to == next_half_edge(half_edges_->twin[idx(from)]);
  return steps_[2 * idx(from) + (is_next ? 1 : 0)];
}

Point WaysBelow::below(std::int32_t face, const Point& place) const {
  const InnerSide side = inner_side(surface_, face);
  return place + depth_below(side.height) * side.inwards;
}

Point WaysBelow::below_edge(std::int32_t h) const {
  const InnerSide one = inner_side(surface_, h / 3);
  const InnerSide other = inner_side(surface_, half_edges_->twin[idx(h)] / 3);
  const double depth = depth_below(std::min(one.height, other.height));
  return middle(h) + depth * (one.inwards + other.inwards).normalized();
}

Point WaysBelow::middle(std::int32_t h) const {
  const Point a = surface_.positions.row(surface_.triangles(h / 3, h % 3));
  const Point b = surface_.positions.row(surface_.triangles(h / 3, (h + 1) % 3));
  return 0.5 * (a + b);
}

}  // namespace curveskel
