#include "skeleton/io/raw_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace curveskel {
namespace {

/// For each point the first one at the same place.
std::vector<int> representatives(const RawGraph& graph, Joining joining) {
  std::vector<int> first(graph.points.size());
  std::iota(first.begin(), first.end(), 0);
  if (joining == Joining::nothing) return first;
  std::map<std::array<double, 3>, int> seen;
  for (std::size_t p = 0; p < first.size(); ++p) {
    const auto& point = graph.points[p];
    first[p] = seen.try_emplace({point.x(), point.y(), point.z()}, first[p]).first->second;
  }
  return first;
}

/// Node of each point, -1 for those that are dropped.
std::vector<int> number_nodes(const RawGraph& graph, const std::vector<int>& first,
                              Joining joining) {
  std::vector<bool> needed(first.size(), joining == Joining::nothing);
  const auto need = [&](int point) {
    needed[static_cast<std::size_t>(first[static_cast<std::size_t>(point)])] = true;
  };
  for (const auto& [a, b] : graph.edges) {
    need(a);
    need(b);
  }
  for (const int point : graph.alone) need(point);
  std::vector<int> node(first.size(), -1);
  int nodes = 0;
  for (std::size_t p = 0; p < first.size(); ++p) {
    if (needed[p]) node[p] = nodes++;
  }
  for (std::size_t p = 0; p < first.size(); ++p) node[p] = node[static_cast<std::size_t>(first[p])];
  return node;
}

/// The number of each node from those of its points: the first that is known, 0 if none is; empty
/// if no node has one.
Eigen::VectorXd of_nodes(const std::vector<double>& of_points, const std::vector<int>& node,
                         int nodes) {
  Eigen::VectorXd numbers = Eigen::VectorXd::Constant(nodes, RawGraph::unknown);
  for (std::size_t p = node.size(); p-- > 0;) {
    if (node[p] >= 0 && !std::isnan(of_points[p])) numbers(node[p]) = of_points[p];
  }
  if (numbers.array().isNaN().all()) return {};
  return numbers.array().isNaN().select(0, numbers);
}

}  // namespace

void RawGraph::add_chain(const std::vector<int>& chain) {
  if (chain.size() == 1) alone.push_back(chain.front());
  for (std::size_t k = 1; k < chain.size(); ++k) edges.emplace_back(chain[k - 1], chain[k]);
}

CurveSkeleton skeleton_from(const RawGraph& graph, Joining joining) {
  const std::vector<int> node = number_nodes(graph, representatives(graph, joining), joining);
  const int nodes = node.empty() ? 0 : *std::max_element(node.begin(), node.end()) + 1;

  CurveSkeleton skeleton;
  skeleton.nodes.resize(nodes, 3);
  for (std::size_t p = node.size(); p-- > 0;) {  // backwards: the first of coincident points counts
    if (node[p] >= 0) skeleton.nodes.row(node[p]) = graph.points[p];
  }
  skeleton.radii = of_nodes(graph.radii, node, nodes);
  skeleton.lives = of_nodes(graph.lives, node, nodes);

  std::vector<std::pair<int, int>> edges;
  for (const auto& [a, b] : graph.edges) {
    const int i = node[static_cast<std::size_t>(a)];
    const int j = node[static_cast<std::size_t>(b)];
    if (i != j) edges.emplace_back(std::min(i, j), std::max(i, j));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  skeleton.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    skeleton.edges.row(static_cast<Eigen::Index>(e)) << edges[e].first, edges[e].second;
  }
  skeleton.node_of_vertex = graph.node_of_vertex;
  return skeleton;
}

}  // namespace curveskel
