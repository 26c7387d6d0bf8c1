#include "skeleton/embed/first_course.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "skeleton/embed/branches/pockets.hpp"
#include "skeleton/embed/branches/prune.hpp"
#include "skeleton/embed/contain/inside.hpp"
#include "skeleton/homology/reroute.hpp"

namespace curveskel {
namespace {

/// Each group at the area-weighted mean of its vertices' ball centres, each cut curve at that of
/// the ends of the edges that it crosses.
std::vector<Point> positions_from_balls(const WorkingSurface& working,
                                        const PartitionGraph& partition) {
  const Eigen::VectorXd& areas = working.vertex_areas();
  std::vector<Point> sum(idx(partition.nodes()), Point::Zero());
  std::vector<double> weight(idx(partition.nodes()), 0);
  const auto add = [&](int node, int vertex) {
    const double w = std::max(areas[vertex], std::numeric_limits<double>::min());
    sum[idx(node)] += w * working.balls().centres.row(vertex).transpose();
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

/// Joins the arcs at each node that is no fork.
void dissolve_passed_nodes(SkeletonGraph& graph) {
  for (int node = 0; node < static_cast<int>(graph.nodes.size()); ++node) {
    if (graph.nodes[idx(node)].alive && graph.degree(node) == 2) graph.dissolve(node);
  }
}

}  // namespace

std::optional<SkeletonGraph> first_course(const Setting& in) {
  const double limit = in.tuning.prominence;
  SkeletonGraph whole =
      skeleton_graph_of(in.partition, positions_from_balls(in.working, in.partition));
  cut_pockets(whole, in.working, in.partition, limit);
  SkeletonGraph graph = whole;
  dissolve_passed_nodes(graph);
  prune_blunt(graph, in.working, in.partition, limit);
  HomologyGuard anywhere;  // outside, lines say nothing about handles yet
  const int uncovered =
      keep_inside(graph, in.working, in.partition, in.tree, anywhere, {.stop = in.stop});
  if (!in.guard.has_handles()) return graph;
  const bool goes_round = in.guard.finds_all_handles(graph, in.partition);
  if (uncovered == 0 && goes_round) return graph;
  SkeletonGraph rerouted = std::move(whole);
  reroute_around_handles(rerouted, in.working, in.tree, in.partition, in.guard);
  if (in.needs_all_handles && !goes_round && !in.guard.finds_all_handles(rerouted, in.partition)) {
    return std::nullopt;
  }
  dissolve_passed_nodes(rerouted);
  prune_blunt(rerouted, in.working, in.partition, limit);
  const int left =
      keep_inside(rerouted, in.working, in.partition, in.tree, in.guard, {.stop = in.stop});
  // No way need be inside if the surface meets itself, and the way round may lose its handle.
  const bool is_better =
      !goes_round || (left < uncovered && in.guard.finds_all_handles(rerouted, in.partition));
  if (!is_better) return graph;
  in.guard.pull_taut(rerouted, in.tree);
  return rerouted;
}

}  // namespace curveskel
