#include "skeleton/embed/place/relax.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/monitor.hpp>
#include "base/parallel.hpp"
#include "skeleton/embed/place/cross_section.hpp"

namespace curveskel {
namespace {

/// The place to which thick arcs at a junction lead straight: the mean of its neighbouring points,
/// weighted by the square of their inscribed radii.
Point straight_through(const SkeletonGraph& graph, int node, const SurfaceTree& tree) {
  Point sum = Point::Zero();
  double weight = 0;
  const auto add = [&](const CurvePoint& p) {
    const double radius = std::max(1e-6, p.radius(tree));
    sum += radius * radius * p.place();
    weight += radius * radius;
  };
  const auto end = [&](int other) -> const CurvePoint& { return graph.nodes[idx(other)].point; };
  for (const int s : graph.nodes[static_cast<std::size_t>(node)].arcs) {
    const Arc& arc = graph.arcs[static_cast<std::size_t>(s)];
    const auto& points = arc.points;
    if (arc.from == node) add(points.empty() ? end(arc.to) : points.front());
    if (arc.to == node) add(points.empty() ? end(arc.from) : points.back());
  }
  return sum / weight;
}

/// Junctions move to where their arcs meet with the least turn, as long as they stay central.
void relax_nodes(SkeletonGraph& graph, const SurfaceTree& tree,
                 const std::vector<double>& first_radius, const RelaxOptions& options) {
  for (int h = 0; h < static_cast<int>(graph.nodes.size()); ++h) {
    Node& node = graph.nodes[static_cast<std::size_t>(h)];
    if (!node.alive || graph.degree(h) < 3) continue;
    const Point goal = straight_through(graph, h, tree);
    const CurvePoint candidate = Point(0.5 * (node.point.place() + goal));
    const double least = options.keep_junction * first_radius[static_cast<std::size_t>(h)];
    if (candidate.radius(tree) >= least) node.point = candidate;
  }
}

/// Moves the inner points of one arc in turn, each half-way to the centre of its cross-section
/// and half-way to the middle of its neighbours.
/// Those whose neighbourhood moved by less than 0.3 % of the radius last time are at rest:
/// `last_move` is per inner point, from the round before. Precondition: the nodes' radii are known.
void relax_arc(SkeletonGraph& graph, int s, const SurfaceTree& tree, const SurfaceTree& sections,
               const RelaxOptions& options, std::vector<double>& last_move) {
  Arc& arc = graph.arcs[idx(s)];
  const CurvePoint& first = graph.nodes[idx(arc.from)].point;
  const CurvePoint& last = graph.nodes[idx(arc.to)].point;
  const auto overlap = [&](const CurvePoint& p, const CurvePoint& q) {
    return (p.place() - q.place()).norm() <= p.radius(tree) + q.radius(tree);
  };
  auto& points = arc.points;
  last_move.resize(points.size(), 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double stir = last_move[i];
    if (i > 0) stir = std::max(stir, last_move[i - 1]);
    if (i + 1 < points.size()) stir = std::max(stir, last_move[i + 1]);
    const double radius = points[i].radius(tree);
    if (stir < options.tuning.rest * radius) continue;
    last_move[i] = 0;
    const Point here = points[i].place();
    const CurvePoint& before = i > 0 ? points[i - 1] : first;
    const CurvePoint& after = i + 1 < points.size() ? points[i + 1] : last;
    const Point along = after.place() - before.place();
    const Point centre = cross_section_centre(sections, here, along, radius, options.section);
    const Point target = 0.5 * (here + centre);
    // Along a cubic through two points either way, which does not cut corners (bilaplacian).
    Point middle = 0.5 * (before.place() + after.place());
    if (options.covered && i > 0 && i + 1 < points.size()) {
      const CurvePoint& far_before = i > 1 ? points[i - 2] : first;
      const CurvePoint& far_after = i + 2 < points.size() ? points[i + 2] : last;
      middle =
          (4 * (before.place() + after.place()) - (far_before.place() + far_after.place())) / 6;
    }
    const Point smooth = (1 - options.smoothing) * target + options.smoothing * middle;
    for (const Point& place : {smooth, target}) {
      const CurvePoint candidate(place, tree.inscribed_radius(place, {here, radius}));
      if (candidate.radius(tree) < options.keep * radius) continue;
      if (options.covered && !(overlap(before, candidate) && overlap(after, candidate))) continue;
      last_move[i] = (place - here).norm();
      points[i] = candidate;
      break;
    }
  }
}

}  // namespace

void relax(SkeletonGraph& graph, const SurfaceTree& tree, const SurfaceTree& sections,
           const RelaxOptions& options, HomologyGuard& guard, int threads) {
  std::vector<double> node_radius;
  for (const Node& node : graph.nodes) {
    node_radius.push_back(node.alive ? node.point.radius(tree) : 0);
  }
  std::vector<std::vector<double>> last_moves(graph.arcs.size());
  std::vector<std::size_t> longest_first;  // so that no core ends up with a long one alone
  for (std::size_t s = 0; s < graph.arcs.size(); ++s) {
    if (graph.arcs[s].alive) longest_first.push_back(s);
  }
  std::stable_sort(longest_first.begin(), longest_first.end(), [&](std::size_t a, std::size_t b) {
    return graph.arcs[a].points.size() > graph.arcs[b].points.size();
  });
  for (int round = 0; round < options.rounds; ++round) {
    for (std::size_t s = 0; s < graph.arcs.size(); ++s) {
      if (graph.turn_half_way_round(static_cast<int>(s))) last_moves[s].clear();
    }
    const SkeletonGraph before = guard.has_handles() ? graph : SkeletonGraph{};
    parallel_for(longest_first.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        throw_if_stopped(options.stop);
        const std::size_t s = longest_first[i];
        relax_arc(graph, static_cast<int>(s), tree, sections, options, last_moves[s]);
      }
    });
    if (!options.covered) relax_nodes(graph, tree, node_radius, options);
    for (const int s : guard.restore_points(before, graph, tree)) last_moves[idx(s)].clear();
  }
}

}  // namespace curveskel
