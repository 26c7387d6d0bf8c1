#include "skeleton/cut/level_set_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>

namespace curveskel {
namespace {

constexpr int most_halvings = 20;
constexpr Eigen::Index most_sliced_vertices = 4000000;  // after subdivision

/// The measure of ways along edges.
enum class EdgeMeasure { length, count };

/// Of the shortest ways along edges.
std::vector<double> edge_distances(const Surface& surface, const EdgeIndex& index, int source,
                                   EdgeMeasure measure) {
  ShortestPaths paths(surface.positions.rows());
  const auto length = [&](int from, int to, int /*edge*/) {
    if (measure == EdgeMeasure::count) return 1.0;
    return (surface.positions.row(from) - surface.positions.row(to)).norm();
  };
  paths.search(graph_of(surface.positions.rows(), index.edges), source, ShortestPaths::no_target,
               length);
  return paths.distances();
}

/// The cell of a vertex: a group, and a slice of its values.
using Cell = std::pair<int, long>;

/// The connected components of the sets of vertices in one cell.
Eigen::VectorXi components_of_cells(const EdgeIndex& index, const std::vector<Cell>& cell) {
  UnionFind joined(static_cast<std::int64_t>(cell.size()));
  for (const auto& [a, b] : index.edges) {
    if (cell[idx(a)] == cell[idx(b)]) joined.unite(a, b);
  }
  Eigen::VectorXi group(static_cast<Eigen::Index>(cell.size()));
  for (Eigen::Index v = 0; v < group.size(); ++v) group[v] = joined.root(static_cast<int>(v));
  return group;
}

/// From -1 to 1, the same for the same number everywhere.
double scattered(std::uint64_t number) {
  number = (number ^ (number >> 30U)) * 0xbf58476d1ce4e5b9U;
  number = (number ^ (number >> 27U)) * 0x94d049bb133111ebU;
  return double((number ^ (number >> 31U)) >> 11U) / 4503599627370496.0 - 1;
}

/// A surface that is cut where a value passes certain levels, the finer ones only where they are
/// needed.
struct Sliced {
  Surface surface;
  EdgeIndex index;
  std::vector<double> value;  ///< of each vertex
  std::vector<int> group;     ///< of each vertex
  double first_width = 0;     ///< between two levels, where they are coarsest
  double width = 0;           ///< where they are finest

  [[nodiscard]] double step(std::size_t edge) const {
    return std::abs(value[idx(index.edges[edge][0])] - value[idx(index.edges[edge][1])]);
  }
  /// Levels lie at half the first width and whole multiples of `width` from there, so that those of
  /// one width are among those of half of it.
  [[nodiscard]] long slice(double at_value) const {
    return std::lround(std::floor((at_value - 0.5 * first_width) / width));
  }
};

/// The triangles that those with a vertex on some of their edges (-1 = none) are cut into.
void append_split(const Sliced& sliced, Eigen::Index t, const std::array<int, 3>& middle,
                  std::vector<std::array<int, 3>>& triangles) {
  const auto corner = sliced.surface.triangles.row(t);
  const auto split = std::count_if(middle.begin(), middle.end(), [](int m) { return m >= 0; });
  if (split == 0) {
    triangles.push_back({corner[0], corner[1], corner[2]});
  } else if (split == 3) {
    triangles.push_back({corner[0], middle[2], middle[1]});
    triangles.push_back({middle[2], corner[1], middle[0]});
    triangles.push_back({middle[1], middle[0], corner[2]});
    triangles.push_back({middle[0], middle[1], middle[2]});
  } else {
    // k is the edge that is alone in being split, or in not being so; a lies opposite to it.
    std::size_t k = 0;
    while ((middle[k] >= 0) != (split == 1)) ++k;
    const int a = corner[static_cast<Eigen::Index>(k)];
    const int b = corner[static_cast<Eigen::Index>((k + 1) % 3)];
    const int c = corner[static_cast<Eigen::Index>((k + 2) % 3)];
    if (split == 1) {
      triangles.push_back({a, b, middle[k]});
      triangles.push_back({a, middle[k], c});
      return;
    }
    const int ca = middle[(k + 1) % 3];
    const int ab = middle[(k + 2) % 3];
    triangles.push_back({a, ab, ca});
    const auto& value = sliced.value;
    if (std::abs(value[idx(b)] - value[idx(ca)]) <= std::abs(value[idx(c)] - value[idx(ab)])) {
      triangles.push_back({ab, b, ca});
      triangles.push_back({b, c, ca});
    } else {
      triangles.push_back({ab, b, c});
      triangles.push_back({ab, c, ca});
    }
  }
}

/// Splits the edges with an end in a `wanted` group along which the value changes by more than
/// `width`, once; whether there were any. The old vertices come first, a new one belongs to the
/// group of the end that is in its slice of `sliced.width`. Edges that are not split are as steep
/// as before, so the vertices grow with the range of the values over `width`, not with its square.
/// New values are off the mean by up to a fifth of `width`: a handle both of whose saddles lie in
/// one vertex never comes apart otherwise.
bool split_steep(Sliced& sliced, const std::vector<bool>& wanted, double width) {
  const Eigen::Index old_vertices = sliced.surface.positions.rows();
  std::vector<int> middle_of(sliced.index.edges.size(), -1);
  std::vector<std::size_t> steep;
  for (std::size_t e = 0; e < middle_of.size(); ++e) {
    const auto& [a, b] = sliced.index.edges[e];
    const bool is_wanted = wanted[idx(sliced.group[idx(a)])] || wanted[idx(sliced.group[idx(b)])];
    if (!is_wanted || sliced.step(e) <= width) continue;
    middle_of[e] = static_cast<int>(old_vertices) + static_cast<int>(steep.size());
    steep.push_back(e);
  }
  if (steep.empty()) return false;
  auto& positions = sliced.surface.positions;
  positions.conservativeResize(old_vertices + static_cast<Eigen::Index>(steep.size()), 3);
  for (std::size_t i = 0; i < steep.size(); ++i) {
    const auto& [a, b] = sliced.index.edges[steep[i]];
    const Eigen::Index m = old_vertices + static_cast<Eigen::Index>(i);
    positions.row(m) = 0.5 * (positions.row(a) + positions.row(b));
    const double value = 0.5 * (sliced.value[idx(a)] + sliced.value[idx(b)]) +
                         0.2 * width * scattered(static_cast<std::uint64_t>(m));
    const bool with_a = sliced.slice(value) == sliced.slice(sliced.value[idx(a)]);
    sliced.value.push_back(value);
    sliced.group.push_back(sliced.group[idx(with_a ? a : b)]);
  }
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(idx(sliced.surface.triangles.rows()) + 2 * steep.size());
  for (Eigen::Index t = 0; t < sliced.surface.triangles.rows(); ++t) {
    const auto edge = sliced.index.edge_of_corner.row(t);
    append_split(sliced, t,
                 {middle_of[idx(edge[0])], middle_of[idx(edge[1])], middle_of[idx(edge[2])]},
                 triangles);
  }
  sliced.surface.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    sliced.surface.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1],
        triangles[t][2];
  }
  sliced.index = index_edges(sliced.surface.triangles);
  return true;
}

/// The groups after those that are wanted were cut along the levels of `sliced.width`.
PartitionGraph cut(const Sliced& sliced, const std::vector<bool>& wanted) {
  std::vector<Cell> cell(sliced.value.size());
  for (std::size_t v = 0; v < cell.size(); ++v) {
    const int group = sliced.group[v];
    cell[v] = {group, wanted[idx(group)] ? sliced.slice(sliced.value[v]) : 0};
  }
  return partition_graph(sliced.surface, components_of_cells(sliced.index, cell));
}

/// One group, at values that grow from 0 at one end to the other.
Sliced uncut(const Surface& surface, EdgeMeasure measure) {
  Sliced result{surface, index_edges(surface.triangles), {}, {}, 0, 0};
  const auto from_any = edge_distances(surface, result.index, 0, measure);
  const auto end = std::max_element(from_any.begin(), from_any.end()) - from_any.begin();
  result.value = edge_distances(surface, result.index, static_cast<int>(end), measure);
  if (measure == EdgeMeasure::count) {  // else no level parts vertices that are as far away
    for (std::size_t v = 0; v < result.value.size(); ++v) result.value[v] += 0.4 * scattered(v);
  }
  result.group.assign(result.value.size(), 0);
  for (std::size_t e = 0; e < result.index.edges.size(); ++e) {
    result.first_width = std::max(result.first_width, result.step(e) * 1.0001);
  }
  result.width = result.first_width;
  return result;
}

}  // namespace

std::vector<int> genus_of_groups(const Surface& surface, const PartitionGraph& graph) {
  std::vector<int> euler(idx(graph.groups), 0);
  std::vector<int> curves(idx(graph.groups), 0);
  const auto& group = graph.group_of_vertex;
  for (Eigen::Index v = 0; v < group.size(); ++v) ++euler[idx(group[v])];
  for (const auto& [a, b] : index_edges(surface.triangles).edges) {
    if (group[a] == group[b]) --euler[idx(group[a])];
  }
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const auto corner = surface.triangles.row(t);
    const int g = group[corner[0]];
    if (g == group[corner[1]] && g == group[corner[2]]) ++euler[idx(g)];
  }
  for (const auto& cut_curve : graph.cut_curves) {
    for (const int end : cut_curve.front()) ++curves[idx(group[end])];
  }
  std::vector<int> genus(idx(graph.groups));
  for (std::size_t g = 0; g < genus.size(); ++g) genus[g] = (2 - euler[g] - curves[g]) / 2;
  return genus;
}

namespace {

/// Nothing if a piece keeps a handle.
std::optional<LevelSetGraph> graph_by(EdgeMeasure measure, const Surface& surface,
                                      const Monitor& monitor) {
  Sliced sliced = uncut(surface, measure);
  std::vector<bool> wanted{true};
  for (int halvings = 0; halvings <= most_halvings; ++halvings) {
    monitor.report("surgery", halvings / (most_halvings + 1.0));
    const double width = std::ldexp(sliced.first_width, -halvings);
    while (sliced.surface.positions.rows() <= most_sliced_vertices &&
           split_steep(sliced, wanted, width)) {
      monitor.report("surgery", halvings / (most_halvings + 1.0));
    }
    if (sliced.surface.positions.rows() > most_sliced_vertices) break;
    sliced.width = width;
    PartitionGraph graph = cut(sliced, wanted);
    const auto genus = genus_of_groups(sliced.surface, graph);
    if (std::all_of(genus.begin(), genus.end(), [](int g) { return g == 0; })) {
      return LevelSetGraph{
          std::move(sliced.surface),
          Eigen::VectorXi::LinSpaced(surface.positions.rows(), 0,
                                     static_cast<int>(surface.positions.rows()) - 1),
          std::move(graph)};
    }
    sliced.group.assign(graph.group_of_vertex.begin(), graph.group_of_vertex.end());
    wanted.assign(idx(graph.groups), false);
    for (std::size_t g = 0; g < genus.size(); ++g) wanted[g] = genus[g] > 0;
  }
  return std::nullopt;
}

}  // namespace

LevelSetGraph level_set_graph(const Surface& surface, const Monitor& monitor) {
  // A handle whose vertices coincide has no length, but edges.
  for (const EdgeMeasure measure : {EdgeMeasure::length, EdgeMeasure::count}) {
    if (auto found = graph_by(measure, surface, monitor)) return std::move(*found);
  }
  throw Error(
      Fault::solver,
      "no partition without handles was found; the surface has handles far smaller than its "
      "edges: raise --resolution, repair the surface or, if it was wrapped, choose a wider "
      "--wrap-gap");
}

}  // namespace curveskel
