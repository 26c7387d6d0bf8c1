#include "skeleton/embed/place/relax.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"
#include "skeleton/embed/ends/tips.hpp"
#include "skeleton/embed/place/axes.hpp"
#include "skeleton/embed/place/cross_section.hpp"
#include "skeleton/embed/place/spacing.hpp"

namespace curveskel {
namespace {

/// The place to which thick arcs at a junction lead straight: the mean of its neighbouring points,
/// weighted by the square of their inscribed radii.
Point straight_through(const SkeletonGraph& graph, int node, const SurfaceTree& tree) {
  Point sum = Point::Zero();
  double weight = 0;
  const auto add = [&](const Point& p) {
    const double radius = std::max(1e-6, tree.inscribed_radius(p));
    sum += radius * radius * p;
    weight += radius * radius;
  };
  const auto place = [&](int other) -> const Point& {
    return graph.nodes[static_cast<std::size_t>(other)].position;
  };
  for (const int s : graph.nodes[static_cast<std::size_t>(node)].arcs) {
    const Arc& arc = graph.arcs[static_cast<std::size_t>(s)];
    const auto& points = arc.points;
    if (arc.from == node) add(points.empty() ? place(arc.to) : points.front());
    if (arc.to == node) add(points.empty() ? place(arc.from) : points.back());
  }
  return sum / weight;
}

/// Junctions move to where their arcs, or the axes of these, meet with the least turn, as long
/// as they stay central.
void relax_nodes(SkeletonGraph& graph, const SurfaceTree& tree,
                 const std::vector<double>& first_radius, const RelaxOptions& options) {
  for (int h = 0; h < static_cast<int>(graph.nodes.size()); ++h) {
    Node& node = graph.nodes[static_cast<std::size_t>(h)];
    if (!node.alive || graph.degree(h) < 3) continue;
    const SurfaceTree::Ball here{node.position, tree.inscribed_radius(node.position)};
    const Point goal = options.meet ? meeting_of_axes(graph, h, here.radius, options.tuning)
                                    : straight_through(graph, h, tree);
    const Point candidate = 0.5 * (node.position + goal);
    const SurfaceTree::Ball there{candidate, tree.inscribed_radius(candidate)};
    const double least = options.keep_junction * first_radius[static_cast<std::size_t>(h)];
    if (there.radius < least) continue;
    if (options.meet && makes_spur(graph, h, here, there, options.tuning)) continue;
    node.position = candidate;
  }
}

/// State of an arc, handed on from round to round.
struct Rest {
  std::vector<double> last_move;  // per inner point
  std::vector<double> radius;     // inscribed, per point, ends included
  Point from = Point::Zero();     // where the ends were
  Point to = Point::Zero();
};

/// The inscribed radii along the arc, of which only those at ends that moved are asked for anew.
void update_radii(Rest& rest, const SurfaceTree& tree, const std::vector<Point>& line) {
  if (rest.radius.size() != line.size()) {
    rest.radius = radii_at(tree, line);
  } else {
    if (rest.from != line.front()) rest.radius.front() = tree.inscribed_radius(line.front());
    if (rest.to != line.back()) rest.radius.back() = tree.inscribed_radius(line.back());
  }
  rest.from = line.front();
  rest.to = line.back();
}

/// Moves the inner points of one arc in turn, each half-way to the centre of its cross-section
/// and half-way to the middle of its neighbours.
/// Those whose neighbourhood moved by less than 0.3 % of the radius last time are at rest.
void relax_arc(SkeletonGraph& graph, int s, const SurfaceTree& tree, const RelaxOptions& options,
               Rest& rest) {
  Arc& arc = graph.arcs[idx(s)];
  const auto line = graph.polyline(arc);
  update_radii(rest, tree, line);
  auto& [last_move, radius, from, to] = rest;
  const auto overlap = [&](const Point& p, double p_radius, const Point& q, double q_radius) {
    return (p - q).norm() <= p_radius + q_radius;
  };
  const auto is_own = [&](int triangle) { return options.is_own(triangle, s); };
  auto& points = arc.points;
  last_move.resize(points.size(), 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double stir = last_move[i];
    if (i > 0) stir = std::max(stir, last_move[i - 1]);
    if (i + 1 < points.size()) stir = std::max(stir, last_move[i + 1]);
    if (stir < options.tuning.rest * radius[i + 1]) continue;
    last_move[i] = 0;
    const Point& before = i > 0 ? points[i - 1] : line.front();
    const Point& after = i + 1 < points.size() ? points[i + 1] : line.back();
    const Point along = after - before;
    const Point centre =
        options.is_own
            ? cross_section_centre(tree, points[i], along, radius[i + 1], is_own, options.section)
            : cross_section_centre(tree, points[i], along, radius[i + 1], options.section);
    const Point target = 0.5 * (points[i] + centre);
    // Along a cubic through two points either way, which does not cut corners (bilaplacian).
    Point middle = 0.5 * (before + after);
    if (options.covered && i > 0 && i + 1 < points.size()) {
      const Point& far_before = i > 1 ? points[i - 2] : line.front();
      const Point& far_after = i + 2 < points.size() ? points[i + 2] : line.back();
      middle = (4 * (before + after) - (far_before + far_after)) / 6;
    }
    const Point smooth = (1 - options.smoothing) * target + options.smoothing * middle;
    for (const Point& candidate : {smooth, target}) {
      const double moved = tree.inscribed_radius(candidate, {points[i], radius[i + 1]});
      if (moved < options.keep * radius[i + 1]) continue;
      if (options.covered && !(overlap(before, radius[i], candidate, moved) &&
                               overlap(after, radius[i + 2], candidate, moved))) {
        continue;
      }
      last_move[i] = (candidate - points[i]).norm();
      points[i] = candidate;
      radius[i + 1] = moved;
      break;
    }
  }
}

/// The node of a closed curve is no special place: half-way round becomes the node, so that the
/// point there takes part like any other.
void turn_half_way_round(SkeletonGraph& graph, Arc& arc) {
  Point& node = graph.nodes[static_cast<std::size_t>(arc.from)].position;
  const auto middle = arc.points.begin() + static_cast<std::ptrdiff_t>(arc.points.size() / 2);
  std::vector<Point> points(middle + 1, arc.points.end());
  points.push_back(node);
  points.insert(points.end(), arc.points.begin(), middle);
  node = *middle;
  arc.points = std::move(points);
}

}  // namespace

void relax(SkeletonGraph& graph, const SurfaceTree& tree, const RelaxOptions& options,
           HomologyGuard& guard, int threads) {
  std::vector<double> node_radius;
  for (const Node& node : graph.nodes) {
    node_radius.push_back(node.alive ? tree.inscribed_radius(node.position) : 0);
  }
  const auto headings =
      options.tips ? tip_headings(graph, tree, options.tuning) : std::vector<TipHeading>{};
  std::vector<Rest> rest(graph.arcs.size());
  std::vector<std::size_t> longest_first;  // so that no core ends up with a long one alone
  for (std::size_t s = 0; s < graph.arcs.size(); ++s) {
    if (graph.arcs[s].alive) longest_first.push_back(s);
  }
  std::stable_sort(longest_first.begin(), longest_first.end(), [&](std::size_t a, std::size_t b) {
    return graph.arcs[a].points.size() > graph.arcs[b].points.size();
  });
  for (int round = 0; round < options.rounds; ++round) {
    for (std::size_t s = 0; s < graph.arcs.size(); ++s) {
      Arc& arc = graph.arcs[s];
      if (!arc.alive || arc.from != arc.to || graph.degree(arc.from) != 2) continue;
      if (arc.points.empty()) continue;
      turn_half_way_round(graph, arc);
      rest[s] = {};
    }
    const SkeletonGraph before = guard.has_handles() ? graph : SkeletonGraph{};
    parallel_for(longest_first.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t s = longest_first[i];
        relax_arc(graph, static_cast<int>(s), tree, options, rest[s]);
      }
    });
    if (!options.covered) relax_nodes(graph, tree, node_radius, options);
    centre_tips(graph, tree, headings, options.tuning);
    for (const int s : guard.restore_points(before, graph, tree)) rest[idx(s)] = {};
  }
}

}  // namespace curveskel
