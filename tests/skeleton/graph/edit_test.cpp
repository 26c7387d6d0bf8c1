// Laws of corrections by hand, over the skeletons of several shapes and random sequences of edits.
#include <curveskel/edit.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/levels.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"
#include "tests/skeleton/graph/edited_skeletons.hpp"

namespace curveskel::edit_laws {
namespace {

using namespace edited_skeletons;

TEST(Edits, InRandomSequencesKeepASkeletonASkeleton) {
  constexpr int steps = 60;
  for (const Subject& subject : subjects()) {
    const SurfaceTree tree(subject.surface);
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      shapes::Random random(seed);
      CurveSkeleton skeleton = subject.skeleton;
      std::string history = subject.name + ", seed " + std::to_string(seed);
      for (int step = 0; step < steps; ++step) {
        Edit edit = RandomEdit(skeleton, random, seed % 2 == 0 ? &tree : nullptr).make();
        history += "; " + edit.name;
        SCOPED_TRACE(history);
        expect_invariants(edit.after, subject.skeleton);
        if (testing::Test::HasFailure()) return;
        skeleton = std::move(edit.after);
      }
    }
  }
}

TEST(Edits, OfASkeletonWithoutRadiiAndVerticesAddNone) {
  CurveSkeleton bare = subjects().front().skeleton;
  bare.radii.resize(0);
  bare.node_of_vertex.resize(0);
  const SurfaceTree tree(subjects().front().surface);
  for (const CurveSkeleton& after :
       {prune_branch(bare, branches(bare).front()), remove_node(bare, 0),
        merge_nodes(bare, 0, 1, MergePlace::midpoint, &tree), add_node(bare, 0, {1, 2, 3}, &tree),
        move_node(bare, 0, {0, 0, 0}, &tree), cut_edge(bare, 0), split_edge(bare, 0, 0.5, &tree)}) {
    expect_invariants(after, bare);
  }
}

int tips_at_usual_detail(const CurveSkeleton& skeleton) {
  return graph_topology(level_of(skeleton, least_life(ExtractOptions().embed.detail))).tips;
}

// A limb whose tip was drawn on or shortened by hand had no life, so a level hid the whole of it.
TEST(Edits, KeepTheLifeOfALimb) {
  int asked = 0;
  for (const Subject& subject : subjects()) {
    const CurveSkeleton& before = subject.skeleton;
    const int tips = tips_at_usual_detail(before);
    for (int node = 0; node < nodes_of(before); ++node) {
      const auto neighbours = neighbours_of(before, node);
      if (neighbours.size() > 2) continue;
      ++asked;
      SCOPED_TRACE(subject.name + ", node " + std::to_string(node));
      const Eigen::Vector3d beyond =
          before.nodes.row(node).transpose() + Eigen::Vector3d(0.1, 0.2, 0.3);
      const CurveSkeleton longer = add_node(before, node, beyond);
      EXPECT_EQ(tips_at_usual_detail(longer), tips + (neighbours.size() == 2 ? 1 : 0));
      const auto last = longer.lives.size() - 1;
      EXPECT_GT(longer.lives[last], 0);
      if (neighbours.size() == 2) continue;
      EXPECT_EQ(longer.lives[last], before.lives[node]);
      EXPECT_EQ(longer.lives[node], 0);
      if (neighbours_of(before, neighbours[0]).size() > 2) continue;
      EXPECT_EQ(tips_at_usual_detail(remove_node(before, node)), tips);
    }
  }
  EXPECT_GT(asked, 100);
}

TEST(Edits, GiveTheVerticesOfAPrunedBranchToItsJunction) {
  int pruned = 0;
  for (const Subject& subject : subjects()) {
    const CurveSkeleton& before = subject.skeleton;
    for (const Branch& branch : branches(before)) {
      std::vector<int> nodes = branch.nodes;
      if (neighbours_of(before, nodes.back()).size() == 1) std::reverse(nodes.begin(), nodes.end());
      const int junction = nodes.back();
      const bool leaf = neighbours_of(before, nodes.front()).size() == 1 &&
                        neighbours_of(before, junction).size() > 2;
      if (!leaf) {
        EXPECT_THROW((void)prune_branch(before, branch), Error);
        continue;
      }
      ++pruned;
      const CurveSkeleton after = prune_branch(before, branch);
      EXPECT_EQ(nodes_of(after), nodes_of(before) - static_cast<int>(nodes.size()) + 1);
      const std::set<int> gone(nodes.begin(), nodes.end() - 1);
      for (Eigen::Index v = 0; v < before.node_of_vertex.size(); ++v) {
        const int node = before.node_of_vertex[v];
        const int heir = gone.contains(node) ? junction : node;
        EXPECT_EQ(Eigen::RowVector3d(after.nodes.row(after.node_of_vertex[v])),
                  Eigen::RowVector3d(before.nodes.row(heir)));
      }
    }
  }
  EXPECT_GE(pruned, 4);
}

std::string message_of(const std::function<CurveSkeleton()>& edit) {
  try {
    (void)edit();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "no error";
}

TEST(Edits, RefuseNonsenseAndSayWhat) {
  const CurveSkeleton& h = subjects().front().skeleton;
  const int nodes = nodes_of(h);
  const int edges = edges_of(h);
  constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
  const int i = h.edges(0, 0);
  const int j = h.edges(0, 1);
  const std::vector<std::pair<std::string, std::function<CurveSkeleton()>>> all{
      {"remove_node: found the node -1", [&] { return remove_node(h, -1); }},
      {"move_node: found the node " + std::to_string(nodes),
       [&] {
         return move_node(h, nodes, {0, 0, 0});
       }},
      {"add_node: found the node -7",
       [&] {
         return add_node(h, -7, {0, 0, 0});
       }},
      {"no finite number",
       [&] {
         return move_node(h, 0, {0, no_number, 0});
       }},
      {"merge_nodes: found node 3 twice", [&] { return merge_nodes(h, 3, 3); }},
      {"merge_nodes: found the node -2", [&] { return merge_nodes(h, 0, -2); }},
      {"join_nodes: found node 2 twice", [&] { return join_nodes(h, 2, 2); }},
      {"join_nodes: found an edge between nodes", [&] { return join_nodes(h, j, i); }},
      {"cut_edge: found the edge " + std::to_string(edges), [&] { return cut_edge(h, edges); }},
      {"prune_branch: found the edge -1", [&] { return prune_branch(h, -1); }},
      {"prune_branch: found a branch without an edge", [&] { return prune_branch(h, Branch{}); }},
      {"split_edge: found the share 1", [&] { return split_edge(h, 0, 1); }},
      {"split_edge: found the edge", [&] { return split_edge(h, edges); }},
      {"cut_edge: found the edge 0, but the skeleton has none",
       [&] {
         CurveSkeleton lone;
         lone.nodes.setZero(1, 3);
         return cut_edge(lone, 0);
       }},
      {"remove_node: found the only node",
       [&] {
         CurveSkeleton lone;
         lone.nodes.setZero(1, 3);
         return remove_node(lone, 0);
       }},
  };
  for (const auto& [words, edit] : all) {
    EXPECT_NE(message_of(edit).find(words), std::string::npos) << words << "\n" << message_of(edit);
  }
}

}  // namespace
}  // namespace curveskel::edit_laws
