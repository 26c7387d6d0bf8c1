#include "skeleton/bands.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "surface/element_index.hpp"
#include "surface/error.hpp"

namespace curveskel {
namespace {

constexpr int most_subdivisions = 6;
constexpr Eigen::Index most_band_vertices = 4000000;  // after subdivision

/// Shortest distances along edges (Dijkstra); ties by vertex.
std::vector<double> edge_distances(const Surface& surface, const EdgeIndex& index, int source) {
  const auto vertices = at(surface.positions.rows());
  std::vector<std::vector<std::pair<int, double>>> neighbours(vertices);
  for (const auto& [a, b] : index.edges) {
    const double length = (surface.positions.row(a) - surface.positions.row(b)).norm();
    neighbours[at(a)].emplace_back(b, length);
    neighbours[at(b)].emplace_back(a, length);
  }
  std::vector<double> distance(vertices, std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  distance[at(source)] = 0;
  queue.emplace(0, source);
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > distance[at(v)]) continue;
    for (const auto& [next, length] : neighbours[at(v)]) {
      if (d + length >= distance[at(next)]) continue;
      distance[at(next)] = d + length;
      queue.emplace(d + length, next);
    }
  }
  return distance;
}

/// The connected components of the sets of vertices with equal band.
Eigen::VectorXi components_of_bands(const EdgeIndex& index, const std::vector<long>& band) {
  std::vector<int> parent(band.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[at(v)] != v) {
      parent[at(v)] = parent[at(parent[at(v)])];
      v = parent[at(v)];
    }
    return v;
  };
  for (const auto& [a, b] : index.edges) {
    if (band[at(a)] != band[at(b)]) continue;
    const int p = root(a);
    const int q = root(b);
    parent[at(std::max(p, q))] = std::min(p, q);
  }
  Eigen::VectorXi group(static_cast<Eigen::Index>(band.size()));
  for (Eigen::Index v = 0; v < group.size(); ++v) group[v] = root(static_cast<int>(v));
  return group;
}

/// 1:4 at the edges' midpoints; the old vertices come first. `value` is interpolated along.
void subdivide(Surface& surface, const EdgeIndex& index, std::vector<double>& value) {
  const Eigen::Index old_vertices = surface.positions.rows();
  const auto new_vertices = static_cast<Eigen::Index>(index.edges.size());
  surface.positions.conservativeResize(old_vertices + new_vertices, 3);
  for (Eigen::Index e = 0; e < new_vertices; ++e) {
    const auto& [a, b] = index.edges[at(e)];
    surface.positions.row(old_vertices + e) =
        0.5 * (surface.positions.row(a) + surface.positions.row(b));
    value.push_back(0.5 * (value[at(a)] + value[at(b)]));
  }
  Triangles finer(4 * surface.triangles.rows(), 3);
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const auto corner = surface.triangles.row(t);
    const auto middle =
        (index.edge_of_corner.row(t).array() + static_cast<int>(old_vertices)).eval();
    finer.row(4 * t) << corner[0], middle[2], middle[1];
    finer.row(4 * t + 1) << middle[2], corner[1], middle[0];
    finer.row(4 * t + 2) << middle[1], middle[0], corner[2];
    finer.row(4 * t + 3) << middle[0], middle[1], middle[2];
  }
  surface.triangles = std::move(finer);
}

}  // namespace

std::vector<int> genus_of_groups(const Surface& surface, const VertexGraph& graph) {
  std::vector<int> euler(at(graph.groups), 0);
  std::vector<int> circles(at(graph.groups), 0);
  const auto& group = graph.group_of_vertex;
  for (Eigen::Index v = 0; v < group.size(); ++v) ++euler[at(group[v])];
  for (const auto& [a, b] : index_edges(surface.triangles).edges) {
    if (group[a] == group[b]) --euler[at(group[a])];
  }
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const auto corner = surface.triangles.row(t);
    const int g = group[corner[0]];
    if (g == group[corner[1]] && g == group[corner[2]]) ++euler[at(g)];
  }
  for (const auto& circle : graph.circles) {
    for (const int end : circle.front()) ++circles[at(group[end])];
  }
  std::vector<int> genus(at(graph.groups));
  for (std::size_t g = 0; g < genus.size(); ++g) genus[g] = (2 - euler[g] - circles[g]) / 2;
  return genus;
}

BandGraph band_graph(const Surface& surface, const Monitor& monitor) {
  BandGraph result;
  result.surface = surface;
  result.vertex_of_input = Eigen::VectorXi::LinSpaced(
      surface.positions.rows(), 0, static_cast<int>(surface.positions.rows()) - 1);
  EdgeIndex index = index_edges(surface.triangles);
  const auto farthest = [](const std::vector<double>& distance) {
    return static_cast<int>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  };
  auto value = edge_distances(surface, index, farthest(edge_distances(surface, index, 0)));

  int level = 0;
  for (; level <= most_subdivisions; ++level) {
    monitor.report("surgery", level / (most_subdivisions + 1.0));
    double steepest = 0;
    for (const auto& [a, b] : index.edges) {
      steepest = std::max(steepest, std::abs(value[at(a)] - value[at(b)]));
    }
    const double width = steepest * 1.0001;
    std::vector<long> band(value.size());
    for (std::size_t v = 0; v < value.size(); ++v) band[v] = std::lround(value[v] / width);
    result.graph = graph_of_groups(result.surface, components_of_bands(index, band));
    const auto genus = genus_of_groups(result.surface, result.graph);
    if (std::all_of(genus.begin(), genus.end(), [](int g) { return g == 0; })) return result;
    if (4 * result.surface.positions.rows() > most_band_vertices) break;
    subdivide(result.surface, index, value);
    index = index_edges(result.surface.triangles);
  }
  throw Error(Fault::solver,
              "no partition without handles was found after " + std::to_string(level) +
                  " subdivisions; the surface has handles far smaller than its edges: raise "
                  "--resolution or repair the surface");
}

}  // namespace curveskel
