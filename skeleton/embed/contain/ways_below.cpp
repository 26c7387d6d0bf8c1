#include "skeleton/embed/contain/ways_below.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <queue>
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
  constexpr int most_tries = 100;  // each finds a way round the places where the last one left
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
  std::set<Step> avoided;
  for (int t = 0; t < most_tries && more_fruitless_tries_ > 0 && more_places_ > 0; ++t) {
    throw_if_stopped(stop_);
    const std::size_t known = avoided.size();
    auto line = search(task, avoided);
    if (line || avoided.size() == known) return line;
    --more_fruitless_tries_;
  }
  return std::nullopt;
}

std::vector<Point> WaysBelow::line_of(const Task& task,
                                      const std::vector<std::int32_t>& edges) const {
  std::vector<Point> line{task.start};
  for (const std::int32_t h : edges) line.push_back(below_edge(h));
  line.push_back(task.end);
  return line;
}

/// `avoided` gets the steps that don't.
bool WaysBelow::stays_inside(const std::vector<Point>& line, const std::vector<std::int32_t>& edges,
                             std::set<Step>& avoided) const {
  bool all = true;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    if (line_stays_inside(tree_, line[k], line[k + 1])) continue;
    avoided.insert({k == 0 ? -1 : edges[k - 1], k == edges.size() ? -1 : edges[k]});
    all = false;
  }
  return all;
}

/// A* over the edges' middles; each edge by the half-edge of the face that it is reached from, and
/// as often as ways to it go round other handles.
std::optional<std::vector<Point>> WaysBelow::search(const Task& task, std::set<Step>& avoided) {
  constexpr std::int64_t most_places = 300000;
  constexpr int most_ways = 20;
  const std::int64_t last_place = std::min(most_places, more_places_);
  pair_edges();
  std::unordered_map<Place, Reached, HashOfPlace> reached;
  using Entry = std::pair<double, Place>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](std::int32_t h, const Place& by, const Point& at, double length) {
    if (!avoided.empty() && avoided.contains({by.half_edge, h})) return;
    Place to{h, by.number};
    if (task.handles != nullptr) to.number ^= number_of_step(task, by.half_edge, h);
    const Point place = h < 0 ? Point(task.to.point) : middle(h);
    const double its = length + (place - at).norm();
    const auto [entry, is_new] = reached.try_emplace(to);
    if (!is_new && (entry->second.done || entry->second.length <= its)) return;
    entry->second = {its, by, false};
    open.emplace(its + (task.to.point - place).norm(), to);
  };
  const auto leave = [&](std::int32_t face, const Place& by, const Point& at, double length) {
    if (face == task.to.triangle) reach(-1, by, at, length);
    for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) {
      if (by.half_edge < 0 || h != half_edges_->twin[idx(by.half_edge)]) reach(h, by, at, length);
    }
  };
  leave(task.from.triangle, {}, task.from.point, 0);
  const auto count = [&reached] { return static_cast<std::int64_t>(reached.size()); };
  int ways = 0;
  while (!open.empty() && ways < most_ways && (task.handles == nullptr || count() < last_place)) {
    const Place place = open.top().second;
    open.pop();
    Reached& here = reached.at(place);
    if (std::exchange(here.done, true)) continue;
    if (place.half_edge >= 0) {
      leave(half_edges_->twin[idx(place.half_edge)] / 3, place, middle(place.half_edge),
            here.length);
      continue;
    }
    ++ways;
    std::vector<std::int32_t> edges;
    for (Place e = here.before; e.half_edge >= 0; e = reached.at(e).before) {
      edges.push_back(e.half_edge);
    }
    std::reverse(edges.begin(), edges.end());
    std::vector<Point> line = line_of(task, edges);
    if (!stays_inside(line, edges, avoided)) continue;
    if (task.is_good == nullptr || (*task.is_good)(line)) return line;
  }
  if (task.handles != nullptr) more_places_ -= count();
  return std::nullopt;
}

void WaysBelow::pair_edges() {
  if (half_edges_) return;
  half_edges_ =
      pair_half_edges(surface_.triangles, static_cast<std::int32_t>(surface_.positions.rows()));
  step_numbers_.resize(2 * half_edges_->twin.size());
}

std::uint64_t WaysBelow::number_of_step(const Task& task, std::int32_t from, std::int32_t to) {
  const auto computed = [&] {
    return task.handles->number(from < 0 ? task.start : below_edge(from),
                                to < 0 ? task.end : below_edge(to));
  };
  if (from < 0 || to < 0) return computed();
  const bool is_next = to == next_half_edge(half_edges_->twin[idx(from)]);
  auto& known = step_numbers_[2 * idx(from) + (is_next ? 1 : 0)];
  if (!known) known = computed();
  return *known;
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
