#include "skeleton/embed/ends/tips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "skeleton/embed/place/cross_section.hpp"

namespace curveskel {
namespace {

/// The direction in which the line arrives at its point i, from three points before it, or from
/// outside its inscribed ball: within, the limb has no direction.
Point heading(const std::vector<Point>& line, std::size_t i, double radius) {
  std::size_t from = i - std::min<std::size_t>(i, 3);
  while (from > 0 && (line[i] - line[from]).norm() < radius) --from;
  return (line[i] - line[from]).normalized();
}

/// By more than some 45 degrees.
bool turns_away(const Point& step, const Point& heading) {
  return step.normalized().dot(heading) < 0.7;
}

/// Cuts the arc where all the rest of it and the surface straight ahead lie within `reach`
/// inscribed radii, or where the rest turns away and lies within the ball or not far beyond it in a
/// narrow corner: an end that bends into a corner of a blunt end goes.
void retract(SkeletonGraph& graph, Arc& arc, const SurfaceTree& tree, double reach,
             const TipTuning& tuning) {
  const auto line = graph.polyline(arc);
  const double tip_radius = graph.nodes[idx(arc.to)].point.radius(tree);
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const double radius = arc.points[i - 1].radius(tree);
    const auto rest_within = [&](double distance) {
      return std::none_of(line.begin() + static_cast<std::ptrdiff_t>(i), line.end(),
                          [&](const Point& p) { return (p - line[i]).norm() > distance; });
    };
    const double curl_reach = tip_radius < tuning.narrow * radius ? tuning.corner_reach : 1;
    if (!rest_within(std::max(reach, curl_reach) * radius)) continue;
    const Point ahead = heading(line, i, radius);
    const bool curls = turns_away(line.back() - line[i], ahead) && rest_within(curl_reach * radius);
    const auto is_blunt = [&] {
      return rest_within(reach * radius) && tree.ray(line[i], ahead, reach * radius).triangle >= 0;
    };
    if (!curls && !is_blunt()) continue;
    graph.nodes[idx(arc.to)].point = arc.points[i - 1];
    arc.points.resize(i - 1);
    return;
  }
}

/// Steps straight ahead, recentred each time, until the surface ahead is near. A step that turns
/// away has left the end that it should reach; steps that end farther from the surface ahead, in
/// inscribed radii, than one before them lead into a corner and are taken back.
void extend_tip(SkeletonGraph& graph, Arc& arc, const SurfaceTree& tree, double gap,
                const TipTuning& tuning) {
  auto line = graph.polyline(arc);
  std::vector<CurvePoint> added{graph.nodes[idx(arc.to)].point};  // from the old tip on
  double radius = added.front().radius(tree);
  const Point first_heading = heading(line, line.size() - 1, radius);
  double nearest = std::numeric_limits<double>::infinity();  // in inscribed radii
  std::size_t kept = 1;
  while (radius >= tuning.least_radius) {  // each step leads on, so the surface ahead ends them
    const Point& tip = line.back();
    const Point direction = heading(line, line.size() - 1, radius);
    const double left = tree.ray(tip, direction).distance;
    if (left <= tuning.tolerance * nearest * radius) kept = added.size();
    nearest = std::min(nearest, left / radius);
    if (left <= gap * radius || !std::isfinite(left)) break;
    const Point guess = tip + std::min(0.5 * radius, left - radius) * direction;
    const double guess_radius = tree.inscribed_radius(guess);
    Point next = 0.5 * (guess + cross_section_centre(tree, guess, direction, guess_radius));
    radius = tree.inscribed_radius(next);
    if (radius < guess_radius) {
      next = guess;
      radius = guess_radius;
    }
    if (radius < tuning.least_radius) break;
    if (turns_away(next - tip, first_heading)) break;
    line.push_back(next);
    added.emplace_back(next, radius);
  }
  graph.nodes[idx(arc.to)].point = added[kept - 1];
  arc.points.insert(arc.points.end(), added.begin(),
                    added.begin() + static_cast<std::ptrdiff_t>(kept - 1));
}

}  // namespace

void shape_tips(SkeletonGraph& graph, const SurfaceTree& tree, double reach, double gap,
                const TipTuning& tuning) {
  for (int s = 0; s < static_cast<int>(graph.arcs.size()); ++s) {
    if (!graph.arcs[idx(s)].alive) continue;
    for (const int tip : {graph.arcs[idx(s)].from, graph.arcs[idx(s)].to}) {
      if (graph.degree(tip) != 1) continue;
      graph.orient_from(
          s, graph.arcs[idx(s)].from == tip ? graph.arcs[idx(s)].to : graph.arcs[idx(s)].from);
      retract(graph, graph.arcs[idx(s)], tree, reach, tuning);
      extend_tip(graph, graph.arcs[idx(s)], tree, gap, tuning);
    }
  }
}

void lengthen_short_leaves(SkeletonGraph& graph, const SurfaceTree& tree, const TipTuning& tuning) {
  for (int s = 0; s < static_cast<int>(graph.arcs.size()); ++s) {
    if (!graph.is_leaf(graph.arcs[idx(s)])) continue;
    const int from = graph.arcs[idx(s)].from;
    graph.orient_from(s, graph.degree(from) == 1 ? graph.arcs[idx(s)].to : from);
    Arc& arc = graph.arcs[idx(s)];
    auto line = graph.polyline(arc);
    const double junction_radius = graph.nodes[idx(arc.from)].point.radius(tree);
    const double missing = tuning.leaf_margin * junction_radius - graph.length(arc);
    if (missing <= 0 || graph.length(arc) < 0.25 * junction_radius) continue;
    CurvePoint& end = graph.nodes[idx(arc.to)].point;
    const Point ahead = heading(line, line.size() - 1, end.radius(tree));
    const CurvePoint tip = Point(line.back() + missing * ahead);
    if (tip.radius(tree) < tuning.leaf_narrowest * junction_radius) continue;
    if (tree.ray(line.back(), ahead, missing).triangle >= 0) continue;
    arc.points.push_back(end);
    end = tip;
  }
}

std::vector<TipHeading> tip_headings(const SkeletonGraph& graph, const SurfaceTree& tree,
                                     const RelaxTuning& tuning) {
  std::vector<TipHeading> headings;
  for (const Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    auto line = graph.polyline(arc);
    for (const int node : {arc.from, arc.to}) {
      if (graph.degree(node) == 1) {
        const double radius = graph.nodes[idx(node)].point.radius(tree);
        const auto before = [&](double way) {
          const auto leaves = [&](const Point& p) { return (line.front() - p).norm() >= way; };
          return *std::find_if(line.begin(), line.end() - 1, leaves);
        };
        const Point way = before(radius) - before(std::max(3 * radius, tuning.heading_way));
        headings.push_back({node, way.normalized(), radius});
      }
      std::reverse(line.begin(), line.end());
    }
  }
  return headings;
}

void centre_tips(SkeletonGraph& graph, const SurfaceTree& tree,
                 const std::vector<TipHeading>& headings, const RelaxTuning& tuning) {
  for (const auto& [node, direction, first_radius] : headings) {
    CurvePoint& tip = graph.nodes[idx(node)].point;
    const Point centre = cross_section_centre(tree, tip.place(), direction, tip.radius(tree));
    const CurvePoint candidate = Point(0.5 * (tip.place() + centre));
    if (candidate.radius(tree) >= tuning.tip_keep * first_radius) tip = candidate;
  }
}

}  // namespace curveskel
