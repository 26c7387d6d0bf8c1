#include "skeleton/embed/place/junctions.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

/// The edge between two such points is inside.
bool overlap(const CurvePoint& junction, const CurvePoint& other, const SurfaceTree& tree) {
  return (other.place() - junction.place()).norm() <=
         std::max(0.0, junction.radius(tree)) + other.radius(tree);
}

/// How many of the first `most` points lie in this share of the junction's ball, one after another.
std::size_t points_within(double share, const CurvePoint& junction,
                          const std::vector<CurvePoint>& points, std::size_t most,
                          const SurfaceTree& tree) {
  const double reach = share * std::max(0.0, junction.radius(tree));
  std::size_t within = 0;
  while (within < most && (points[within].place() - junction.place()).norm() < reach) ++within;
  return within;
}

}  // namespace

void centre_junctions(SkeletonGraph& graph, const SurfaceTree& tree) {
  constexpr int steps = 30;
  for (int h = 0; h < static_cast<int>(graph.nodes.size()); ++h) {
    Node& node = graph.nodes[static_cast<std::size_t>(h)];
    if (!node.alive || graph.degree(h) < 3) continue;
    const double first_radius = node.point.radius(tree);
    const Point start = node.point.place();
    for (int step = 0; step < steps && node.point.radius(tree) > 0; ++step) {
      const Point& here = node.point.place();
      const double radius = node.point.radius(tree);
      const Point away = (here - tree.nearest(here).point).normalized();
      const CurvePoint candidate = Point(here + 0.1 * radius * away);
      if (candidate.radius(tree) <= radius) break;
      if ((candidate.place() - start).norm() > first_radius) break;
      node.point = candidate;
    }
  }
}

void merge_junctions(SkeletonGraph& graph, const SurfaceTree& tree, HomologyGuard& guard,
                     double factor) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto ratio_of = [&](const Arc& arc) {
    if (!arc.alive || arc.from == arc.to) return never;
    if (graph.degree(arc.from) < 3 || graph.degree(arc.to) < 3) return never;
    const double radius = std::max(graph.nodes[idx(arc.from)].point.radius(tree),
                                   graph.nodes[idx(arc.to)].point.radius(tree));
    return radius > 0 ? graph.length(arc) / radius : never;
  };
  std::vector<double> ratio;
  for (const Arc& arc : graph.arcs) ratio.push_back(ratio_of(arc));
  for (;;) {
    const auto least = std::min_element(ratio.begin(), ratio.end());
    if (least == ratio.end() || !(*least < factor)) return;
    const auto best = static_cast<int>(least - ratio.begin());
    const Arc& arc = graph.arcs[idx(best)];
    const bool keep_from = graph.nodes[idx(arc.from)].point.radius(tree) >=
                           graph.nodes[idx(arc.to)].point.radius(tree);
    const int into = keep_from ? arc.from : arc.to;
    guard.collapse(graph, best, into, CurvePoint(graph.nodes[idx(into)].point));
    *least = never;
    for (const int s : graph.nodes[idx(into)].arcs) {
      ratio[idx(s)] = ratio_of(graph.arcs[idx(s)]);
    }
  }
}

void straighten_at_junctions(SkeletonGraph& graph, const SurfaceTree& tree, double share,
                             bool covered) {
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    std::vector<CurvePoint>& points = arc.points;
    for (const auto& [near, far] : {std::pair(arc.from, arc.to), std::pair(arc.to, arc.from)}) {
      const CurvePoint& junction = graph.nodes[idx(near)].point;
      const CurvePoint& end = graph.nodes[idx(far)].point;
      const bool all_may_go = !covered || overlap(junction, end, tree);
      const std::size_t least = near == far ? 2 : all_may_go ? 0 : 1;
      if (graph.degree(near) >= 3 && points.size() > least) {
        std::size_t within = points_within(share, junction, points, points.size() - least, tree);
        const auto next = [&](std::size_t k) -> const CurvePoint& {
          return k < points.size() ? points[k] : end;
        };
        while (covered && within > 0 && !overlap(junction, next(within), tree)) --within;
        points.erase(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(within));
      }
      std::reverse(points.begin(), points.end());  // twice in all
    }
  }
}

}  // namespace curveskel
