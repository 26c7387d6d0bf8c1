#include "skeleton/embed.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contraction/laplacian.hpp"
#include "skeleton/grow.hpp"
#include "skeleton/handle_keeper.hpp"
#include "skeleton/hosts.hpp"
#include "skeleton/inside.hpp"
#include "skeleton/network.hpp"
#include "skeleton/prune.hpp"
#include "skeleton/relax.hpp"
#include "skeleton/thread.hpp"
#include "skeleton/tips.hpp"
#include "skeleton/wider_ways.hpp"
#include "surface/element_index.hpp"

namespace curveskel {
namespace {

/// Each group at the area-weighted mean of its vertices' ball centres, each circle at that of the
/// ends of the edges that it crosses.
std::vector<Point> positions_from_balls(const Surface& surface, const InscribedBalls& balls,
                                        const VertexGraph& graph) {
  const Eigen::VectorXd areas = vertex_areas(surface);
  std::vector<Point> sum(at(graph.nodes()), Point::Zero());
  std::vector<double> weight(at(graph.nodes()), 0);
  const auto add = [&](int node, int vertex) {
    const double w = std::max(areas[vertex], std::numeric_limits<double>::min());
    sum[at(node)] += w * balls.centres.row(vertex).transpose();
    weight[at(node)] += w;
  };
  for (int v = 0; v < static_cast<int>(graph.group_of_vertex.size()); ++v) {
    add(graph.group_of_vertex[v], v);
  }
  for (int c = 0; c < static_cast<int>(graph.circles.size()); ++c) {
    for (const auto& edge : graph.circles[at(c)]) {
      add(graph.groups + c, edge[0]);
      add(graph.groups + c, edge[1]);
    }
  }
  for (std::size_t n = 0; n < sum.size(); ++n) sum[n] /= weight[n];
  return sum;
}

/// Junctions that share most of one inscribed ball become one, at the larger ball.
void merge_junctions(Network& network, const SurfaceTree& tree, HandleKeeper& keeper,
                     double factor) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto ratio_of = [&](const Strand& strand) {
    if (!strand.alive || strand.from == strand.to) return never;
    if (network.degree(strand.from) < 3 || network.degree(strand.to) < 3) return never;
    const double radius = std::max(tree.inscribed_radius(network.hubs[at(strand.from)].position),
                                   tree.inscribed_radius(network.hubs[at(strand.to)].position));
    return radius > 0 ? network.length(strand) / radius : never;
  };
  std::vector<double> ratio;
  for (const Strand& strand : network.strands) ratio.push_back(ratio_of(strand));
  for (;;) {
    const auto least = std::min_element(ratio.begin(), ratio.end());
    if (least == ratio.end() || !(*least < factor)) return;
    const auto best = static_cast<int>(least - ratio.begin());
    const Strand& strand = network.strands[at(best)];
    const Point a = network.hubs[at(strand.from)].position;
    const Point b = network.hubs[at(strand.to)].position;
    const bool keep_from = tree.inscribed_radius(a) >= tree.inscribed_radius(b);
    const int into = keep_from ? strand.from : strand.to;
    keeper.collapse(network, best, into, keep_from ? a : b);
    *least = never;
    for (const int s : network.hubs[at(into)].strands) {
      ratio[at(s)] = ratio_of(network.strands[at(s)]);
    }
  }
}

/// Drops the points of each strand that lie within `share` of the ball of its junction, so that it
/// leaves straight. Where the strand is `covered` by balls that overlap, it stays so.
void straighten_at_junctions(Network& network, const SurfaceTree& tree, double share,
                             bool covered) {
  const auto overlaps = [&](const Point& junction, double radius, const Point& p) {
    return (p - junction).norm() <= radius + tree.inscribed_radius(p);
  };
  for (Strand& strand : network.strands) {
    if (!strand.alive) continue;
    const std::size_t least = strand.from == strand.to ? 2 : covered ? 1 : 0;
    auto& points = strand.points;
    for (const int hub : {strand.from, strand.to}) {
      if (network.degree(hub) >= 3) {
        const Point& junction = network.hubs[at(hub)].position;
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
Eigen::VectorXi nearest_nodes(const InscribedBalls& balls, const VertexGraph& graph,
                              const NetworkNodes& nodes) {
  Eigen::VectorXi node_of_vertex(graph.group_of_vertex.size());
  for (Eigen::Index v = 0; v < node_of_vertex.size(); ++v) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int node : nodes.group_nodes[at(graph.group_of_vertex[v])]) {
      const double distance = (nodes.skeleton.nodes.row(node) - balls.centres.row(v)).squaredNorm();
      if (distance < nearest) {
        nearest = distance;
        node_of_vertex[v] = node;
      }
    }
  }
  return node_of_vertex;
}

/// Two strands between the same hubs, or a closed one, need inner points to be told apart.
void keep_simple(Network& network) {
  for (Strand& strand : network.strands) {
    if (!strand.alive) continue;
    const std::size_t least = strand.from == strand.to ? 2 : 1;
    while (strand.points.size() < least) {
      const auto line = network.polyline(strand);
      std::vector<Point> points;
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        if (i > 0) points.push_back(line[i]);
        points.push_back(0.5 * (line[i] + line[i + 1]));
      }
      strand.points = std::move(points);
    }
  }
}

/// How far apart the points of a strand may lie: D / 60, or more where the surface itself is so
/// coarse that the curve would be sampled more finely than what it runs through.
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

/// What a network is held against.
struct Setting {
  const Surface& surface;
  const SurfaceTree& tree;
  const InscribedBalls& balls;
  const VertexGraph& graph;
  const EmbedOptions& options;
  int threads;
  double spacing;  // of the points of a strand, at most
  HandleKeeper& keeper;
};

/// Makes a change that gives strands other points, and takes back what leads a cycle off its
/// handle.
template <typename Change>
void keep_handles(Network& network, const Setting& setting, const Change& change) {
  if (!setting.keeper.has_handles()) {
    change();
    return;
  }
  const Network before = network;
  change();
  setting.keeper.restore_strands(before, network, setting.tree);
}

void straighten(Network& network, const Setting& setting) {
  keep_handles(network, setting, [&] {
    straighten_at_junctions(network, setting.tree, setting.options.straight, false);
  });
}

/// The number of places that could not be kept inside.
int stay_inside(Network& network, const Setting& setting) {
  const auto& [surface, tree, balls, graph, options, threads, spacing, keeper] = setting;
  return keep_inside(network, surface, balls, graph, tree, keeper);
}

void centre(Network& network, const Setting& setting) {
  RelaxOptions centring;
  centring.keep = setting.options.keep_radius;
  centring.rounds = setting.options.first_rounds;
  relax(network, setting.tree, centring, setting.keeper, setting.threads);
}

/// Once it is settled which strands there are: where junctions lie decides what is a spur.
void centre_at_last(Network& network, const Setting& setting) {
  constexpr int times_spaced = 4;  // kinks draw points together and then hold them
  RelaxOptions centring;
  centring.keep = setting.options.keep_radius;
  centring.rounds = setting.options.relax_rounds / times_spaced;
  centring.meet = true;
  centring.tips = true;
  centring.keep_junction = 1;
  const auto hosts = hosts_of_vertices(network, setting.surface, setting.balls, setting.graph);
  centring.is_own = [&](int triangle, int strand) {
    const auto corners = setting.surface.triangles.row(triangle);
    return std::any_of(corners.begin(), corners.end(),
                       [&](int vertex) { return hosts[at(vertex)].strand == strand; });
  };
  for (int spaced = 0; spaced < times_spaced; ++spaced) {
    keep_handles(network, setting,
                 [&] { space_by_radius(network, setting.tree, setting.spacing); });
    relax(network, setting.tree, centring, setting.keeper, setting.threads);
  }
}

void space_and_centre(Network& network, const Setting& setting) {
  straighten(network, setting);
  keep_handles(network, setting, [&] { space_evenly(network, setting.tree, setting.spacing); });
  centre(network, setting);
}

/// Whether something changed: all stays as it is where the change makes nothing, or something to
/// which no way inside is found.
template <typename Change>
bool change_and_centre(Network& network, const Setting& setting, const Change& change) {
  Network changed = network;
  if (change(changed) == 0 || stay_inside(changed, setting) > 0) return false;
  network = std::move(changed);
  space_and_centre(network, setting);
  prune_spurs(network, setting.tree, 1);
  return true;
}

void shape_tips(Network& network, const Setting& setting) {
  shape_tips(network, setting.tree, setting.options.tip_reach, setting.options.tip_gap);
  lengthen_short_leaves(network, setting.tree);
}

/// What the surgery has led astray, left out or left short.
void correct(Network& network, const Setting& in) {
  constexpr double least_slenderness = 1;  // that of a half-ball
  const double limit = std::max(least_slenderness, slenderness_limit(in.options.detail));
  const bool rerouted = change_and_centre(network, in, [&in](Network& changed) {
    return take_wider_ways(changed, in.surface, in.balls, in.graph, in.tree);
  });
  if (rerouted) shape_tips(network, in);  // they were shaped as the old ways arrived
  change_and_centre(network, in, [&in, limit](Network& changed) {
    return grow_branches(changed, in.surface, in.tree, in.balls, in.graph, limit);
  });
}

/// Without blunt ends and inside. Where straight lines between the graph's nodes, kept inside as
/// they are, lead a cycle off its handle, cycles go along the surface.
Network first_network(const Setting& setting) {
  const auto& [surface, tree, balls, graph, options, threads, spacing, keeper] = setting;
  const double limit = slenderness_limit(options.detail);
  const Network whole = network_of_graph(graph, positions_from_balls(surface, balls, graph));
  Network network = whole;
  prune_blunt(network, surface, graph, limit);
  HandleKeeper anywhere;  // outside, lines say nothing about handles yet
  const int uncovered = keep_inside(network, surface, balls, graph, tree, anywhere);
  if (!keeper.has_handles()) return network;
  if (uncovered == 0 && goes_round_all_handles(network, graph, surface)) return network;
  network = whole;
  thread_through(network, surface, tree, balls, graph, keeper);
  prune_blunt(network, surface, graph, limit);
  stay_inside(network, setting);
  keeper.pull_taut(network, tree);
  return network;
}

/// Within the coarsened surface, whose tree is quick to ask: all that takes many rays.
Network lay_out(const Setting& setting, const Monitor& monitor) {
  monitor.report("embed", 0);
  const auto& [surface, tree, balls, graph, options, threads, spacing, keeper] = setting;
  Network network = first_network(setting);
  keep_handles(network, setting, [&] { centre_junctions(network, setting.tree); });
  merge_junctions(network, tree, keeper, options.merge);
  monitor.report("embed", 0.2);

  do {
    space_and_centre(network, setting);
    straighten(network, setting);
    shape_tips(network, setting);
    monitor.report("embed", 0.4);
  } while (prune_spurs(network, tree, 1));
  correct(network, setting);
  merge_junctions(network, tree, keeper, options.merge);  // centred, they may have come together
  centre_at_last(network, setting);
  monitor.report("embed", 0.6);
  return network;
}

/// Within the surface that counts: what must hold there, and the last smoothing.
CurveSkeleton settle(Network network, const Setting& setting, const Monitor& monitor) {
  const auto& [surface, tree, balls, graph, options, threads, spacing, keeper] = setting;
  RelaxOptions smoothing;
  smoothing.keep = options.keep_radius;
  smoothing.covered = true;
  smoothing.rounds = options.smooth_rounds;
  do {
    keep_simple(network);
    stay_inside(network, setting);
    keep_handles(network, setting, [&] { thin_out(network, setting.tree, setting.spacing); });
    keep_handles(network, setting, [&] { cut_detours(network, setting.tree); });
    relax(network, tree, smoothing, keeper, threads);
    keep_handles(network, setting, [&] {
      straighten_at_junctions(network, setting.tree, setting.options.straight_at_last, true);
    });
    keep_handles(network, setting, [&] { cut_detours(network, setting.tree); });
    lengthen_short_leaves(network, tree);
  } while (prune_spurs(network, tree, 1));
  monitor.report("embed", 0.9);

  NetworkNodes nodes = nodes_of_network(network, graph.groups);
  CurveSkeleton& skeleton = nodes.skeleton;
  skeleton.node_of_vertex = nearest_nodes(balls, graph, nodes);
  skeleton.radii.resize(skeleton.nodes.rows());
  for (Eigen::Index n = 0; n < skeleton.nodes.rows(); ++n) {
    skeleton.radii[n] = std::max(0.0, tree.inscribed_radius(skeleton.nodes.row(n)));
  }
  monitor.report("embed", 1);
  return std::move(nodes.skeleton);
}

}  // namespace

double slenderness_limit(double detail) {
  constexpr double most = 3;
  constexpr double usual = 1.15;
  return detail < 0.5 ? most - 2 * detail * (most - usual) : 2 * (1 - detail) * usual;
}

CurveSkeleton embed(const Surface& surface, const SurfaceTree& tree,
                    const std::function<const SurfaceTree&()>& finer, const InscribedBalls& balls,
                    const VertexGraph& graph, const EmbedOptions& options, int threads,
                    const Monitor& monitor) {
  const double spacing = most_spacing(surface);
  HandleKeeper keeper(surface);
  Network network =
      lay_out({surface, tree, balls, graph, options, threads, spacing, keeper}, monitor);
  return settle(std::move(network),
                {surface, finer(), balls, graph, options, threads, spacing, keeper}, monitor);
}

}  // namespace curveskel
