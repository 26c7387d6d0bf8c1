#include "skeleton/homology/homology_guard.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "skeleton/embed/place/shorten.hpp"

namespace curveskel {

std::vector<int> core(const SkeletonGraph& graph) {
  std::vector<int> degree(graph.nodes.size(), 0);
  std::vector<char> left(graph.arcs.size(), 0);
  for (std::size_t s = 0; s < graph.arcs.size(); ++s) {
    const Arc& arc = graph.arcs[s];
    if (!arc.alive) continue;
    left[s] = 1;
    ++degree[idx(arc.from)];
    ++degree[idx(arc.to)];
  }
  std::vector<int> tips;
  for (std::size_t h = 0; h < degree.size(); ++h) {
    if (degree[h] == 1) tips.push_back(static_cast<int>(h));
  }
  while (!tips.empty()) {
    const int tip = tips.back();
    tips.pop_back();
    for (const int s : graph.nodes[idx(tip)].arcs) {
      if (left[idx(s)] == 0) continue;
      left[idx(s)] = 0;
      const Arc& arc = graph.arcs[idx(s)];
      const int other = arc.from == tip ? arc.to : arc.from;
      if (--degree[idx(other)] == 1) tips.push_back(other);
    }
  }
  std::vector<int> result;
  for (std::size_t s = 0; s < left.size(); ++s) {
    if (left[s] != 0) result.push_back(static_cast<int>(s));
  }
  return result;
}

namespace {

bool same_ends(const Arc& a, const Arc& b) {
  return a.alive && b.alive && a.from == b.from && a.to == b.to;
}

/// An arc's point k, counted along its polyline.
template <typename Graph>
auto& point_of(Graph& graph, int arc, std::size_t k) {
  auto& s = graph.arcs[idx(arc)];
  if (k == 0) return graph.nodes[idx(s.from)].point;
  if (k == s.points.size() + 1) return graph.nodes[idx(s.to)].point;
  return s.points[k - 1];
}

bool any_crosses(const SurfaceTree& tree, const std::vector<Point>& line, double near) {
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    if (crosses(tree, line[k], line[k + 1], near)) return true;
  }
  return false;
}

/// True if two lines, each between two neighbouring points, lie farther than `near` from the
/// surface within the inscribed ball of either of the first line's ends: nothing lies between the
/// two.
bool share_a_ball(const SurfaceTree& tree, const std::array<const CurvePoint*, 2>& was,
                  const std::array<Point, 2>& is, double near) {
  constexpr double strictly = 1e-9;  // D = 1; more than the rounding of the linking numbers
  for (const std::size_t end : {0U, 1U}) {
    const Point& centre = was[end]->place();
    const double reach = was[end]->radius(tree) - std::max(near, strictly);
    const auto holds = [&](const Point& p) { return (p - centre).norm() < reach; };
    if (holds(was[1 - end]->place()) && holds(is[0]) && holds(is[1])) return true;
  }
  return false;
}

bool put_back(CurvePoint& now, const CurvePoint& before) {
  if (now.place() == before.place()) return false;
  now = before;
  return true;
}

}  // namespace

bool crosses(const SurfaceTree& tree, const Point& from, const Point& to, double near) {
  const double length = (to - from).norm();
  if (!(length > 0)) return false;
  const Point direction = (to - from) / length;
  return tree.ray(from, direction, length).triangle >= 0 ||
         (near > 0 && tree.comes_near(from, to, near));
}

HomologyGuard::HomologyGuard(const Surface& surface, std::stop_token stop, double near,
                             const SurfaceTree* own_tree)
    : stop_(std::move(stop)), near_(near), own_tree_(own_tree) {
  const Eigen::Index euler = surface.positions.rows() - surface.triangles.rows() / 2;
  if (euler != 2) classes_.emplace(surface);
}

void HomologyGuard::restore_arcs(const SkeletonGraph& before, SkeletonGraph& graph,
                                 const SurfaceTree& tree) {
  if (!has_handles()) return;
  const auto arcs = core(before);
  for (bool changed = true; changed;) {
    changed = false;
    for (const int s : arcs) {
      hear_stop();
      const Arc& old = before.arcs[idx(s)];
      Arc& arc = graph.arcs[idx(s)];
      if (!same_ends(old, arc)) continue;
      const auto was = before.polyline(old);
      const auto is = graph.polyline(arc);
      if (was == is) continue;
      const bool stays = classes_->homologous(was, is) &&
                         (!any_crosses(tree, is, near_) || any_crosses(tree, was, near_));
      if (stays) continue;
      arc.points = old.points;
      graph.nodes[idx(arc.from)].point = before.nodes[idx(arc.from)].point;
      graph.nodes[idx(arc.to)].point = before.nodes[idx(arc.to)].point;
      changed = true;
    }
  }
}

void HomologyGuard::pull_taut(SkeletonGraph& graph, const SurfaceTree& tree) {
  constexpr double clearance = 0.5;
  constexpr int places = 16;  // along a chord
  const auto line_of_sight = [&](const std::vector<Point>& way, double clear) {
    const Point& from = way.front();
    const Point& to = way.back();
    if (crosses(tree, from, to, near_)) return false;
    const double least = clearance * clear;
    for (int k = 1; k < places; ++k) {
      const double share = static_cast<double>(k) / places;
      if (tree.inscribed_radius(from + share * (to - from)) < least) return false;
    }
    return classes_->homologous(way, {from, to});
  };
  for (const int s : core(graph)) {
    hear_stop();
    Arc& arc = graph.arcs[idx(s)];
    const auto line = graph.polyline(arc);
    const auto radii = graph.radii_along(arc, tree);
    const auto taut = shortened(line, [&](std::size_t first, std::size_t last) {
      const auto begin = line.begin();
      return line_of_sight({begin + static_cast<std::ptrdiff_t>(first),
                            begin + static_cast<std::ptrdiff_t>(last + 1)},
                           std::min(radii[first], radii[last]));
    });
    const std::size_t fewest = arc.from == arc.to ? 4 : 2;  // a closed one stays a polygon
    if (taut.size() >= fewest) arc.points.assign(taut.begin() + 1, taut.end() - 1);
  }
}

void HomologyGuard::collapse(SkeletonGraph& graph, int arc, int into, const CurvePoint& point) {
  if (!has_handles()) {
    graph.collapse(arc, into, point);
    return;
  }
  graph.orient_from(arc, into);
  const auto line = graph.polyline(graph.arcs[idx(arc)]);  // from `into` to the lost node
  const int gone = graph.arcs[idx(arc)].to;
  std::array<std::vector<Point>, 2> way;  // from either end of the arc to the new place
  way[0] = {line.front()};
  way[1].assign(line.rbegin(), line.rend());
  if (point.place() == line.back()) {
    way[0] = line;
    way[1] = {line.back()};
  }
  // Before the nodes become one: the points to put in at the end of each arc.
  struct End {
    int arc;
    bool at_begin;
    std::vector<Point> points;
  };
  std::vector<End> ends;
  for (const int node : {into, gone}) {
    const auto& to_new_place = way[node == into ? 0 : 1];
    for (const int s : graph.nodes[idx(node)].arcs) {
      if (s == arc) continue;
      const auto course = graph.polyline(graph.arcs[idx(s)]);
      for (const bool at_begin : {true, false}) {
        const Arc& other = graph.arcs[idx(s)];
        if ((at_begin ? other.from : other.to) != node) continue;
        std::vector<Point> old{at_begin ? course[1] : course[course.size() - 2]};
        const Point next = old.front();
        old.insert(old.end(), to_new_place.begin(), to_new_place.end());
        if (classes_->homologous(old, {next, point.place()})) continue;
        ends.push_back({s, at_begin, {to_new_place.begin(), to_new_place.end() - 1}});
      }
    }
  }
  graph.collapse(arc, into, point);
  for (auto& [s, at_begin, points] : ends) {
    auto& inner = graph.arcs[idx(s)].points;
    if (at_begin) std::reverse(points.begin(), points.end());
    inner.insert(at_begin ? inner.begin() : inner.end(), points.begin(), points.end());
  }
}

std::vector<int> HomologyGuard::restore_points(const SkeletonGraph& before, SkeletonGraph& graph,
                                               const SurfaceTree& tree) {
  std::vector<int> restored;
  if (!has_handles()) return restored;
  const auto arcs = core(before);
  std::vector<std::vector<Point>> seen(graph.arcs.size());  // courses at the last look
  for (bool changed = true; changed;) {
    changed = false;
    for (const int s : arcs) {
      hear_stop();
      const Arc& old = before.arcs[idx(s)];
      if (!same_ends(old, graph.arcs[idx(s)])) continue;
      const auto was = before.polyline(old);
      auto is = graph.polyline(graph.arcs[idx(s)]);
      const auto& last = seen[idx(s)];
      bool here = false;
      for (std::size_t k = 0; k + 1 < was.size(); ++k) {
        if (was[k] == is[k] && was[k + 1] == is[k + 1]) continue;
        if (!last.empty() && last[k] == is[k] && last[k + 1] == is[k + 1]) continue;
        const std::array ends{&point_of(before, s, k), &point_of(before, s, k + 1)};
        if (&tree == own_tree_ && share_a_ball(tree, ends, {is[k], is[k + 1]}, near_)) continue;
        const bool stays =
            classes_->homologous({was[k], was[k + 1]}, {is[k], is[k + 1]}) &&
            (!crosses(tree, is[k], is[k + 1], near_) || crosses(tree, was[k], was[k + 1], near_));
        if (stays) continue;
        here = put_back(point_of(graph, s, k), point_of(before, s, k)) || here;
        here = put_back(point_of(graph, s, k + 1), point_of(before, s, k + 1)) || here;
      }
      if (here) restored.push_back(s);
      changed = changed || here;
      seen[idx(s)] = std::move(is);
    }
  }
  return restored;
}

bool HomologyGuard::finds_all_handles(const SkeletonGraph& graph,
                                      const PartitionGraph& partition) const {
  const CurveSkeleton skeleton = skeleton_of(graph, partition.groups).skeleton;
  return classes_->rank(skeleton) == graph_topology(skeleton).cycle_rank;
}

}  // namespace curveskel
