#include <curveskel/curve_skeleton.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

namespace curveskel {
namespace {

/// The neighbours of every node, ascending: those of i are neighbour[first[i]] .. [first[i+1] - 1];
/// edge[k] is the row of `edges` behind neighbour[k].
struct Adjacency {
  std::vector<int> first;
  std::vector<int> neighbour;
  std::vector<int> edge;
  [[nodiscard]] int degree(int node) const {
    return first[static_cast<std::size_t>(node) + 1] - first[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] int begin(int node) const { return first[static_cast<std::size_t>(node)]; }
  [[nodiscard]] int end(int node) const { return first[static_cast<std::size_t>(node) + 1]; }
};

Adjacency adjacency_of(const CurveSkeleton& skeleton) {
  const auto nodes = static_cast<std::size_t>(skeleton.nodes.rows());
  const auto edges = static_cast<std::size_t>(skeleton.edges.rows());
  Adjacency adjacency{std::vector<int>(nodes + 1, 0), std::vector<int>(2 * edges),
                      std::vector<int>(2 * edges)};
  for (const std::int32_t node : skeleton.edges.reshaped()) {
    ++adjacency.first[static_cast<std::size_t>(node) + 1];
  }
  std::partial_sum(adjacency.first.begin(), adjacency.first.end(), adjacency.first.begin());
  std::vector<int> next(adjacency.first.begin(), adjacency.first.end() - 1);
  const auto append = [&](int from, int to, int edge) {
    const auto place = static_cast<std::size_t>(next[static_cast<std::size_t>(from)]++);
    adjacency.neighbour[place] = to;
    adjacency.edge[place] = edge;
  };
  // Rows are sorted with i < j: the smaller neighbours of a node come first, each group ascending.
  for (int e = 0; e < skeleton.edges.rows(); ++e) {
    append(skeleton.edges(e, 1), skeleton.edges(e, 0), e);
  }
  for (int e = 0; e < skeleton.edges.rows(); ++e) {
    append(skeleton.edges(e, 0), skeleton.edges(e, 1), e);
  }
  return adjacency;
}

int find_root(std::vector<int>& parent, int node) {
  while (parent[static_cast<std::size_t>(node)] != node) {
    auto& above = parent[static_cast<std::size_t>(node)];
    above = parent[static_cast<std::size_t>(above)];
    node = above;
  }
  return node;
}

}  // namespace

std::vector<Branch> branches(const CurveSkeleton& skeleton) {
  const Adjacency adjacency = adjacency_of(skeleton);
  const auto nodes = static_cast<int>(skeleton.nodes.rows());
  std::vector<bool> taken(static_cast<std::size_t>(skeleton.edges.rows()), false);
  std::vector<Branch> result;

  const auto walk_from = [&](int start) {
    for (int k = adjacency.begin(start); k < adjacency.end(start); ++k) {
      auto step = static_cast<std::size_t>(k);
      if (taken[static_cast<std::size_t>(adjacency.edge[step])]) continue;
      Branch branch{{start}};
      while (true) {
        const int edge = adjacency.edge[step];
        const int node = adjacency.neighbour[step];
        taken[static_cast<std::size_t>(edge)] = true;
        branch.nodes.push_back(node);
        if (node == start || adjacency.degree(node) != 2) break;
        step = static_cast<std::size_t>(adjacency.begin(node));
        if (adjacency.edge[step] == edge) ++step;
      }
      result.push_back(std::move(branch));
    }
  };
  for (int node = 0; node < nodes; ++node) {
    if (adjacency.degree(node) != 2) walk_from(node);
  }
  for (int node = 0; node < nodes; ++node) walk_from(node);  // cycles without a junction are left

  std::sort(result.begin(), result.end(), [](const Branch& a, const Branch& b) {
    return std::lexicographical_compare(a.nodes.begin(), a.nodes.begin() + 2, b.nodes.begin(),
                                        b.nodes.begin() + 2);
  });
  return result;
}

int edge_between(const CurveSkeleton& skeleton, int a, int b) {
  const std::array wanted{std::min(a, b), std::max(a, b)};
  int first = 0;
  int count = static_cast<int>(skeleton.edges.rows());
  while (count > 0) {
    const int half = count / 2;
    const std::array middle{skeleton.edges(first + half, 0), skeleton.edges(first + half, 1)};
    if (middle == wanted) return first + half;
    if (middle < wanted) first += half + 1;
    count = middle < wanted ? count - half - 1 : half;
  }
  return -1;
}

std::vector<int> component_of_node(const CurveSkeleton& skeleton) {
  std::vector<int> component(static_cast<std::size_t>(skeleton.nodes.rows()));
  std::iota(component.begin(), component.end(), 0);  // a parent, the lower node, until the end
  for (const auto& edge : skeleton.edges.rowwise()) {
    const int a = find_root(component, edge(0));
    const int b = find_root(component, edge(1));
    component[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  int components = 0;
  for (std::size_t node = 0; node < component.size(); ++node) {
    const auto parent = static_cast<std::size_t>(component[node]);
    component[node] = parent == node ? components++ : component[parent];
  }
  return component;
}

GraphTopology graph_topology(const CurveSkeleton& skeleton) {
  GraphTopology topology;
  const std::vector<int> component = component_of_node(skeleton);
  std::vector<int> degree(component.size(), 0);
  for (const std::int32_t node : skeleton.edges.reshaped())
    ++degree[static_cast<std::size_t>(node)];
  if (!component.empty()) {
    topology.components = *std::max_element(component.begin(), component.end()) + 1;
  }
  topology.cycle_rank =
      static_cast<int>(skeleton.edges.rows() - skeleton.nodes.rows()) + topology.components;
  topology.tips = static_cast<int>(std::count(degree.begin(), degree.end(), 1));
  topology.junctions =
      static_cast<int>(std::count_if(degree.begin(), degree.end(), [](int d) { return d >= 3; }));
  return topology;
}

}  // namespace curveskel
