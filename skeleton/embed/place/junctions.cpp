#include "skeleton/embed/place/junctions.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

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
  const auto overlaps = [&](const Point& junction, double radius, const CurvePoint& p) {
    return (p.place() - junction).norm() <= radius + p.radius(tree);
  };
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    const std::size_t least = arc.from == arc.to ? 2 : covered ? 1 : 0;
    auto& points = arc.points;
    for (const int node : {arc.from, arc.to}) {
      if (graph.degree(node) >= 3) {
        const Point& junction = graph.place(node);
        const double radius = std::max(0.0, graph.nodes[idx(node)].point.radius(tree));
        const std::size_t most = points.size() - std::min(least, points.size());
        std::size_t within = 0;
        while (within < most && (points[within].place() - junction).norm() < share * radius) {
          ++within;
        }
        if (covered) {
          while (within > 0 && !overlaps(junction, radius, points[within])) --within;
        }
        points.erase(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(within));
      }
      std::reverse(points.begin(), points.end());  // twice in all
    }
  }
}

}  // namespace curveskel
