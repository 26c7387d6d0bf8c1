// Undirected graphs as compressed adjacency lists, and shortest paths in them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>

namespace curveskel {

/// Edge lists are vectors of pairs of nodes, or matrices with a row of two nodes for each edge.
template <typename Edges>
[[nodiscard]] std::array<int, 2> edge_ends(const Edges& edges, std::size_t e) {
  if constexpr (requires { edges.rows(); }) {
    const auto row = static_cast<std::ptrdiff_t>(e);
    return {static_cast<int>(edges(row, 0)), static_cast<int>(edges(row, 1))};
  } else {
    const auto& [a, b] = edges[e];
    return {static_cast<int>(a), static_cast<int>(b)};
  }
}

template <typename Edges>
[[nodiscard]] std::size_t edge_count(const Edges& edges) {
  if constexpr (requires { edges.rows(); }) {
    return static_cast<std::size_t>(edges.rows());
  } else {
    return edges.size();
  }
}

/// The number of edges that end at each of 0 .. nodes - 1; a loop counts twice. O(nodes + #E).
template <typename Edges>
[[nodiscard]] std::vector<int> degrees(std::int64_t nodes, const Edges& edges) {
  std::vector<int> degree(idx(nodes), 0);
  for (std::size_t e = 0; e < edge_count(edges); ++e) {
    for (const int node : edge_ends(edges, e)) ++degree[idx(node)];
  }
  return degree;
}

/// Neighbours of each node, in the order of the edges.
struct Graph {
  std::vector<int> first{0};   ///< nodes + 1: where a node's part of the other two begins
  std::vector<int> neighbour;  ///< 2 #E: the node at the other end
  std::vector<int> edge;       ///< 2 #E: the number of the edge to it

  [[nodiscard]] int nodes() const { return static_cast<int>(first.size()) - 1; }
  [[nodiscard]] int degree(int node) const { return first[idx(node) + 1] - first[idx(node)]; }
  [[nodiscard]] std::span<const int> neighbours(int node) const {
    return std::span(neighbour).subspan(idx(first[idx(node)]), idx(degree(node)));
  }
  [[nodiscard]] std::span<const int> edges(int node) const {
    return std::span(edge).subspan(idx(first[idx(node)]), idx(degree(node)));
  }
};

/// Precondition: the edges' ends lie in 0 .. nodes - 1; 2 #E < 2^31. O(nodes + #E).
template <typename Edges>
[[nodiscard]] Graph graph_of(std::int64_t nodes, const Edges& edges) {
  Graph graph;
  graph.first = degrees(nodes, edges);
  int before = 0;
  for (int& first : graph.first) first = std::exchange(before, before + first);
  graph.first.push_back(before);
  graph.neighbour.resize(idx(before));
  graph.edge.resize(idx(before));
  std::vector<int> next(graph.first.begin(), graph.first.end() - 1);
  for (std::size_t e = 0; e < edge_count(edges); ++e) {
    const auto [a, b] = edge_ends(edges, e);
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      const auto place = idx(next[idx(from)]++);
      graph.neighbour[place] = to;
      graph.edge[place] = static_cast<int>(e);
    }
  }
  return graph;
}

/// The connected component of each node, numbered in the order of their lowest nodes.
template <typename Edges>
[[nodiscard]] std::vector<int> connected_components(std::int64_t nodes, const Edges& edges) {
  UnionFind sets(nodes);
  for (std::size_t e = 0; e < edge_count(edges); ++e) {
    const auto [a, b] = edge_ends(edges, e);
    sets.unite(a, b);
  }
  return sets.numbers();
}

/// Shortest paths from one node (E. Dijkstra: A note on two problems in connexion with graphs,
/// 1959). Of nodes equally far the lowest is settled first, of paths equally long the one that was
/// found first stays. A search costs O(k log k) for the k edges that it looks at, so that many
/// short ones in a large graph are cheap.
class ShortestPaths {
 public:
  static constexpr double unreachable = std::numeric_limits<double>::infinity();
  static constexpr int no_target = -1;

  ShortestPaths() = default;
  explicit ShortestPaths(std::int64_t nodes)
      : distance_(idx(nodes), unreachable), before_(idx(nodes), -1) {}

  /// Takes the place of the last search. `length(from, to, edge)` >= 0 is asked when a path reaches
  /// `from`; `unreachable` bars that step. Ends once `target` is settled: what is farther may then
  /// be unreachable or too far. Precondition: the graph has as many nodes as were given before.
  template <typename Length>
  void search(const Graph& graph, int source, int target, const Length& length) {
    forget();
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    reach(source, 0, -1);
    open.emplace(0, source);
    while (!open.empty() && open.top().second != target) {
      const auto [so_far, node] = open.top();
      open.pop();
      if (so_far > distance_[idx(node)]) continue;
      const auto end = idx(graph.first[idx(node) + 1]);
      for (auto i = idx(graph.first[idx(node)]); i < end; ++i) {
        const int next = graph.neighbour[i];
        const double total = so_far + length(node, next, graph.edge[i]);
        if (!(total < distance_[idx(next)])) continue;
        reach(next, total, node);
        open.emplace(total, next);
      }
    }
  }

  [[nodiscard]] double distance(int node) const { return distance_[idx(node)]; }
  /// The last node before this one on the path to it; -1 for the source and what is unreachable.
  [[nodiscard]] int before(int node) const { return before_[idx(node)]; }
  [[nodiscard]] const std::vector<double>& distances() const { return distance_; }

  /// From the source to `node`, both included; empty where it is unreachable.
  [[nodiscard]] std::vector<int> path_to(int node) const {
    std::vector<int> path;
    if (distance(node) == unreachable) return path;
    for (; node >= 0; node = before(node)) path.push_back(node);
    std::reverse(path.begin(), path.end());
    return path;
  }

  /// Makes every node unreachable again.
  void forget() {
    for (const int node : reached_) {
      distance_[idx(node)] = unreachable;
      before_[idx(node)] = -1;
    }
    reached_.clear();
  }

 private:
  using Entry = std::pair<double, int>;

  void reach(int node, double distance, int from) {
    if (distance_[idx(node)] == unreachable) reached_.push_back(node);
    distance_[idx(node)] = distance;
    before_[idx(node)] = from;
  }

  std::vector<double> distance_;
  std::vector<int> before_;
  std::vector<int> reached_;
};

}  // namespace curveskel
