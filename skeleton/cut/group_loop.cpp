#include "skeleton/cut/group_loop.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

/// The triangles on both sides of each edge.
std::vector<std::array<int, 2>> sides_of_edges(const EdgeIndex& index) {
  std::vector<std::array<int, 2>> sides(index.edges.size(), {-1, -1});
  for (int t = 0; t < static_cast<int>(index.edge_of_corner.rows()); ++t) {
    for (const int edge : index.edge_of_corner.row(t)) {
      auto& [one, other] = sides[idx(edge)];
      (one < 0 ? one : other) = t;
    }
  }
  return sides;
}

/// The loop that an edge closes: along the paths from the source to its ends, without what they
/// have in common.
std::vector<int> loop_through(const ShortestPaths& paths, const std::array<int, 2>& ends) {
  std::vector<int> there = paths.path_to(ends[0]);
  std::vector<int> back = paths.path_to(ends[1]);
  std::size_t common = 0;
  while (common < std::min(there.size(), back.size()) && there[common] == back[common]) ++common;
  there.erase(there.begin(), there.begin() + static_cast<std::ptrdiff_t>(common) - 1);
  back.erase(back.begin(), back.begin() + static_cast<std::ptrdiff_t>(common));
  there.insert(there.end(), back.rbegin(), back.rend());
  return there;
}

/// Leaves out the vertex between two edges of one triangle, again and again: the third edge will
/// do.
void cut_corners(std::vector<int>& loop, const Surface& surface) {
  std::vector<std::array<int, 3>> triangles;  // corners ascending
  for (const auto& t : surface.triangles.rowwise()) {
    triangles.push_back({t[0], t[1], t[2]});
    std::sort(triangles.back().begin(), triangles.back().end());
  }
  std::sort(triangles.begin(), triangles.end());
  const auto at = [&](std::size_t i) { return loop[i % loop.size()]; };
  for (std::size_t i = 0; i < loop.size();) {
    std::array<int, 3> corners{at(i), at(i + 1), at(i + 2)};
    std::sort(corners.begin(), corners.end());
    if (!std::binary_search(triangles.begin(), triangles.end(), corners)) {
      ++i;
      continue;
    }
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>((i + 1) % loop.size()));
    i = 0;
  }
}

}  // namespace

std::vector<int> loop_of_handle(const Surface& surface, const EdgeIndex& index,
                                const Eigen::VectorXi& group_of_vertex, int group) {
  const auto inner_ends = [&](int edge) {
    const auto& [a, b] = index.edges[idx(edge)];
    return (group_of_vertex[a] == group ? 1 : 0) + (group_of_vertex[b] == group ? 1 : 0);
  };
  std::vector<int> edges;
  std::vector<std::array<int, 2>> ends;
  // All triangles that a cut curve runs through count as one face: the disc that closes the curve.
  const auto sides = sides_of_edges(index);
  UnionFind faces(surface.triangles.rows());
  for (int edge = 0; edge < static_cast<int>(index.edges.size()); ++edge) {
    if (inner_ends(edge) == 1) faces.unite(sides[idx(edge)][0], sides[idx(edge)][1]);
    if (inner_ends(edge) < 2) continue;
    edges.push_back(edge);
    ends.push_back(index.edges[idx(edge)]);
  }
  const auto length = [&](int from, int to, int /*edge*/) {
    return (surface.positions.row(from) - surface.positions.row(to)).norm();
  };
  ShortestPaths paths(surface.positions.rows());
  paths.search(graph_of(surface.positions.rows(), ends), ends.front()[0], ShortestPaths::no_target,
               length);

  std::vector<std::pair<double, std::size_t>> closing;  // the length of the loop, the edge
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const auto& [a, b] = ends[k];
    if (paths.before(a) == b || paths.before(b) == a) continue;
    closing.emplace_back(paths.distance(a) + paths.distance(b) + length(a, b, 0), k);
  }
  std::sort(closing.rbegin(), closing.rend());  // the longest first
  std::size_t shortest = 0;
  for (const auto& [loop_length, k] : closing) {
    const auto& [one, other] = sides[idx(edges[k])];
    if (!faces.unite(one, other)) shortest = k;
  }
  std::vector<int> loop = loop_through(paths, ends[shortest]);
  cut_corners(loop, surface);
  return loop;
}

}  // namespace curveskel
