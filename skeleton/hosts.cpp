#include "skeleton/hosts.hpp"

#include <algorithm>
#include <limits>

#include "surface/element_index.hpp"

namespace curveskel {
namespace {

/// Where a vertex looks for its host.
Point seat_of(int v, const Surface& surface, const InscribedBalls& balls) {
  constexpr double touching = 1.2;
  const Point vertex = surface.positions.row(v);
  const Point ball = balls.centres.row(v);
  return (ball - vertex).norm() <= touching * balls.radii[v] ? ball : vertex;
}

std::vector<std::vector<int>> strands_of_groups(const Network& network, int groups) {
  std::vector<std::vector<int>> strands(at(groups));
  const auto claim = [&](const std::vector<int>& nodes, int strand) {
    for (const int node : nodes) {
      if (node < groups) strands[at(node)].push_back(strand);
    }
  };
  for (int s = 0; s < static_cast<int>(network.strands.size()); ++s) {
    const Strand& strand = network.strands[at(s)];
    if (!strand.alive) continue;
    claim(strand.nodes, s);
    claim(network.hubs[at(strand.from)].nodes, s);
    if (strand.to != strand.from) claim(network.hubs[at(strand.to)].nodes, s);
  }
  return strands;
}

}  // namespace

std::vector<Host> hosts_of_vertices(const Network& network, const Surface& surface,
                                    const InscribedBalls& balls, const VertexGraph& graph) {
  const auto strands = strands_of_groups(network, graph.groups);
  std::vector<std::vector<Point>> lines;
  for (const Strand& strand : network.strands) {
    lines.push_back(strand.alive ? network.polyline(strand) : std::vector<Point>{});
  }
  std::vector<Host> hosts(at(surface.positions.rows()));
  for (int v = 0; v < static_cast<int>(hosts.size()); ++v) {
    const Point from = seat_of(v, surface, balls);
    double nearest = std::numeric_limits<double>::infinity();
    for (const int s : strands[at(graph.group_of_vertex[v])]) {
      const auto& line = lines[at(s)];
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Point along = line[i + 1] - line[i];
        const double squared = along.squaredNorm();
        const double share =
            squared > 0 ? std::clamp((from - line[i]).dot(along) / squared, 0.0, 1.0) : 0;
        const Point here = share < 1 ? Point(line[i] + share * along) : line[i + 1];
        const double distance = (here - from).squaredNorm();
        if (distance >= nearest) continue;
        nearest = distance;
        hosts[at(v)] = {s, i, here};
      }
    }
  }
  return hosts;
}

}  // namespace curveskel
