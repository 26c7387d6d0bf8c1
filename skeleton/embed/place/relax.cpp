#include "skeleton/embed/place/relax.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/indices.hpp"
#include "base/parallel.hpp"
#include "skeleton/embed/ends/tips.hpp"
#include "skeleton/embed/place/axes.hpp"
#include "skeleton/embed/place/cross_section.hpp"

namespace curveskel {
namespace {

/// Points along a polyline, half of the radius there apart, ends left out; `radii` per vertex.
std::vector<Point> spaced(const std::vector<Point>& line, const std::vector<double>& radii,
                          double most_spacing, int fewest) {
  std::vector<double> steps{0};  // from the beginning
  steps.reserve(line.size());
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double spacing =
        std::clamp(0.25 * (radii[i - 1] + radii[i]), least_spacing, most_spacing);
    steps.push_back(steps.back() + (line[i] - line[i - 1]).norm() / spacing);
  }
  const int inner = std::max(fewest, static_cast<int>(std::lround(steps.back())) - 1);
  std::vector<Point> points;
  points.reserve(idx(inner));
  std::size_t i = 1;
  for (int k = 1; k <= inner; ++k) {
    const double place = steps.back() * k / (inner + 1);
    while (i + 1 < line.size() && steps[i] < place) ++i;
    const double length = steps[i] - steps[i - 1];
    const double t = length > 0 ? (place - steps[i - 1]) / length : 0;
    points.push_back(line[i - 1] + t * (line[i] - line[i - 1]));
  }
  return points;
}

int fewest_points(const Arc& arc) { return arc.from == arc.to ? 3 : 1; }

}  // namespace

std::vector<double> radii_at(const SurfaceTree& tree, const std::vector<Point>& points) {
  std::vector<double> radii(points.size());
  std::transform(points.begin(), points.end(), radii.begin(),
                 [&](const Point& p) { return tree.inscribed_radius(p); });
  return radii;
}

void space_evenly(SkeletonGraph& graph, const SurfaceTree& tree, double most_spacing) {
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    const auto line = graph.polyline(arc);
    auto radii = radii_at(tree, line);
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    radii.assign(line.size(), *middle);
    arc.points = spaced(line, radii, most_spacing, fewest_points(arc));
  }
}

void space_by_radius(SkeletonGraph& graph, const SurfaceTree& tree, double most_spacing) {
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    const auto line = graph.polyline(arc);
    arc.points = spaced(line, radii_at(tree, line), most_spacing, fewest_points(arc));
  }
}

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
    const Point goal =
        options.meet ? meeting_of_axes(graph, h, here.radius) : straight_through(graph, h, tree);
    const Point candidate = 0.5 * (node.position + goal);
    const SurfaceTree::Ball there{candidate, tree.inscribed_radius(candidate)};
    const double least = options.keep_junction * first_radius[static_cast<std::size_t>(h)];
    if (there.radius < least) continue;
    if (options.meet && makes_spur(graph, h, here, there)) continue;
    node.position = candidate;
  }
}

}  // namespace

namespace {

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
    if (stir < 3e-3 * radius[i + 1]) continue;
    last_move[i] = 0;
    const Point& before = i > 0 ? points[i - 1] : line.front();
    const Point& after = i + 1 < points.size() ? points[i + 1] : line.back();
    const Point along = after - before;
    const Point centre = options.is_own
                             ? cross_section_centre(tree, points[i], along, radius[i + 1], is_own)
                             : cross_section_centre(tree, points[i], along, radius[i + 1]);
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

}  // namespace

namespace {

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
  std::vector<double> hub_radius;
  for (const Node& node : graph.nodes) {
    hub_radius.push_back(node.alive ? tree.inscribed_radius(node.position) : 0);
  }
  const auto headings = options.tips ? tip_headings(graph, tree) : std::vector<TipHeading>{};
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
    if (!options.covered) relax_nodes(graph, tree, hub_radius, options);
    centre_tips(graph, tree, headings);
    for (const int s : guard.restore_points(before, graph, tree)) rest[idx(s)] = {};
  }
}

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

void thin_out(SkeletonGraph& graph, const SurfaceTree& tree, double most_spacing) {
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    const auto line = graph.polyline(arc);
    auto radius = radii_at(tree, line);
    std::vector<Point> kept;
    std::size_t last = 0;
    const std::size_t least = arc.from == arc.to ? 2 : 1;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      const double gap = (line[i + 1] - line[last]).norm();
      const bool enough = kept.size() + (line.size() - 2 - i) >= least;
      if (enough && gap <= std::clamp(0.5 * radius[i], least_spacing, most_spacing) &&
          (gap <= radius[last] + radius[i + 1] || !crosses(tree, line[last], line[i + 1]))) {
        continue;
      }
      kept.push_back(line[i]);
      last = i;
    }
    arc.points = std::move(kept);
  }
}

void cut_detours(SkeletonGraph& graph, const SurfaceTree& tree) {
  constexpr double reach = 0.9;   // of the smaller ball
  constexpr double detour = 1.4;  // of the chord
  for (Arc& arc : graph.arcs) {
    if (!arc.alive || arc.from == arc.to || arc.points.size() < 2) continue;
    const auto line = graph.polyline(arc);
    const auto radii = radii_at(tree, line);
    std::vector<Point> kept;
    std::size_t here = 0;
    while (here + 1 < line.size()) {
      std::size_t next = here + 1;
      double length = (line[next] - line[here]).norm();
      for (std::size_t there = here + 2; there < line.size(); ++there) {
        length += (line[there] - line[there - 1]).norm();
        if (length > 4 * std::max(radii[here], 0.0)) break;
        const double chord = (line[there] - line[here]).norm();
        const bool in_both = chord < reach * std::min(radii[here], radii[there]);
        if (in_both && length > detour * chord) next = there;
      }
      here = next;
      if (here + 1 < line.size()) kept.push_back(line[here]);
    }
    arc.points = std::move(kept);
  }
}

}  // namespace curveskel
