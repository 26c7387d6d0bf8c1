// Skeletons of several shapes, and random corrections of them.
#pragma once

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

#include <curveskel/edit.hpp>
#include <curveskel/extract.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"

namespace curveskel::edited_skeletons {

struct Subject {
  std::string name;
  Surface surface;
  CurveSkeleton skeleton;
};

/// A tree, a knot, handles, and two components.
inline const std::vector<Subject>& subjects() {
  static const std::vector<Subject> all = [] {
    std::vector<Subject> made;
    for (const std::string_view name : {"h", "torus", "double-torus", "linked-rings", "random"}) {
      for (const auto& entry : shapes::catalogue()) {
        if (entry.name != name) continue;
        Surface surface = entry.make().surface;
        ExtractOptions options;
        options.resolution = 2000;
        CurveSkeleton skeleton = extract(surface, options, {}).skeleton;
        made.push_back({std::string(name), std::move(surface), std::move(skeleton)});
      }
    }
    return made;
  }();
  return all;
}

inline int nodes_of(const CurveSkeleton& skeleton) {
  return static_cast<int>(skeleton.nodes.rows());
}
inline int edges_of(const CurveSkeleton& skeleton) {
  return static_cast<int>(skeleton.edges.rows());
}

inline void expect_invariants(const CurveSkeleton& now, const CurveSkeleton& start) {
  const int nodes = nodes_of(now);
  for (Eigen::Index e = 0; e < now.edges.rows(); ++e) {
    const std::array edge{now.edges(e, 0), now.edges(e, 1)};
    ASSERT_GE(edge[0], 0);
    ASSERT_LT(edge[0], edge[1]);
    ASSERT_LT(edge[1], nodes);
    if (e == 0) continue;
    ASSERT_LT((std::array{now.edges(e - 1, 0), now.edges(e - 1, 1)}), edge);
  }
  ASSERT_EQ(now.radii.size(), start.radii.size() > 0 ? nodes : 0);
  ASSERT_TRUE((now.radii.array() >= 0).all());
  ASSERT_EQ(now.lives.size(), start.lives.size() > 0 ? nodes : 0);
  ASSERT_TRUE(now.nodes.allFinite());
  ASSERT_EQ(now.node_of_vertex.size(), start.node_of_vertex.size());
  for (Eigen::Index v = 0; v < start.node_of_vertex.size(); ++v) {
    ASSERT_EQ(now.node_of_vertex[v] >= 0, start.node_of_vertex[v] >= 0) << "vertex " << v;
    ASSERT_LT(now.node_of_vertex[v], nodes);
  }
}

inline std::vector<int> neighbours_of(const CurveSkeleton& skeleton, int node) {
  std::vector<int> found;
  for (const auto& edge : skeleton.edges.rowwise()) {
    if (edge[0] == node) found.push_back(edge[1]);
    if (edge[1] == node) found.push_back(edge[0]);
  }
  return found;
}

inline int common_neighbours(const CurveSkeleton& skeleton, int a, int b) {
  int common = 0;
  for (const int of_a : neighbours_of(skeleton, a)) {
    for (const int of_b : neighbours_of(skeleton, b)) common += of_a == of_b ? 1 : 0;
  }
  return common;
}

struct Edit {
  std::string name;
  CurveSkeleton after;
};

/// An edit of `before` at random places, held to what it must do to the graph. Refused ones leave
/// it as it was.
class RandomEdit {
 public:
  RandomEdit(const CurveSkeleton& skeleton, shapes::Random& random, const SurfaceTree* tree)
      : before(skeleton), was(graph_topology(skeleton)), random_(random), tree_(tree) {}

  Edit make() {
    using Maker = Edit (RandomEdit::*)();
    constexpr std::array<Maker, 8> makers{
        &RandomEdit::prune, &RandomEdit::remove, &RandomEdit::merge, &RandomEdit::move,
        &RandomEdit::cut,   &RandomEdit::join,   &RandomEdit::split, &RandomEdit::add};
    return (this->*makers[random_.index(makers.size())])();
  }

 private:
  int any(int count) { return static_cast<int>(random_.index(static_cast<std::size_t>(count))); }
  int any_node() { return any(nodes_of(before)); }

  void expect_change(const CurveSkeleton& after, int components, int cycles) const {
    const GraphTopology is = graph_topology(after);
    EXPECT_EQ(is.components - was.components, components);
    EXPECT_EQ(is.cycle_rank - was.cycle_rank, cycles);
  }
  /// An edge, or a node that stands for two, less or more: it counts in one of the two.
  void expect_balance(const CurveSkeleton& after, int components_less_cycles) const {
    const GraphTopology is = graph_topology(after);
    EXPECT_EQ(is.components - is.cycle_rank - (was.components - was.cycle_rank),
              components_less_cycles);
    EXPECT_LE(std::abs(is.components - was.components), 1);
  }

  Edit prune() {
    if (edges_of(before) == 0) return {"prune nothing", before};
    const int edge = any(edges_of(before));
    const std::string name = "prune edge " + std::to_string(edge);
    try {
      CurveSkeleton after = prune_branch(before, edge);
      expect_change(after, 0, 0);
      EXPECT_EQ(graph_topology(after).tips, was.tips - 1);
      EXPECT_LE(graph_topology(after).junctions, was.junctions);
      return {name, std::move(after)};
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      return {name + " refused", before};
    }
  }

  Edit remove() {
    if (nodes_of(before) == 1) return {"remove nothing", before};
    const int node = any_node();
    CurveSkeleton after = remove_node(before, node);
    EXPECT_EQ(nodes_of(after), nodes_of(before) - 1);
    const std::vector<int> around = neighbours_of(before, node);
    int heir = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const int other : around) {
      const double distance = (before.nodes.row(other) - before.nodes.row(node)).norm();
      if (distance < least) heir = other;
      least = std::min(least, distance);
    }
    expect_change(after, around.empty() ? -1 : 0,
                  around.empty() ? 0 : -common_neighbours(before, node, heir));
    return {"remove node " + std::to_string(node), std::move(after)};
  }

  Edit merge() {
    const int a = any_node();
    int b = any_node();
    const std::vector<int> around = neighbours_of(before, a);
    if (!around.empty() && random_.index(2) == 0) b = around[random_.index(around.size())];
    if (a == b) return {"merge nothing", before};
    const MergePlace place = random_.index(2) == 0 ? MergePlace::midpoint : MergePlace::first;
    CurveSkeleton after = merge_nodes(before, a, b, place, tree_);
    const int common = common_neighbours(before, a, b);
    if (edge_between(before, a, b) >= 0) {
      expect_change(after, 0, -common);
    } else {
      expect_balance(after, common - 1);
    }
    const Eigen::RowVector3d wanted = place == MergePlace::first
                                          ? Eigen::RowVector3d(before.nodes.row(a))
                                          : (before.nodes.row(a) + before.nodes.row(b)) / 2;
    EXPECT_EQ(after.nodes.row(std::min(a, b)), wanted);
    return {"merge nodes " + std::to_string(a) + " and " + std::to_string(b), std::move(after)};
  }

  Edit move() {
    const int node = any_node();
    const Eigen::Vector3d place =
        before.nodes.row(node).transpose() +
        0.2 * Eigen::Vector3d(random_.normal(), random_.normal(), random_.normal());
    CurveSkeleton after = move_node(before, node, place, tree_);
    EXPECT_EQ(after.edges, before.edges);
    EXPECT_EQ(after.node_of_vertex, before.node_of_vertex);
    EXPECT_EQ(Eigen::Vector3d(after.nodes.row(node)), place);
    if (tree_ != nullptr) {
      EXPECT_EQ(after.radii[node], std::max(0.0, tree_->inscribed_radius(place)));
    } else {
      EXPECT_EQ(after.radii, before.radii);
    }
    return {"move node " + std::to_string(node), std::move(after)};
  }

  Edit cut() {
    if (edges_of(before) == 0) return {"cut nothing", before};
    const int edge = any(edges_of(before));
    CurveSkeleton after = cut_edge(before, edge);
    expect_balance(after, 1);
    const CurveSkeleton again = join_nodes(after, before.edges(edge, 1), before.edges(edge, 0));
    EXPECT_EQ(again.edges, before.edges);
    return {"cut edge " + std::to_string(edge), std::move(after)};
  }

  Edit join() {
    const int a = any_node();
    const int b = any_node();
    if (a == b || edge_between(before, a, b) >= 0) {
      EXPECT_THROW((void)join_nodes(before, a, b), Error);
      return {"join nothing", before};
    }
    CurveSkeleton after = join_nodes(before, a, b);
    expect_balance(after, -1);
    EXPECT_EQ(cut_edge(after, edge_between(after, a, b)).edges, before.edges);
    return {"join nodes " + std::to_string(a) + " and " + std::to_string(b), std::move(after)};
  }

  Edit split() {
    if (edges_of(before) == 0) return {"split nothing", before};
    const int edge = any(edges_of(before));
    CurveSkeleton after = split_edge(before, edge, random_.uniform(0.1, 0.9), tree_);
    expect_change(after, 0, 0);
    EXPECT_EQ(nodes_of(after), nodes_of(before) + 1);
    EXPECT_EQ(remove_node(after, nodes_of(before)).edges, before.edges);
    return {"split edge " + std::to_string(edge), std::move(after)};
  }

  Edit add() {
    const int node = any_node();
    const Eigen::Vector3d place = before.nodes.row(node).array() + random_.uniform(0.1, 0.3);
    CurveSkeleton after = add_node(before, node, place, tree_);
    expect_change(after, 0, 0);
    EXPECT_EQ(Eigen::Vector3d(after.nodes.row(nodes_of(before))), place);
    EXPECT_GE(edge_between(after, node, nodes_of(before)), 0);
    EXPECT_EQ(remove_node(after, nodes_of(before)).edges, before.edges);
    return {"add to node " + std::to_string(node), std::move(after)};
  }

 public:
  const CurveSkeleton& before;
  const GraphTopology was;

 private:
  shapes::Random& random_;
  const SurfaceTree* tree_;
};

}  // namespace curveskel::edited_skeletons
