#include "skeleton/embed/branches/prune.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "skeleton/embed/branches/prominence.hpp"

namespace curveskel {
namespace {

int base_of(const SkeletonGraph& graph, const Arc& arc) {
  return graph.degree(arc.from) == 1 ? arc.to : arc.from;
}

/// The partition's nodes that belong to a leaf arc and its tip.
std::vector<int> nodes_of(const SkeletonGraph& graph, const Arc& arc) {
  const int tip = base_of(graph, arc) == arc.from ? arc.to : arc.from;
  std::vector<int> nodes = graph.nodes[idx(tip)].pieces;
  nodes.insert(nodes.end(), arc.pieces.begin(), arc.pieces.end());
  return nodes;
}

/// The vertex of the given groups that lies farthest from p, -1 if they have none; other nodes are
/// cut curves.
int farthest(const Surface& surface, const Point& p, const std::vector<std::vector<int>>& vertices,
             const std::vector<int>& nodes) {
  int best = -1;
  double most = 0;
  for (const int node : nodes) {
    if (idx(node) >= vertices.size()) continue;
    for (const int v : vertices[idx(node)]) {
      const double distance = (surface.positions.row(v).transpose() - p).squaredNorm();
      if (distance <= most) continue;
      most = distance;
      best = v;
    }
  }
  return best;
}

/// Prunes the leaf arc with the least measure as long as that is below the limit.
template <typename Measure>
bool prune_below(SkeletonGraph& graph, double limit, const Measure& measure) {
  std::vector<double> value(graph.arcs.size(), -1);
  bool any = false;
  while (graph.living_arcs() > 1) {
    int worst = -1;
    for (int s = 0; s < static_cast<int>(graph.arcs.size()); ++s) {
      if (!graph.is_leaf(graph.arcs[idx(s)])) continue;
      if (value[idx(s)] < 0) value[idx(s)] = measure(s);
      if (worst < 0 || value[idx(s)] < value[idx(worst)]) worst = s;
    }
    if (worst < 0 || value[idx(worst)] >= limit) break;
    const int base = base_of(graph, graph.arcs[idx(worst)]);
    for (const int s : graph.nodes[idx(base)].arcs) value[idx(s)] = -1;
    graph.prune(worst);
    any = true;
  }
  return any;
}

}  // namespace

void prune_blunt(SkeletonGraph& graph, const WorkingSurface& working,
                 const PartitionGraph& partition, double limit) {
  std::vector<std::vector<int>> vertices(idx(partition.groups));
  for (int v = 0; v < static_cast<int>(partition.group_of_vertex.size()); ++v) {
    vertices[idx(partition.group_of_vertex[v])].push_back(v);
  }
  const Eigen::VectorXd& areas = working.vertex_areas();
  const double all = areas.sum();
  const auto share_of_area = [&](const std::vector<int>& nodes) {
    double sum = 0;
    for (const int node : nodes) {
      if (node < partition.groups) sum += areas(vertices[idx(node)]).sum();
    }
    return sum / all;
  };
  std::vector<char> is_own(idx(partition.nodes()));
  ProminenceSweep prominence(working);
  prune_below(graph, limit, [&](int s) {
    const Arc& arc = graph.arcs[idx(s)];
    const Node& base = graph.nodes[idx(base_of(graph, arc))];
    const auto own = nodes_of(graph, arc);
    const int apex = farthest(working.surface(), base.point.place(), vertices, own);
    if (apex < 0) return 0.0;
    for (const std::vector<int>* nodes : {&own, &base.pieces}) {
      for (const int node : *nodes) is_own[idx(node)] = 1;
    }
    const double found =
        prominence(
            base.point.place(), apex,
            [&](int v) { return is_own[idx(partition.group_of_vertex[v])] != 0; }, limit)
            .prominence;
    for (const std::vector<int>* nodes : {&own, &base.pieces}) {
      for (const int node : *nodes) is_own[idx(node)] = 0;
    }
    // Leaves that stick out nowhere go before all others. Which of two corners of a blunt end goes
    // first must not depend on their order.
    constexpr double below_all = 1e-6;
    return found > 0 ? found : below_all * limit * share_of_area(own);
  });
}

bool prune_spurs(SkeletonGraph& graph, const SurfaceTree& tree, double factor) {
  return prune_below(graph, factor, [&](int s) {
    const Arc& arc = graph.arcs[idx(s)];
    const CurvePoint& junction = graph.nodes[idx(base_of(graph, arc))].point;
    const double radius = std::max(0.0, junction.radius(tree));
    return radius > 0 ? graph.length(arc) / radius : std::numeric_limits<double>::max();
  });
}

}  // namespace curveskel
