#include <curveskel/advanced/embed.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <curveskel/advanced/laplacian.hpp>
#include "base/indices.hpp"
#include "skeleton/embed/arc_projection.hpp"
#include "skeleton/embed/branches/grow_branches.hpp"
#include "skeleton/embed/branches/prune.hpp"
#include "skeleton/embed/contain/bottleneck.hpp"
#include "skeleton/embed/contain/inside.hpp"
#include "skeleton/embed/ends/tips.hpp"
#include "skeleton/embed/place/relax.hpp"
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/homology/homology_guard.hpp"
#include "skeleton/homology/reroute.hpp"

namespace curveskel {
namespace {

/// Each group at the area-weighted mean of its vertices' ball centres, each cut curve at that of
/// the ends of the edges that it crosses.
std::vector<Point> positions_from_balls(const Surface& surface, const InscribedBalls& balls,
                                        const PartitionGraph& partition) {
  const Eigen::VectorXd areas = vertex_areas(surface);
  std::vector<Point> sum(idx(partition.nodes()), Point::Zero());
  std::vector<double> weight(idx(partition.nodes()), 0);
  const auto add = [&](int node, int vertex) {
    const double w = std::max(areas[vertex], std::numeric_limits<double>::min());
    sum[idx(node)] += w * balls.centres.row(vertex).transpose();
    weight[idx(node)] += w;
  };
  for (int v = 0; v < static_cast<int>(partition.group_of_vertex.size()); ++v) {
    add(partition.group_of_vertex[v], v);
  }
  for (int c = 0; c < static_cast<int>(partition.cut_curves.size()); ++c) {
    for (const auto& edge : partition.cut_curves[idx(c)]) {
      add(partition.groups + c, edge[0]);
      add(partition.groups + c, edge[1]);
    }
  }
  for (std::size_t n = 0; n < sum.size(); ++n) sum[n] /= weight[n];
  return sum;
}

/// Junctions that share most of one inscribed ball become one, at the larger ball.
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

/// Drops the points of each arc that lie within `share` of the ball of its junction, so that it
/// leaves straight. An arc that is `covered` by balls that overlap stays so.
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

/// Every vertex goes to the nearest of the nodes that its group may belong to.
Eigen::VectorXi nearest_nodes(const InscribedBalls& balls, const PartitionGraph& partition,
                              const EmbeddedNodes& nodes) {
  Eigen::VectorXi node_of_vertex(partition.group_of_vertex.size());
  for (Eigen::Index v = 0; v < node_of_vertex.size(); ++v) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int node : nodes.nodes_of_group[idx(partition.group_of_vertex[v])]) {
      const double distance = (nodes.skeleton.nodes.row(node) - balls.centres.row(v)).squaredNorm();
      if (distance < nearest) {
        nearest = distance;
        node_of_vertex[v] = node;
      }
    }
  }
  return node_of_vertex;
}

/// Two arcs between the same nodes, or a closed one, need inner points to be told apart.
void keep_simple(SkeletonGraph& graph) {
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    const std::size_t least = arc.from == arc.to ? 2 : 1;
    while (arc.points.size() < least) {
      const auto line = graph.polyline(arc);
      std::vector<Point> points;
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        if (i > 0) points.push_back(line[i]);
        points.push_back(0.5 * (line[i] + line[i + 1]));
      }
      arc.points = std::move(points);
    }
  }
}

/// The largest distance between points of an arc: D / 60, or more if the surface itself is so
/// coarse that the curve would be sampled more finely than its surroundings.
double most_spacing(const Surface& surface) {
  constexpr double of_edge = 0.3;
  double sum = 0;
  for (const auto& t : surface.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      sum += (surface.positions.row(t(k)) - surface.positions.row(t((k + 1) % 3))).norm();
    }
  }
  return std::max(1.0 / 60, of_edge * sum / static_cast<double>(surface.triangles.size()));
}

/// The surface, its tree and the rest that a SkeletonGraph is held against.
struct Setting {
  const Surface& surface;
  const SurfaceTree& tree;
  const InscribedBalls& balls;
  const PartitionGraph& partition;
  const EmbedOptions& options;
  int threads;
  double spacing;  // of the points of an arc, at most
  HomologyGuard& guard;
};

/// Makes a change that gives arcs other points, and takes back points that lead a cycle off its
/// handle.
template <typename Change>
void keep_handles(SkeletonGraph& graph, const Setting& setting, const Change& change) {
  if (!setting.guard.has_handles()) {
    change();
    return;
  }
  const SkeletonGraph before = graph;
  change();
  setting.guard.restore_arcs(before, graph, setting.tree);
}

void straighten(SkeletonGraph& graph, const Setting& setting) {
  keep_handles(graph, setting, [&] {
    straighten_at_junctions(graph, setting.tree, setting.options.straight, false);
  });
}

/// The number of places that could not be kept inside.
int stay_inside(SkeletonGraph& graph, const Setting& setting) {
  const auto& [surface, tree, balls, partition, options, threads, spacing, guard] = setting;
  return keep_inside(graph, surface, balls, partition, tree, guard);
}

void centre(SkeletonGraph& graph, const Setting& setting) {
  RelaxOptions centring;
  centring.keep = setting.options.keep_radius;
  centring.rounds = setting.options.first_rounds;
  relax(graph, setting.tree, centring, setting.guard, setting.threads);
}

/// Once no arc comes or goes: the places of junctions decide which leaves are spurs.
void centre_at_last(SkeletonGraph& graph, const Setting& setting) {
  constexpr int times_spaced = 4;  // kinks draw points together and then hold them
  RelaxOptions centring;
  centring.keep = setting.options.keep_radius;
  centring.rounds = setting.options.relax_rounds / times_spaced;
  centring.meet = true;
  centring.tips = true;
  centring.keep_junction = 1;
  const auto projections =
      project_on_arcs(graph, setting.surface, setting.balls, setting.partition);
  centring.is_own = [&](int triangle, int arc) {
    const auto corners = setting.surface.triangles.row(triangle);
    return std::any_of(corners.begin(), corners.end(),
                       [&](int vertex) { return projections[idx(vertex)].arc == arc; });
  };
  for (int spaced = 0; spaced < times_spaced; ++spaced) {
    keep_handles(graph, setting, [&] { space_by_radius(graph, setting.tree, setting.spacing); });
    relax(graph, setting.tree, centring, setting.guard, setting.threads);
  }
}

void space_and_centre(SkeletonGraph& graph, const Setting& setting) {
  straighten(graph, setting);
  keep_handles(graph, setting, [&] { space_evenly(graph, setting.tree, setting.spacing); });
  centre(graph, setting);
}

/// True if something changed. All stays as it is if the change makes nothing, or something to
/// which no way inside is found.
template <typename Change>
bool change_and_centre(SkeletonGraph& graph, const Setting& setting, const Change& change) {
  SkeletonGraph changed = graph;
  if (change(changed) == 0 || stay_inside(changed, setting) > 0) return false;
  graph = std::move(changed);
  space_and_centre(graph, setting);
  prune_spurs(graph, setting.tree, 1);
  return true;
}

void shape_tips(SkeletonGraph& graph, const Setting& setting) {
  shape_tips(graph, setting.tree, setting.options.tip_reach, setting.options.tip_gap);
  lengthen_short_leaves(graph, setting.tree);
}

/// Mends arcs that the surgery has led astray, left out or left short.
void correct(SkeletonGraph& graph, const Setting& in) {
  constexpr double least_prominence = 1;  // that of a half-ball
  const double limit = std::max(least_prominence, prominence_limit(in.options.detail));
  const bool rerouted = change_and_centre(graph, in, [&in](SkeletonGraph& changed) {
    return reroute_bottlenecks(changed, in.surface, in.balls, in.partition, in.tree);
  });
  if (rerouted) shape_tips(graph, in);  // they were shaped as the old ways arrived
  change_and_centre(graph, in, [&in, limit](SkeletonGraph& changed) {
    return grow_branches(changed, in.surface, in.tree, in.balls, in.partition, limit);
  });
}

/// Without blunt ends and inside. Where straight lines between the partition's nodes, kept inside
/// as they are, lead a cycle off its handle, cycles go along the surface.
SkeletonGraph first_graph(const Setting& setting) {
  const auto& [surface, tree, balls, partition, options, threads, spacing, guard] = setting;
  const double limit = prominence_limit(options.detail);
  const SkeletonGraph whole =
      skeleton_graph_of(partition, positions_from_balls(surface, balls, partition));
  SkeletonGraph graph = whole;
  prune_blunt(graph, surface, partition, limit);
  HomologyGuard anywhere;  // outside, lines say nothing about handles yet
  const int uncovered = keep_inside(graph, surface, balls, partition, tree, anywhere);
  if (!guard.has_handles()) return graph;
  if (uncovered == 0 && goes_round_all_handles(graph, partition, surface)) return graph;
  graph = whole;
  reroute_around_handles(graph, surface, tree, balls, partition, guard);
  prune_blunt(graph, surface, partition, limit);
  stay_inside(graph, setting);
  guard.pull_taut(graph, tree);
  return graph;
}

/// Within the coarsened surface, whose tree is quick to ask: all that takes many rays.
SkeletonGraph lay_out(const Setting& setting, const Monitor& monitor) {
  monitor.report("embed", 0);
  const auto& [surface, tree, balls, partition, options, threads, spacing, guard] = setting;
  SkeletonGraph graph = first_graph(setting);
  keep_handles(graph, setting, [&] { centre_junctions(graph, setting.tree); });
  merge_junctions(graph, tree, guard, options.merge);
  monitor.report("embed", 0.2);

  do {
    space_and_centre(graph, setting);
    straighten(graph, setting);
    shape_tips(graph, setting);
    monitor.report("embed", 0.4);
  } while (prune_spurs(graph, tree, 1));
  correct(graph, setting);
  merge_junctions(graph, tree, guard, options.merge);  // centred, they may have come together
  centre_at_last(graph, setting);
  monitor.report("embed", 0.6);
  return graph;
}

/// Within the full surface: keeps the curve inside, smooths, prunes spurs.
CurveSkeleton settle(SkeletonGraph graph, const Setting& setting, const Monitor& monitor) {
  const auto& [surface, tree, balls, partition, options, threads, spacing, guard] = setting;
  RelaxOptions smoothing;
  smoothing.keep = options.keep_radius;
  smoothing.covered = true;
  smoothing.rounds = options.smooth_rounds;
  do {
    keep_simple(graph);
    stay_inside(graph, setting);
    keep_handles(graph, setting, [&] { thin_out(graph, setting.tree, setting.spacing); });
    keep_handles(graph, setting, [&] { cut_detours(graph, setting.tree); });
    relax(graph, tree, smoothing, guard, threads);
    keep_handles(graph, setting, [&] {
      straighten_at_junctions(graph, setting.tree, setting.options.straight_at_last, true);
    });
    keep_handles(graph, setting, [&] { cut_detours(graph, setting.tree); });
    lengthen_short_leaves(graph, tree);
  } while (prune_spurs(graph, tree, 1));
  monitor.report("embed", 0.9);

  EmbeddedNodes nodes = skeleton_of(graph, partition.groups);
  CurveSkeleton& skeleton = nodes.skeleton;
  skeleton.node_of_vertex = nearest_nodes(balls, partition, nodes);
  skeleton.radii.resize(skeleton.nodes.rows());
  for (Eigen::Index n = 0; n < skeleton.nodes.rows(); ++n) {
    skeleton.radii[n] = std::max(0.0, tree.inscribed_radius(skeleton.nodes.row(n)));
  }
  monitor.report("embed", 1);
  return std::move(nodes.skeleton);
}

}  // namespace

double prominence_limit(double detail) {
  constexpr double most = 3;
  constexpr double usual = 1.15;
  return detail < 0.5 ? most - 2 * detail * (most - usual) : 2 * (1 - detail) * usual;
}

CurveSkeleton embed(const Surface& surface, const SurfaceTree& tree,
                    const std::function<const SurfaceTree&()>& finer, const InscribedBalls& balls,
                    const PartitionGraph& partition, const EmbedOptions& options, int threads,
                    const Monitor& monitor) {
  const double spacing = most_spacing(surface);
  HomologyGuard guard(surface);
  SkeletonGraph graph =
      lay_out({surface, tree, balls, partition, options, threads, spacing, guard}, monitor);
  return settle(std::move(graph),
                {surface, finer(), balls, partition, options, threads, spacing, guard}, monitor);
}

}  // namespace curveskel
