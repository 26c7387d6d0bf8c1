#include "skeleton/embed/arc_projection.hpp"

#include <algorithm>
#include <limits>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"

namespace curveskel {
namespace {

/// The place from which a vertex looks for its nearest arc.
Point starting_place(int v, const WorkingSurface& working) {
  constexpr double touching = 1.2;
  const Point vertex = working.place(v);
  const Point ball = working.balls().centres.row(v);
  return (ball - vertex).norm() <= touching * working.balls().radii[v] ? ball : vertex;
}

std::vector<std::vector<int>> arcs_of_groups(const SkeletonGraph& graph, int groups) {
  std::vector<std::vector<int>> arcs(idx(groups));
  const auto claim = [&](const std::vector<int>& nodes, int arc) {
    for (const int node : nodes) {
      if (node < groups) arcs[idx(node)].push_back(arc);
    }
  };
  for (int s = 0; s < static_cast<int>(graph.arcs.size()); ++s) {
    const Arc& arc = graph.arcs[idx(s)];
    if (!arc.alive) continue;
    claim(arc.pieces, s);
    claim(graph.nodes[idx(arc.from)].pieces, s);
    if (arc.to != arc.from) claim(graph.nodes[idx(arc.to)].pieces, s);
  }
  return arcs;
}

}  // namespace

std::vector<ArcProjection> project_on_arcs(const SkeletonGraph& graph,
                                           const WorkingSurface& working,
                                           const PartitionGraph& partition, int threads) {
  const auto arcs = arcs_of_groups(graph, partition.groups);
  std::vector<std::vector<Point>> lines;
  for (const Arc& arc : graph.arcs) {
    lines.push_back(arc.alive ? graph.polyline(arc) : std::vector<Point>{});
  }
  std::vector<ArcProjection> projections(idx(working.vertices()));
  const auto project = [&](int v) {
    const Point from = starting_place(v, working);
    double nearest = std::numeric_limits<double>::infinity();
    for (const int s : arcs[idx(partition.group_of_vertex[v])]) {
      const auto& line = lines[idx(s)];
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Point along = line[i + 1] - line[i];
        const double squared = along.squaredNorm();
        const double share =
            squared > 0 ? std::clamp((from - line[i]).dot(along) / squared, 0.0, 1.0) : 0;
        const Point here = share < 1 ? Point(line[i] + share * along) : line[i + 1];
        const double distance = (here - from).squaredNorm();
        if (distance >= nearest) continue;
        nearest = distance;
        projections[idx(v)] = {s, i, here};
      }
    }
  };
  constexpr std::size_t grain = 512;
  parallel_for(projections.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) project(static_cast<int>(v));
  });
  return projections;
}

std::vector<int> groups_on(const std::vector<int>& arcs,
                           const std::vector<ArcProjection>& projections,
                           const PartitionGraph& partition) {
  std::vector<int> groups;
  groups.reserve(projections.size());
  for (std::size_t v = 0; v < projections.size(); ++v) {
    if (std::find(arcs.begin(), arcs.end(), projections[v].arc) == arcs.end()) continue;
    groups.push_back(partition.group_of_vertex[static_cast<Eigen::Index>(v)]);
  }
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  return groups;
}

}  // namespace curveskel
