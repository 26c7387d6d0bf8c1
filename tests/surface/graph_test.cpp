#include <curveskel/advanced/graph.hpp>

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <vector>

namespace curveskel {
namespace graph_laws {
namespace {

using EdgeList = std::vector<std::array<int, 2>>;

EdgeList random_edges(int nodes, int wanted, unsigned seed) {
  std::mt19937 random(seed);
  std::set<std::array<int, 2>> edges;
  for (int e = 0; e < wanted; ++e) {
    const int a = static_cast<int>(random() % unsigned(nodes));
    const int b = static_cast<int>(random() % unsigned(nodes));
    if (a != b) edges.insert({std::min(a, b), std::max(a, b)});
  }
  return {edges.begin(), edges.end()};
}

/// Whole numbers, so that many paths are equally long.
std::vector<double> random_lengths(std::size_t edges, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> lengths(edges);
  for (double& length : lengths) length = static_cast<double>(random() % 4);
  return lengths;
}

/// Bellman and Ford's way: lengths are lowered until none can be.
std::vector<double> distances_by_relaxing(int nodes, const EdgeList& edges,
                                          const std::vector<double>& lengths, int source) {
  std::vector<double> distance(idx(nodes), ShortestPaths::unreachable);
  distance[idx(source)] = 0;
  for (int round = 0; round < nodes; ++round) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      double& a = distance[idx(edges[e][0])];
      double& b = distance[idx(edges[e][1])];
      a = std::min(a, b + lengths[e]);
      b = std::min(b, a + lengths[e]);
    }
  }
  return distance;
}

TEST(Graph, HoldsEachEdgeAtBothItsEndsInTheOrderOfTheEdges) {
  const EdgeList edges{{2, 0}, {0, 1}, {3, 2}};
  const Graph graph = graph_of(5, edges);
  ASSERT_EQ(graph.nodes(), 5);
  const auto list = [](auto span) { return std::vector<int>(span.begin(), span.end()); };
  EXPECT_EQ(list(graph.neighbours(0)), (std::vector<int>{2, 1}));
  EXPECT_EQ(list(graph.edges(0)), (std::vector<int>{0, 1}));
  EXPECT_EQ(list(graph.neighbours(2)), (std::vector<int>{0, 3}));
  EXPECT_EQ(list(graph.edges(2)), (std::vector<int>{0, 2}));
  EXPECT_EQ(graph.degree(4), 0);
  EXPECT_EQ(graph_of(0, EdgeList{}).nodes(), 0);
}

TEST(Graph, IsTheSameFromAMatrixOfEdges) {
  const EdgeList edges = random_edges(30, 60, 1);
  Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor> rows(edges.size(), 2);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    rows.row(static_cast<Eigen::Index>(e)) << edges[e][0], edges[e][1];
  }
  const Graph a = graph_of(30, edges);
  const Graph b = graph_of(30, rows);
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.neighbour, b.neighbour);
  EXPECT_EQ(a.edge, b.edge);
  EXPECT_EQ(degrees(30, edges), degrees(30, rows));
  EXPECT_EQ(connected_components(30, edges), connected_components(30, rows));
}

TEST(Graph, DegreesSumToTwiceTheEdges) {
  const EdgeList edges = random_edges(40, 70, 2);
  const Graph graph = graph_of(40, edges);
  const std::vector<int> degree = degrees(40, edges);
  std::size_t sum = 0;
  for (int node = 0; node < 40; ++node) {
    EXPECT_EQ(graph.degree(node), degree[idx(node)]);
    sum += idx(degree[idx(node)]);
  }
  EXPECT_EQ(sum, 2 * edges.size());
}

TEST(ConnectedComponents, AreWhatCanBeReachedNumberedByTheirLowestNodes) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const EdgeList edges = random_edges(40, 25, seed);
    const Graph graph = graph_of(40, edges);
    const auto component = connected_components(40, edges);
    ShortestPaths paths(40);
    int components = 0;
    for (int node = 0; node < 40; ++node) {
      EXPECT_LE(component[idx(node)], components);
      if (component[idx(node)] == components) ++components;
      paths.search(graph, node, ShortestPaths::no_target, [](int, int, int) { return 1.0; });
      for (int other = 0; other < 40; ++other) {
        EXPECT_EQ(paths.distance(other) < ShortestPaths::unreachable,
                  component[idx(node)] == component[idx(other)]);
      }
    }
  }
}

TEST(ShortestPaths, AreAsShortAsRelaxingEveryEdgeFinds) {
  ShortestPaths paths(50);  // one for all: a search leaves nothing to the next
  for (unsigned seed = 0; seed < 30; ++seed) {
    const EdgeList edges = random_edges(50, 30 + 4 * int(seed), seed);
    const std::vector<double> lengths = random_lengths(edges.size(), seed);
    const Graph graph = graph_of(50, edges);
    paths.search(graph, int(seed), ShortestPaths::no_target,
                 [&](int, int, int edge) { return lengths[idx(edge)]; });
    EXPECT_EQ(paths.distances(), distances_by_relaxing(50, edges, lengths, int(seed)));
    for (int node = 0; node < 50; ++node) {
      const std::vector<int> path = paths.path_to(node);
      EXPECT_EQ(path.empty(), paths.distance(node) == ShortestPaths::unreachable);
      if (path.empty()) continue;
      EXPECT_EQ(path.front(), int(seed));
      EXPECT_EQ(path.back(), node);
      double length = 0;
      for (std::size_t i = 1; i < path.size(); ++i) {
        const std::array step{std::min(path[i - 1], path[i]), std::max(path[i - 1], path[i])};
        const auto edge = std::find(edges.begin(), edges.end(), step);
        ASSERT_NE(edge, edges.end());
        length += lengths[idx(edge - edges.begin())];
      }
      EXPECT_EQ(length, paths.distance(node));
    }
  }
}

TEST(ShortestPaths, AreTheSameWhereTheSearchEndsAtItsTarget) {
  const EdgeList edges = random_edges(60, 150, 5);
  const std::vector<double> lengths = random_lengths(edges.size(), 5);
  const Graph graph = graph_of(60, edges);
  const auto length = [&](int, int, int edge) { return lengths[idx(edge)]; };
  ShortestPaths whole(60);
  ShortestPaths part(60);
  whole.search(graph, 0, ShortestPaths::no_target, length);
  for (int target = 0; target < 60; ++target) {
    part.search(graph, 0, target, length);
    EXPECT_EQ(part.path_to(target), whole.path_to(target));
    EXPECT_EQ(part.distance(target), whole.distance(target));
  }
}

TEST(ShortestPaths, EndAtTheirTarget) {
  EdgeList chain;
  for (int node = 1; node < 100; ++node) chain.push_back({node - 1, node});
  const Graph graph = graph_of(100, chain);
  ShortestPaths paths(100);
  int asked = 0;
  paths.search(graph, 0, 3, [&](int, int, int) {
    ++asked;
    return 1.0;
  });
  EXPECT_EQ(asked, 5);  // one step from the first node, two from each of the next two
  EXPECT_EQ(paths.distance(50), ShortestPaths::unreachable);
}

TEST(ShortestPaths, TakeTheLowerNodeOfTwoThatAreEquallyFar) {
  const Graph square = graph_of(4, EdgeList{{0, 2}, {0, 1}, {2, 3}, {1, 3}});
  ShortestPaths paths(4);
  paths.search(square, 0, ShortestPaths::no_target, [](int, int, int) { return 1.0; });
  EXPECT_EQ(paths.path_to(3), (std::vector<int>{0, 1, 3}));
}

TEST(ShortestPaths, DoNotTakeStepsThatAreBarred) {
  const Graph triangle = graph_of(3, EdgeList{{0, 1}, {1, 2}, {0, 2}});
  ShortestPaths paths(3);
  paths.search(triangle, 0, 2,
               [](int, int, int edge) { return edge == 2 ? ShortestPaths::unreachable : 1.0; });
  EXPECT_EQ(paths.path_to(2), (std::vector<int>{0, 1, 2}));
}

}  // namespace
}  // namespace graph_laws
}  // namespace curveskel
