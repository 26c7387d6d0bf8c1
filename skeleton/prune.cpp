#include "skeleton/prune.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "contraction/laplacian.hpp"
#include "skeleton/slenderness.hpp"
#include "surface/element_index.hpp"

namespace curveskel {
namespace {

int base_of(const Network& network, const Strand& strand) {
  return network.degree(strand.from) == 1 ? strand.to : strand.from;
}

/// The graph's nodes that belong to a leaf strand and its tip.
std::vector<int> nodes_of(const Network& network, const Strand& strand) {
  const int tip = base_of(network, strand) == strand.from ? strand.to : strand.from;
  std::vector<int> nodes = network.hubs[at(tip)].nodes;
  nodes.insert(nodes.end(), strand.nodes.begin(), strand.nodes.end());
  return nodes;
}

/// The vertex of the given groups that lies farthest from p, -1 if they have none; other nodes are
/// circles.
int farthest(const Surface& surface, const Point& p, const std::vector<std::vector<int>>& vertices,
             const std::vector<int>& nodes) {
  int best = -1;
  double most = 0;
  for (const int node : nodes) {
    if (at(node) >= vertices.size()) continue;
    for (const int v : vertices[at(node)]) {
      const double distance = (surface.positions.row(v).transpose() - p).squaredNorm();
      if (distance <= most) continue;
      most = distance;
      best = v;
    }
  }
  return best;
}

/// Prunes the leaf strand with the least measure as long as that is below the limit.
template <typename Measure>
bool prune_below(Network& network, double limit, const Measure& measure) {
  std::vector<double> value(network.strands.size(), -1);
  bool any = false;
  while (network.living_strands() > 1) {
    int worst = -1;
    for (int s = 0; s < static_cast<int>(network.strands.size()); ++s) {
      if (!network.is_leaf(network.strands[at(s)])) continue;
      if (value[at(s)] < 0) value[at(s)] = measure(s);
      if (worst < 0 || value[at(s)] < value[at(worst)]) worst = s;
    }
    if (worst < 0 || value[at(worst)] >= limit) break;
    const int base = base_of(network, network.strands[at(worst)]);
    for (const int s : network.hubs[at(base)].strands) value[at(s)] = -1;
    network.prune(worst);
    any = true;
  }
  return any;
}

}  // namespace

void prune_blunt(Network& network, const Surface& surface, const VertexGraph& graph, double limit) {
  std::vector<std::vector<int>> vertices(at(graph.groups));
  for (int v = 0; v < static_cast<int>(graph.group_of_vertex.size()); ++v) {
    vertices[at(graph.group_of_vertex[v])].push_back(v);
  }
  const Eigen::VectorXd areas = vertex_areas(surface);
  const double all = areas.sum();
  const auto share_of_area = [&](const std::vector<int>& nodes) {
    double sum = 0;
    for (const int node : nodes) {
      if (node < graph.groups) sum += areas(vertices[at(node)]).sum();
    }
    return sum / all;
  };
  std::vector<char> is_own(at(graph.nodes()));
  SlendernessSweep slenderness(surface);
  prune_below(network, limit, [&](int s) {
    const Strand& strand = network.strands[at(s)];
    const Hub& base = network.hubs[at(base_of(network, strand))];
    const auto own = nodes_of(network, strand);
    const int summit = farthest(surface, base.position, vertices, own);
    if (summit < 0) return 0.0;
    for (const std::vector<int>* nodes : {&own, &base.nodes}) {
      for (const int node : *nodes) is_own[at(node)] = 1;
    }
    const double found =
        slenderness(
            base.position, summit, [&](int v) { return is_own[at(graph.group_of_vertex[v])] != 0; },
            limit)
            .slenderness;
    for (const std::vector<int>* nodes : {&own, &base.nodes}) {
      for (const int node : *nodes) is_own[at(node)] = 0;
    }
    // What nowhere sticks out goes before all others; which of two corners of one blunt end goes
    // first must not hang on their order.
    constexpr double below_all = 1e-6;
    return found > 0 ? found : below_all * limit * share_of_area(own);
  });
}

bool prune_spurs(Network& network, const SurfaceTree& tree, double factor) {
  return prune_below(network, factor, [&](int s) {
    const Strand& strand = network.strands[at(s)];
    const Point& junction = network.hubs[at(base_of(network, strand))].position;
    const double radius = std::max(0.0, tree.inscribed_radius(junction));
    return radius > 0 ? network.length(strand) / radius : std::numeric_limits<double>::max();
  });
}

}  // namespace curveskel
