#include "skeleton/cut/level_set_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include "skeleton/cut/group_loop.hpp"
#include "skeleton/cut/sliced_surface.hpp"

namespace curveskel {
namespace {

constexpr int most_halvings = 20;

/// After subdivision. All stages that follow go through them; a loop opens a handle for less.
Eigen::Index most_sliced_vertices(Eigen::Index given) {
  constexpr Eigen::Index for_any = 32000;
  return std::max(for_any, 4 * given);
}

/// Of the shortest ways along edges.
std::vector<double> edge_distances(const Surface& surface, const EdgeIndex& index, int source) {
  ShortestPaths paths(surface.positions.rows());
  const auto length = [&](int from, int to, int /*edge*/) {
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

/// The middles of the edges with an end in a `wanted` group along which the value changes by more
/// than `width`. Each belongs to the group of the end that is in its slice of `sliced.width`. Edges
/// that are not split are as steep as before, so the vertices grow with the range of the values
/// over `width`, not with its square.
std::vector<EdgeMiddle> steep_middles(const Sliced& sliced, const std::vector<bool>& wanted,
                                      double width) {
  std::vector<EdgeMiddle> middles;
  for (std::size_t e = 0; e < sliced.index.edges.size(); ++e) {
    const auto& [a, b] = sliced.index.edges[e];
    const bool is_wanted = wanted[idx(sliced.group[idx(a)])] || wanted[idx(sliced.group[idx(b)])];
    if (!is_wanted || sliced.step(e) <= width) continue;
    const long slice = sliced.slice(sliced.middle_value(e));
    const bool with_a = slice == sliced.slice(sliced.value[idx(a)]);
    middles.push_back({e, sliced.group[idx(with_a ? a : b)]});
  }
  return middles;
}

/// The groups after those that are wanted were cut along the levels of `sliced.width`.
PartitionGraph cut(const Sliced& sliced, const std::vector<bool>& wanted) {
  std::vector<Cell> cell(sliced.value.size());
  for (std::size_t v = 0; v < cell.size(); ++v) {
    const int group = sliced.group[v];
    cell[v] = {group, wanted[idx(group)] ? sliced.slice(sliced.value[v]) : 0};
  }
  return partition_graph(sliced.surface, sliced.index, components_of_cells(sliced.index, cell));
}

/// One group, at values that grow from 0 at one end to the other.
Sliced uncut(const Surface& surface) {
  Sliced result{surface, index_edges(surface.triangles), {}, {}, 0, 0};
  const auto from_any = edge_distances(surface, result.index, 0);
  const auto end = std::max_element(from_any.begin(), from_any.end()) - from_any.begin();
  result.value = edge_distances(surface, result.index, static_cast<int>(end));
  result.group.assign(result.value.size(), 0);
  for (std::size_t e = 0; e < result.index.edges.size(); ++e) {
    result.first_width = std::max(result.first_width, result.step(e) * 1.0001);
  }
  result.width = result.first_width;
  return result;
}

}  // namespace

std::vector<int> genus_of_groups(const Surface& surface, const EdgeIndex& index,
                                 const PartitionGraph& graph) {
  std::vector<int> euler(idx(graph.groups), 0);
  std::vector<int> curves(idx(graph.groups), 0);
  const auto& group = graph.group_of_vertex;
  for (Eigen::Index v = 0; v < group.size(); ++v) ++euler[idx(group[v])];
  for (const auto& [a, b] : index.edges) {
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

/// The groups with a handle that levels may yet open: between its saddles, which are vertices of
/// the input, as values along split edges are linear.
std::vector<bool> worth_cutting(const Sliced& sliced, const PartitionGraph& graph,
                                Eigen::Index input_vertices) {
  const double least_width = std::ldexp(sliced.first_width, -most_halvings);
  const auto genus = genus_of_groups(sliced.surface, sliced.index, graph);
  std::vector<double> lowest(genus.size(), std::numeric_limits<double>::infinity());
  std::vector<double> highest(genus.size(), -std::numeric_limits<double>::infinity());
  for (Eigen::Index v = 0; v < input_vertices; ++v) {
    const auto group = idx(graph.group_of_vertex[v]);
    lowest[group] = std::min(lowest[group], sliced.value[idx(v)]);
    highest[group] = std::max(highest[group], sliced.value[idx(v)]);
  }
  std::vector<bool> wanted(genus.size());
  for (std::size_t g = 0; g < genus.size(); ++g) {
    wanted[g] = genus[g] > 0 && highest[g] - lowest[g] > least_width;
  }
  return wanted;
}

/// Splits until the edges of what is wanted are less steep than the width; false if that would make
/// too many vertices.
bool refine(Sliced& sliced, const std::vector<bool>& wanted, double width, Eigen::Index most) {
  while (true) {
    const std::vector<EdgeMiddle> middles = steep_middles(sliced, wanted, width);
    if (middles.empty()) return true;
    if (sliced.surface.positions.rows() + std::ssize(middles) > most) return false;
    split_edges(sliced, middles);
  }
}

/// Some pieces may keep handles.
PartitionGraph cut_by_levels(Sliced& sliced, const Monitor& monitor) {
  const Eigen::Index input_vertices = sliced.surface.positions.rows();
  std::vector<bool> wanted{sliced.first_width > 0};
  for (int halvings = 0; halvings <= most_halvings; ++halvings) {
    if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) break;
    monitor.report("surgery", halvings / (most_halvings + 1.0));
    const double width = std::ldexp(sliced.first_width, -halvings);
    if (!refine(sliced, wanted, width, most_sliced_vertices(input_vertices))) break;
    sliced.width = width;
    const PartitionGraph graph = cut(sliced, wanted);
    sliced.group.assign(graph.group_of_vertex.begin(), graph.group_of_vertex.end());
    wanted = worth_cutting(sliced, graph, input_vertices);
  }
  return partition_graph(
      sliced.surface, sliced.index,
      Eigen::Map<const Eigen::VectorXi>(sliced.group.data(), std::ssize(sliced.group)));
}

/// Splits the edges at the vertices of the loop, and makes a group of the loop: a ring that the
/// group it was in lies around on either side.
void part_along(Sliced& sliced, const std::vector<int>& loop, int new_group) {
  std::vector<int> after(sliced.value.size(), -1);  // along the loop
  for (std::size_t i = 0; i < loop.size(); ++i) {
    after[idx(loop[i])] = loop[(i + 1) % loop.size()];
  }
  const int group = sliced.group[idx(loop.front())];
  std::vector<EdgeMiddle> middles;
  for (std::size_t e = 0; e < sliced.index.edges.size(); ++e) {
    const auto& [a, b] = sliced.index.edges[e];
    if (after[idx(a)] < 0 && after[idx(b)] < 0) continue;
    const bool is_of_loop = after[idx(a)] == b || after[idx(b)] == a;
    middles.push_back({e, is_of_loop ? new_group : group});
  }
  for (const int v : loop) sliced.group[idx(v)] = new_group;
  split_edges(sliced, middles);
}

}  // namespace

LevelSetGraph level_set_graph(const Surface& surface, const Monitor& monitor) {
  Sliced sliced = uncut(surface);
  PartitionGraph graph = cut_by_levels(sliced, monitor);
  while (true) {
    const auto genus = genus_of_groups(sliced.surface, sliced.index, graph);
    const auto found = std::find_if(genus.begin(), genus.end(), [](int g) { return g > 0; });
    if (found == genus.end()) break;
    monitor.report("surgery", 1);
    const auto group = static_cast<int>(found - genus.begin());
    sliced.group.assign(graph.group_of_vertex.begin(), graph.group_of_vertex.end());
    part_along(sliced, loop_of_handle(sliced.surface, sliced.index, graph.group_of_vertex, group),
               graph.groups);
    graph = cut(sliced, std::vector<bool>(idx(graph.groups) + 1, false));
  }
  return {std::move(sliced.surface),
          Eigen::VectorXi::LinSpaced(surface.positions.rows(), 0,
                                     static_cast<int>(surface.positions.rows()) - 1),
          std::move(graph)};
}

}  // namespace curveskel
