#include <curveskel/curve_skeleton.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "skeleton/graph/sound_skeleton.hpp"

namespace curveskel {

std::vector<Branch> branches(const CurveSkeleton& skeleton) {
  require_sound(skeleton, "branches");
  // Rows are sorted with i < j, so the neighbours of a node are ascending.
  const Graph graph = graph_of(skeleton.nodes.rows(), skeleton.edges);
  std::vector<bool> taken(static_cast<std::size_t>(skeleton.edges.rows()), false);
  std::vector<Branch> result;

  const auto walk_from = [&](int start) {
    for (int k = graph.first[idx(start)]; k < graph.first[idx(start + 1)]; ++k) {
      auto step = idx(k);
      if (taken[idx(graph.edge[step])]) continue;
      Branch branch{{start}};
      while (true) {
        const int edge = graph.edge[step];
        const int node = graph.neighbour[step];
        taken[idx(edge)] = true;
        branch.nodes.push_back(node);
        if (node == start || graph.degree(node) != 2) break;
        step = idx(graph.first[idx(node)]);
        if (graph.edge[step] == edge) ++step;
      }
      result.push_back(std::move(branch));
    }
  };
  for (int node = 0; node < graph.nodes(); ++node) {
    if (graph.degree(node) != 2) walk_from(node);
  }
  for (int node = 0; node < graph.nodes(); ++node)
    walk_from(node);  // cycles without a junction are left

  std::sort(result.begin(), result.end(), [](const Branch& a, const Branch& b) {
    return std::lexicographical_compare(a.nodes.begin(), a.nodes.begin() + 2, b.nodes.begin(),
                                        b.nodes.begin() + 2);
  });
  return result;
}

std::vector<int> branch_of_edges(const CurveSkeleton& skeleton) {
  std::vector<int> branch_of_edge(idx(skeleton.edges.rows()), -1);
  const std::vector<Branch> all = branches(skeleton);
  for (std::size_t b = 0; b < all.size(); ++b) {
    const std::vector<int>& nodes = all[b].nodes;
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      const int edge = require_edge(skeleton, nodes[k - 1], nodes[k], "branch_of_edges");
      branch_of_edge[idx(edge)] = static_cast<int>(b);
    }
  }
  if (std::find(branch_of_edge.begin(), branch_of_edge.end(), -1) != branch_of_edge.end()) {
    throw Error(Fault::input, "branch_of_edges: found an edge twice, needed each row once");
  }
  return branch_of_edge;
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
  require_sound(skeleton, "component_of_node");
  return connected_components(skeleton.nodes.rows(), skeleton.edges);
}

GraphTopology graph_topology(const CurveSkeleton& skeleton) {
  require_sound(skeleton, "graph_topology");
  GraphTopology topology;
  const std::vector<int> component = component_of_node(skeleton);
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
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
