#include "skeleton/homology/homology_rank.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/topology.hpp>
#include "skeleton/homology/homology_classes.hpp"

namespace curveskel {
namespace {

using linking::Crossing;
using linking::SeenLoops;

/// A forest that spans the graph, and the edges it leaves, each of which closes a cycle.
struct Forest {
  std::vector<std::array<int, 3>> steps;  // from a node to the next by an edge, in order
  std::vector<int> left;
};

Forest spanning_forest(const CurveSkeleton& skeleton) {
  const Graph graph = graph_of(skeleton.nodes.rows(), skeleton.edges);
  Forest forest;
  std::vector<char> reached(idx(graph.nodes()), 0);
  std::vector<char> in_forest(idx(skeleton.edges.rows()), 0);
  std::vector<int> stack;
  for (int root = 0; root < graph.nodes(); ++root) {
    if (std::exchange(reached[idx(root)], 1) != 0) continue;
    stack.assign(1, root);
    while (!stack.empty()) {
      const int node = stack.back();
      stack.pop_back();
      for (int i = graph.first[idx(node)]; i < graph.first[idx(node + 1)]; ++i) {
        const int next = graph.neighbour[idx(i)];
        const int edge = graph.edge[idx(i)];
        if (std::exchange(reached[idx(next)], 1) != 0) continue;
        in_forest[idx(edge)] = 1;
        forest.steps.push_back({node, next, edge});
        stack.push_back(next);
      }
    }
  }
  for (int e = 0; e < static_cast<int>(in_forest.size()); ++e) {
    if (in_forest[idx(e)] == 0) forest.left.push_back(e);
  }
  return forest;
}

/// The components of a skeleton that have cycles.
std::vector<CurveSkeleton> with_cycles(const CurveSkeleton& skeleton) {
  const Forest forest = spanning_forest(skeleton);
  std::vector<int> component(idx(skeleton.nodes.rows()), -1);  // by the lowest node
  std::iota(component.begin(), component.end(), 0);
  for (const auto& [node, next, edge] : forest.steps) component[idx(next)] = component[idx(node)];
  std::vector<int> number(component.size(), -1);
  int count = 0;
  for (const int e : forest.left) {
    int& n = number[idx(component[idx(skeleton.edges(e, 0))])];
    if (n < 0) n = count++;
  }
  std::vector<CurveSkeleton> parts(idx(count));
  std::vector<int> row(component.size(), -1);
  std::vector<int> rows(idx(count), 0);
  for (std::size_t node = 0; node < component.size(); ++node) {
    const int n = number[idx(component[node])];
    if (n >= 0) row[node] = rows[idx(n)]++;
  }
  for (std::size_t n = 0; n < parts.size(); ++n) parts[n].nodes.resize(rows[n], 3);
  std::vector<std::vector<std::array<int, 2>>> edges(idx(count));
  for (const auto& edge : skeleton.edges.rowwise()) {
    const int n = number[idx(component[idx(edge(0))])];
    if (n >= 0) edges[idx(n)].push_back({row[idx(edge(0))], row[idx(edge(1))]});
  }
  for (std::size_t node = 0; node < component.size(); ++node) {
    if (row[node] < 0) continue;
    parts[idx(number[idx(component[node])])].nodes.row(row[node]) =
        skeleton.nodes.row(static_cast<Eigen::Index>(node));
  }
  for (std::size_t n = 0; n < parts.size(); ++n) {
    parts[n].edges.resize(static_cast<Eigen::Index>(edges[n].size()), 2);
    for (std::size_t e = 0; e < edges[n].size(); ++e) {
      parts[n].edges.row(static_cast<Eigen::Index>(e)) << edges[n][e][0], edges[n][e][1];
    }
  }
  return parts;
}

/// Gives each surface the skeleton that goes round its handles, none to two of them.
class Matching {
 public:
  /// ranks[s]: (skeleton, rank) of those that go round any of surface s.
  explicit Matching(const std::vector<std::vector<std::array<int, 2>>>& ranks,
                    std::size_t skeletons)
      : ranks_(ranks), surface_of_(skeletons, -1), skeleton_of_(ranks.size(), -1) {}

  [[nodiscard]] int total(const std::vector<int>& genus) {
    for (std::size_t s = 0; s < ranks_.size(); ++s) {
      asked_.assign(surface_of_.size(), 0);
      give(static_cast<int>(s), genus);
    }
    int sum = 0;
    for (std::size_t s = 0; s < ranks_.size(); ++s) {
      int most = skeleton_of_[s] >= 0 ? genus[s] : 0;
      for (const auto& [skeleton, rank] : ranks_[s]) {
        if (skeleton_of_[s] < 0 && surface_of_[idx(skeleton)] < 0) most = std::max(most, rank);
      }
      sum += most;
    }
    return sum;
  }

 private:
  /// One that goes round all, taken from another surface if that finds a different one.
  bool give(int surface, const std::vector<int>& genus) {
    for (const auto& [skeleton, rank] : ranks_[idx(surface)]) {
      if (rank < genus[idx(surface)] || std::exchange(asked_[idx(skeleton)], 1) != 0) continue;
      int& owner = surface_of_[idx(skeleton)];
      if (owner >= 0 && !give(owner, genus)) continue;
      owner = surface;
      skeleton_of_[idx(surface)] = skeleton;
      return true;
    }
    return false;
  }

  const std::vector<std::vector<std::array<int, 2>>>& ranks_;
  std::vector<int> surface_of_;   // per skeleton
  std::vector<int> skeleton_of_;  // per surface
  std::vector<char> asked_;       // per skeleton
};

}  // namespace

int homology_rank(SeenLoops& loops, const CurveSkeleton& skeleton) {
  const Forest forest = spanning_forest(skeleton);
  if (forest.left.empty() || loops.edges.size() == 0) return 0;
  const auto nodes = loops.projection(skeleton.nodes);
  std::vector<Crossing> crossings;
  for (int e = 0; e < static_cast<int>(skeleton.edges.rows()); ++e) {
    const linking::Segment edge{nodes[idx(skeleton.edges(e, 0))], nodes[idx(skeleton.edges(e, 1))]};
    loops.edges.crossed_by(edge, [&](int under) { crossings.push_back({e, under}); });
  }
  std::vector<BitRow> linking(forest.left.size());
  linking::for_words(
      loops.handles, crossings, idx(skeleton.edges.rows()), [&](const BitRow& of_edge) {
        BitRow of_way(idx(skeleton.nodes.rows()), 0);  // from the root of the tree to each node
        for (const auto& [node, next, edge] : forest.steps) {
          of_way[idx(next)] = of_way[idx(node)] ^ of_edge[idx(edge)];
        }
        for (std::size_t cycle = 0; cycle < linking.size(); ++cycle) {
          const int e = forest.left[cycle];
          linking[cycle].push_back(of_edge[idx(e)] ^ of_way[idx(skeleton.edges(e, 0))] ^
                                   of_way[idx(skeleton.edges(e, 1))]);
        }
      });
  IndependentRows independent;
  for (BitRow& row : linking) independent.add(std::move(row));
  return independent.size();
}

int homology_rank(const Surface& surface, const CurveSkeleton& skeleton) {
  const Topology counted = topology(surface);
  if (counted.components() == 1) {
    SeenLoops loops(surface);
    return homology_rank(loops, skeleton);
  }
  const auto parts = with_cycles(skeleton);
  std::vector<Eigen::Matrix<double, 2, 3>> boxes(parts.size());
  for (std::size_t n = 0; n < parts.size(); ++n) {
    boxes[n] << parts[n].nodes.colwise().minCoeff(), parts[n].nodes.colwise().maxCoeff();
  }
  std::vector<std::vector<std::array<int, 2>>> ranks;
  std::vector<int> genus;
  const auto components = split_components(surface, counted);
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (counted.genus[c] == 0) continue;
    const Surface& component = components[c].surface;
    const Eigen::RowVector3d low = component.positions.colwise().minCoeff();
    const Eigen::RowVector3d high = component.positions.colwise().maxCoeff();
    SeenLoops loops(component);
    genus.push_back(counted.genus[c]);
    ranks.emplace_back();
    for (std::size_t n = 0; n < parts.size(); ++n) {
      if ((boxes[n].row(0).array() > high.array()).any()) continue;
      if ((boxes[n].row(1).array() < low.array()).any()) continue;
      const int rank = homology_rank(loops, parts[n]);
      if (rank > 0) ranks.back().push_back({static_cast<int>(n), std::min(rank, genus.back())});
    }
  }
  return Matching(ranks, parts.size()).total(genus);
}

}  // namespace curveskel
