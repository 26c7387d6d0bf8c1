#include "skeleton/prune.hpp"

#include "surface/element_index.hpp"

#include <algorithm>
#include <limits>

namespace curveskel {
namespace {

int base_of(const Network& network, const Strand& strand) {
  return network.degree(strand.from) == 1 ? strand.to : strand.from;
}

/// The graph's nodes along a leaf strand, tip first.
std::vector<int> nodes_from_tip(const Network& network, const Strand& strand) {
  const bool reversed = base_of(network, strand) == strand.from;
  const int tip = reversed ? strand.to : strand.from;
  std::vector<int> nodes = network.hubs[at(tip)].nodes;
  if (reversed) {
    nodes.insert(nodes.end(), strand.nodes.rbegin(), strand.nodes.rend());
  } else {
    nodes.insert(nodes.end(), strand.nodes.begin(), strand.nodes.end());
  }
  return nodes;
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

Regions regions_of(const Surface& surface, const VertexGraph& graph) {
  Regions regions;
  regions.groups = graph.groups;
  regions.vertices.resize(at(graph.groups));
  for (int v = 0; v < static_cast<int>(graph.group_of_vertex.size()); ++v) {
    regions.vertices[at(graph.group_of_vertex[v])].push_back(v);
  }
  for (const auto& circle : graph.circles) {
    Regions::Neck neck{Point::Zero(), 0};
    const auto middle = [&](const std::array<int, 2>& edge) -> Point {
      return 0.5 * (surface.positions.row(edge[0]) + surface.positions.row(edge[1])).transpose();
    };
    for (const auto& edge : circle) neck.centre += middle(edge);
    neck.centre /= static_cast<double>(circle.size());
    for (const auto& edge : circle) neck.radius += (middle(edge) - neck.centre).norm();
    neck.radius /= static_cast<double>(circle.size());
    regions.necks.push_back(neck);
  }
  return regions;
}

double slenderness(const Network& network, int strand, const Surface& surface,
                   const Regions& regions) {
  double best = 0;
  std::vector<int> beyond;
  for (const int node : nodes_from_tip(network, network.strands[at(strand)])) {
    if (node < regions.groups) {
      const auto& vertices = regions.vertices[at(node)];
      beyond.insert(beyond.end(), vertices.begin(), vertices.end());
      continue;
    }
    const Regions::Neck& neck = regions.necks[at(node - regions.groups)];
    double height = 0;
    for (const int v : beyond) {
      const Point offset = surface.positions.row(v).transpose() - neck.centre;
      height = std::max(height, offset.norm());
    }
    if (neck.radius > 0) best = std::max(best, height / neck.radius);
  }
  return best;
}

void prune_blunt(Network& network, const Surface& surface, const Regions& regions, double limit) {
  prune_below(network, limit,
              [&](int strand) { return slenderness(network, strand, surface, regions); });
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
