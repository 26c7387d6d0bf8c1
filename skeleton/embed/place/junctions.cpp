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
    const Point start = node.position;
    const double first_radius = tree.inscribed_radius(start);
    double radius = first_radius;
    for (int step = 0; step < steps && radius > 0; ++step) {
      const Point away = (node.position - tree.nearest(node.position).point).normalized();
      const Point candidate = node.position + 0.1 * radius * away;
      const double larger = tree.inscribed_radius(candidate);
      if (larger <= radius || (candidate - start).norm() > first_radius) break;
      node.position = candidate;
      radius = larger;
    }
  }
}

void merge_junctions(SkeletonGraph& graph, const SurfaceTree& tree, HomologyGuard& guard,
                     double factor) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto ratio_of = [&](const Arc& arc) {
    if (!arc.alive || arc.from == arc.to) return never;
    if (graph.degree(arc.from) < 3 || graph.degree(arc.to) < 3) return never;
    const double radius = std::max(tree.inscribed_radius(graph.nodes[idx(arc.from)].position),
                                   tree.inscribed_radius(graph.nodes[idx(arc.to)].position));
    return radius > 0 ? graph.length(arc) / radius : never;
  };
  std::vector<double> ratio;
  for (const Arc& arc : graph.arcs) ratio.push_back(ratio_of(arc));
  for (;;) {
    const auto least = std::min_element(ratio.begin(), ratio.end());
    if (least == ratio.end() || !(*least < factor)) return;
    const auto best = static_cast<int>(least - ratio.begin());
    const Arc& arc = graph.arcs[idx(best)];
    const Point a = graph.nodes[idx(arc.from)].position;
    const Point b = graph.nodes[idx(arc.to)].position;
    const bool keep_from = tree.inscribed_radius(a) >= tree.inscribed_radius(b);
    const int into = keep_from ? arc.from : arc.to;
    guard.collapse(graph, best, into, keep_from ? a : b);
    *least = never;
    for (const int s : graph.nodes[idx(into)].arcs) {
      ratio[idx(s)] = ratio_of(graph.arcs[idx(s)]);
    }
  }
}

void straighten_at_junctions(SkeletonGraph& graph, const SurfaceTree& tree, double share,
                             bool covered) {
  const auto overlaps = [&](const Point& junction, double radius, const Point& p) {
    return (p - junction).norm() <= radius + tree.inscribed_radius(p);
  };
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    const std::size_t least = arc.from == arc.to ? 2 : covered ? 1 : 0;
    auto& points = arc.points;
    for (const int node : {arc.from, arc.to}) {
      if (graph.degree(node) >= 3) {
        const Point& junction = graph.nodes[idx(node)].position;
        const double radius = std::max(0.0, tree.inscribed_radius(junction));
        const std::size_t most = points.size() - std::min(least, points.size());
        std::size_t within = 0;
        while (within < most && (points[within] - junction).norm() < share * radius) ++within;
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
