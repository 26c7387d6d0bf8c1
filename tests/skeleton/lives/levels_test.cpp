// Laws of levels: nested parts of one skeleton, with the topology of the whole.
#include <curveskel/levels.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>

namespace curveskel::level_laws {
namespace {

/// Trees, cycles and nodes alone, drawn by lot; tips have lives, some none.
CurveSkeleton graph_by_lot(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](int end) {
    return static_cast<int>(random() % static_cast<unsigned>(end));
  };
  const int nodes = 2 + below(40);
  std::set<std::pair<int, int>> edges;
  for (int node = 1; node < nodes; ++node) {
    if (below(12) > 0) edges.emplace(below(node), node);
  }
  for (int more = below(4); more > 0; --more) {
    const int a = below(nodes);
    const int b = below(nodes);
    if (a != b) edges.emplace(std::min(a, b), std::max(a, b));
  }
  CurveSkeleton skeleton;
  skeleton.nodes = Positions::Random(nodes, 3);
  skeleton.radii = Eigen::VectorXd::Random(nodes).cwiseAbs();
  skeleton.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
  Eigen::Index row = 0;
  for (const auto& [a, b] : edges) skeleton.edges.row(row++) << a, b;
  skeleton.lives.setZero(nodes);
  const std::vector<int> degree = degrees(nodes, skeleton.edges);
  for (int node = 0; node < nodes; ++node) {
    if (degree[idx(node)] == 1 && below(5) > 0) skeleton.lives[node] = 0.1 * (1 + below(60));
  }
  skeleton.node_of_vertex.resize(Eigen::Index{3} * nodes);
  for (int& node : skeleton.node_of_vertex) node = below(nodes + 1) - 1;
  return skeleton;
}

std::vector<CurveSkeleton> graphs() {
  std::vector<CurveSkeleton> all;
  for (unsigned seed = 0; seed < 200; ++seed) all.push_back(graph_by_lot(seed));
  return all;
}

using Place = std::vector<double>;
Place place_of(const CurveSkeleton& skeleton, int node) {
  const Eigen::RowVector3d p = skeleton.nodes.row(node);
  return {p.x(), p.y(), p.z()};
}

std::set<std::pair<Place, Place>> edges_of(const CurveSkeleton& skeleton) {
  std::set<std::pair<Place, Place>> edges;
  for (const auto& edge : skeleton.edges.rowwise()) {
    const std::pair<Place, Place> ends =
        std::minmax(place_of(skeleton, edge[0]), place_of(skeleton, edge[1]));
    edges.insert(ends);
  }
  return edges;
}

constexpr double limits[]{0, 0.15, 0.5, 1, 2.05, 3.3, 5, 7, 100};

TEST(Levels, KeepComponentsAndCycles) {
  for (const CurveSkeleton& skeleton : graphs()) {
    const GraphTopology whole = graph_topology(skeleton);
    for (const double limit : limits) {
      const GraphTopology level = graph_topology(level_of(skeleton, limit));
      EXPECT_EQ(level.components, whole.components);
      EXPECT_EQ(level.cycle_rank, whole.cycle_rank);
    }
  }
}

TEST(Levels, AreNestedAndMoveNothing) {
  for (const CurveSkeleton& skeleton : graphs()) {
    auto finer = edges_of(skeleton);
    EXPECT_EQ(edges_of(level_of(skeleton, 0)), finer) << "nothing is under 0";
    for (const double limit : limits) {
      const auto coarser = edges_of(level_of(skeleton, limit));
      EXPECT_TRUE(std::includes(finer.begin(), finer.end(), coarser.begin(), coarser.end()));
      finer = coarser;
    }
  }
}

/// A level of a level is the level of the whole.
TEST(Levels, ComeInAnyOrder) {
  for (const CurveSkeleton& skeleton : graphs()) {
    const CurveSkeleton once = level_of(skeleton, 2.05);
    const CurveSkeleton twice = level_of(level_of(skeleton, 0.5), 2.05);
    EXPECT_EQ(once.edges, twice.edges);
    EXPECT_EQ(once.nodes, twice.nodes);
    EXPECT_EQ(once.node_of_vertex, twice.node_of_vertex);
  }
}

/// Whatever has that life, or a tip of a component's eldest way, is a tip of the level.
TEST(Levels, HaveTheTipsOfTheirLife) {
  for (const CurveSkeleton& skeleton : graphs()) {
    for (const double limit : limits) {
      const CurveSkeleton level = level_of(skeleton, limit);
      std::set<Place> left;
      for (int node = 0; node < level.nodes.rows(); ++node) left.insert(place_of(level, node));
      for (int node = 0; node < skeleton.nodes.rows(); ++node) {
        const bool has_life = skeleton.lives[node] > 0 && skeleton.lives[node] >= limit;
        if (has_life) {
          EXPECT_EQ(left.count(place_of(skeleton, node)), 1U);
        }
      }
      const std::vector<int> part = component_of_node(level);
      std::map<int, int> younger;  // by component: tips that are younger than the limit
      const std::vector<int> degree = degrees(level.nodes.rows(), level.edges);
      for (int node = 0; node < level.nodes.rows(); ++node) {
        if (degree[idx(node)] != 1) continue;
        if (level.lives[node] < limit) ++younger[part[idx(node)]];
      }
      for (const auto& [component, count] : younger) EXPECT_LE(count, 2);
    }
  }
}

TEST(Levels, HandVerticesOnWithinTheirComponent) {
  for (const CurveSkeleton& skeleton : graphs()) {
    const std::vector<int> part = component_of_node(skeleton);
    const CurveSkeleton level = level_of(skeleton, 2.05);
    std::map<Place, int> part_at;
    for (int node = 0; node < skeleton.nodes.rows(); ++node) {
      part_at[place_of(skeleton, node)] = part[idx(node)];
    }
    for (Eigen::Index v = 0; v < skeleton.node_of_vertex.size(); ++v) {
      const int before = skeleton.node_of_vertex[v];
      const int after = level.node_of_vertex[v];
      ASSERT_EQ(before < 0, after < 0);
      if (before < 0) continue;
      EXPECT_EQ(part_at.at(place_of(level, after)), part[idx(before)]);
    }
  }
}

TEST(Levels, BranchesHangFromElderOnes) {
  for (const CurveSkeleton& skeleton : graphs()) {
    const auto levels = branch_levels(skeleton);
    ASSERT_EQ(levels.size(), branches(skeleton).size());
    for (const BranchLevel& level : levels) {
      EXPECT_EQ(level.parent < 0, level.life >= lives_for_ever);
      if (level.parent >= 0) {
        EXPECT_GE(levels[idx(level.parent)].life, level.life);
      }
      // All end in what stays at every level.
      std::size_t steps = 0;
      for (int at = level.parent; at >= 0 && steps <= levels.size(); ++steps) {
        at = levels[idx(at)].parent;
      }
      EXPECT_LE(steps, levels.size());
    }
  }
}

/// A ring or a line of its own, and leaves that hang from it.
CurveSkeleton with_leaves(bool ring, const std::vector<double>& lives) {
  CurveSkeleton skeleton;
  const auto leaves = static_cast<Eigen::Index>(lives.size());
  skeleton.nodes = Positions::Random(4 + leaves, 3);
  skeleton.radii = Eigen::VectorXd::Constant(4 + leaves, 0.1);
  skeleton.lives.setZero(4 + leaves);
  if (!ring) skeleton.lives[0] = skeleton.lives[3] = 9;
  std::set<std::pair<int, int>> edges{{0, 1}, {1, 2}, {2, 3}};
  if (ring) edges.emplace(0, 3);
  for (int k = 0; k < static_cast<int>(leaves); ++k) {
    edges.emplace(1, 4 + k);
    skeleton.lives[4 + k] = lives[idx(k)];
  }
  skeleton.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
  Eigen::Index row = 0;
  for (const auto& [a, b] : edges) skeleton.edges.row(row++) << a, b;
  skeleton.node_of_vertex = Eigen::VectorXi::Zero(1);
  return skeleton;
}

TEST(Levels, LeavesAsClearAsEachOtherGoTogether) {
  for (const bool ring : {true, false}) {
    SCOPED_TRACE(ring);
    const auto edges_by_level = [&](const std::vector<double>& lives, int most) {
      const CurveSkeleton skeleton = with_leaves(ring, lives);
      std::vector<Eigen::Index> counts;
      for (const double limit : level_limits(skeleton, most)) {
        counts.push_back(level_of(skeleton, limit).edges.rows() - (ring ? 4 : 3));
      }
      return counts;
    };
    using Counts = std::vector<Eigen::Index>;
    EXPECT_EQ(edges_by_level({}, 4), Counts{0});
    EXPECT_EQ(edges_by_level({2}, 4), (Counts{1, 0}));
    EXPECT_EQ(edges_by_level({6.13, 6.15, 6.16, 6.17, 6.19}, 4), (Counts{5, 0}));
    EXPECT_EQ(edges_by_level({1, 1.02, 4, 4.1}, 4), (Counts{4, 2, 0}));
    EXPECT_EQ(edges_by_level({1, 1.02, 4, 4.1}, 2), (Counts{4, 2})) << "measured gaps come first";
  }
}

TEST(Levels, LimitsLieBetweenLives) {
  for (const CurveSkeleton& skeleton : graphs()) {
    for (const int most : {1, 3, 100}) {
      const std::vector<double> found = level_limits(skeleton, most);
      ASSERT_FALSE(found.empty());
      EXPECT_EQ(found.front(), 0);
      EXPECT_LE(found.size(), idx(most));
      Eigen::Index edges = skeleton.edges.rows() + 1;
      for (const double limit : found) {
        const Eigen::Index now = level_of(skeleton, limit).edges.rows();
        EXPECT_LT(now, edges) << "each level differs";
        edges = now;
      }
    }
  }
}

/// Two edges between the same nodes, alone and with a branch.
TEST(Levels, TwoEdgesBetweenTwoNodesAreACycle) {
  for (const bool has_branch : {false, true}) {
    CurveSkeleton ring;
    ring.nodes.setRandom(has_branch ? 3 : 2, 3);
    ring.edges.resize(ring.nodes.rows(), 2);
    ring.edges.row(0) << 0, 1;
    ring.edges.row(1) << 0, 1;
    if (has_branch) ring.edges.row(2) << 1, 2;
    ring.lives.setConstant(ring.nodes.rows(), 0.5);
    const Eigen::VectorXd lives = edge_lives(ring);
    EXPECT_EQ(lives[0], lives_for_ever);
    EXPECT_EQ(lives[1], lives_for_ever);
    if (has_branch) {
      EXPECT_EQ(lives[2], 0.5);
    }
    EXPECT_EQ(level_of(ring, 1).edges.rows(), 2);
  }
}

TEST(Levels, WithoutLivesThereIsOne) {
  CurveSkeleton skeleton = graph_by_lot(3);
  skeleton.lives.resize(0);
  EXPECT_EQ(level_of(skeleton, 3).edges, skeleton.edges);
}

}  // namespace
}  // namespace curveskel::level_laws
