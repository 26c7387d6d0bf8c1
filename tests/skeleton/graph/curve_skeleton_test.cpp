// Laws of the graph itself, over random graphs and a few with a known answer.
#include <curveskel/curve_skeleton.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/levels.hpp>

namespace curveskel::curve_skeleton_laws {
namespace {

CurveSkeleton graph(int nodes, const std::set<std::pair<int, int>>& edges) {
  CurveSkeleton skeleton;
  skeleton.nodes = Positions::Random(nodes, 3);
  skeleton.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
  Eigen::Index row = 0;
  for (const auto& [i, j] : edges) skeleton.edges.row(row++) << i, j;
  return skeleton;
}

CurveSkeleton random_graph(unsigned seed) {
  std::mt19937 random(seed);
  const int nodes = 1 + static_cast<int>(random() % 40);
  const int tries = static_cast<int>(random() % 60);
  std::set<std::pair<int, int>> edges;
  for (int t = 0; t < tries; ++t) {
    const int a = static_cast<int>(random() % static_cast<unsigned>(nodes));
    const int b = static_cast<int>(random() % static_cast<unsigned>(nodes));
    if (a != b) edges.insert(std::minmax({a, b}));
  }
  return graph(nodes, edges);
}

std::vector<int> degrees(const CurveSkeleton& skeleton) {
  std::vector<int> degree(static_cast<std::size_t>(skeleton.nodes.rows()), 0);
  for (const auto node : skeleton.edges.reshaped()) ++degree[static_cast<std::size_t>(node)];
  return degree;
}

TEST(EdgeBetween, FindsEveryEdgeEitherWayAndNoOther) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const CurveSkeleton skeleton = random_graph(seed);
    int found = 0;
    for (int a = 0; a < skeleton.nodes.rows(); ++a) {
      for (int b = 0; b < skeleton.nodes.rows(); ++b) {
        const int edge = edge_between(skeleton, a, b);
        if (edge < 0) continue;
        ++found;
        EXPECT_EQ(skeleton.edges(edge, 0), std::min(a, b)) << seed;
        EXPECT_EQ(skeleton.edges(edge, 1), std::max(a, b)) << seed;
      }
    }
    EXPECT_EQ(found, 2 * skeleton.edges.rows()) << seed;
  }
}

TEST(Branches, CoverEveryEdgeOnce) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const CurveSkeleton skeleton = random_graph(seed);
    std::vector<std::pair<int, int>> covered;
    for (const Branch& branch : branches(skeleton)) {
      for (std::size_t k = 1; k < branch.nodes.size(); ++k) {
        covered.emplace_back(std::min(branch.nodes[k - 1], branch.nodes[k]),
                             std::max(branch.nodes[k - 1], branch.nodes[k]));
      }
    }
    std::sort(covered.begin(), covered.end());
    ASSERT_EQ(static_cast<Eigen::Index>(covered.size()), skeleton.edges.rows()) << seed;
    for (std::size_t e = 0; e < covered.size(); ++e) {
      const auto row = static_cast<Eigen::Index>(e);
      EXPECT_EQ(covered[e], std::make_pair(skeleton.edges(row, 0), skeleton.edges(row, 1)));
    }
  }
}

TEST(Branches, EndWhereTheDegreeIsNotTwoAndNowhereElse) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const CurveSkeleton skeleton = random_graph(seed);
    const std::vector<int> degree = degrees(skeleton);
    for (const Branch& branch : branches(skeleton)) {
      ASSERT_GE(branch.nodes.size(), 2U);
      for (std::size_t k = 1; k + 1 < branch.nodes.size(); ++k) {
        EXPECT_EQ(degree[static_cast<std::size_t>(branch.nodes[k])], 2) << seed;
      }
      if (degree[static_cast<std::size_t>(branch.nodes.front())] == 2) {
        EXPECT_EQ(branch.nodes.front(), branch.nodes.back()) << seed;
        EXPECT_EQ(branch.nodes.front(),
                  *std::min_element(branch.nodes.begin(), branch.nodes.end()));
      } else {
        EXPECT_NE(degree[static_cast<std::size_t>(branch.nodes.back())], 2) << seed;
        EXPECT_LE(branch.nodes.front(), branch.nodes.back());
      }
    }
  }
}

TEST(Branches, AreSortedByTheirFirstTwoNodes) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::vector<std::pair<int, int>> starts;
    for (const Branch& branch : branches(random_graph(seed))) {
      starts.emplace_back(branch.nodes[0], branch.nodes[1]);
    }
    EXPECT_TRUE(std::is_sorted(starts.begin(), starts.end())) << seed;
  }
}

TEST(Branches, OfALollipopAreTheStickAndTheLoop) {
  const auto found = branches(graph(5, {{0, 1}, {1, 2}, {1, 4}, {2, 3}, {3, 4}}));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].nodes, (std::vector<int>{0, 1}));
  EXPECT_EQ(found[1].nodes, (std::vector<int>{1, 2, 3, 4, 1}));
}

// The row of an edge is sought in sorted rows; where it was not found, memory before the first was
// written.
TEST(Branches, OfEdgesThatAreNotSortedAreRightOrRefused) {
  int refused = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    CurveSkeleton skeleton = random_graph(seed);
    std::mt19937 random(seed);
    for (Eigen::Index e = skeleton.edges.rows() - 1; e > 0; --e) {
      const auto other = static_cast<Eigen::Index>(random() % idx(e + 1));
      skeleton.edges.row(e).swap(skeleton.edges.row(other));
    }
    for (Eigen::Index e = 0; e < skeleton.edges.rows(); ++e) {
      if (random() % 4 == 0) std::swap(skeleton.edges(e, 0), skeleton.edges(e, 1));
    }
    try {
      const std::vector<int> branch = branch_of_edges(skeleton);
      EXPECT_EQ(std::count(branch.begin(), branch.end(), -1), 0) << seed;
      EXPECT_EQ(branch_levels(skeleton).size(), branches(skeleton).size()) << seed;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      EXPECT_NE(std::string(error.what()).find("sorted"), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(GraphTopology, CycleRankIsWhatTheBranchesOfADepthFirstTreeLeaveOut) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const CurveSkeleton skeleton = random_graph(seed);
    std::map<int, std::vector<int>> neighbours;
    for (Eigen::Index e = 0; e < skeleton.edges.rows(); ++e) {
      neighbours[skeleton.edges(e, 0)].push_back(skeleton.edges(e, 1));
      neighbours[skeleton.edges(e, 1)].push_back(skeleton.edges(e, 0));
    }
    std::set<int> seen;
    int components = 0;
    int tree_edges = 0;
    for (int root = 0; root < skeleton.nodes.rows(); ++root) {
      if (!seen.insert(root).second) continue;
      ++components;
      std::vector<int> stack{root};
      while (!stack.empty()) {
        const int node = stack.back();
        stack.pop_back();
        for (const int other : neighbours[node]) {
          if (!seen.insert(other).second) continue;
          ++tree_edges;
          stack.push_back(other);
        }
      }
    }
    const GraphTopology found = graph_topology(skeleton);
    EXPECT_EQ(found.components, components) << seed;
    EXPECT_EQ(found.cycle_rank, skeleton.edges.rows() - tree_edges) << seed;
    const std::vector<int> degree = degrees(skeleton);
    EXPECT_EQ(found.tips, std::count(degree.begin(), degree.end(), 1)) << seed;
    EXPECT_EQ(found.junctions,
              std::count_if(degree.begin(), degree.end(), [](int d) { return d >= 3; }));
  }
}

TEST(GraphTopology, OfNothingIsNothing) {
  const GraphTopology empty = graph_topology(CurveSkeleton{});
  EXPECT_EQ(empty.components, 0);
  EXPECT_EQ(empty.cycle_rank, 0);
}

}  // namespace
}  // namespace curveskel::curve_skeleton_laws
