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
#include <curveskel/certificate.hpp>
#include <curveskel/error.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/findings.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"

namespace curveskel::edit_laws {
namespace {

struct Subject {
  std::string name;
  Surface surface;
  CurveSkeleton skeleton;
};

/// A tree, a knot, handles, and two components.
const std::vector<Subject>& subjects() {
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

int nodes_of(const CurveSkeleton& skeleton) { return static_cast<int>(skeleton.nodes.rows()); }
int edges_of(const CurveSkeleton& skeleton) { return static_cast<int>(skeleton.edges.rows()); }

void expect_invariants(const CurveSkeleton& now, const CurveSkeleton& start) {
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
  ASSERT_TRUE(now.nodes.allFinite());
  ASSERT_EQ(now.node_of_vertex.size(), start.node_of_vertex.size());
  for (Eigen::Index v = 0; v < start.node_of_vertex.size(); ++v) {
    ASSERT_EQ(now.node_of_vertex[v] >= 0, start.node_of_vertex[v] >= 0) << "vertex " << v;
    ASSERT_LT(now.node_of_vertex[v], nodes);
  }
}

std::vector<int> neighbours_of(const CurveSkeleton& skeleton, int node) {
  std::vector<int> found;
  for (const auto& edge : skeleton.edges.rowwise()) {
    if (edge[0] == node) found.push_back(edge[1]);
    if (edge[1] == node) found.push_back(edge[0]);
  }
  return found;
}

int common_neighbours(const CurveSkeleton& skeleton, int a, int b) {
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

// ---- Paths --------------------------------------------------------------------------------------

/// Floyd and Warshall's, which has nothing in common with Dijkstra's.
Eigen::MatrixXd all_distances(const CurveSkeleton& skeleton) {
  const Eigen::Index nodes = skeleton.nodes.rows();
  Eigen::MatrixXd distance =
      Eigen::MatrixXd::Constant(nodes, nodes, std::numeric_limits<double>::infinity());
  distance.diagonal().setZero();
  for (const auto& edge : skeleton.edges.rowwise()) {
    const double length = (skeleton.nodes.row(edge[0]) - skeleton.nodes.row(edge[1])).norm();
    distance(edge[0], edge[1]) = distance(edge[1], edge[0]) = length;
  }
  for (Eigen::Index via = 0; via < nodes; ++via) {
    for (Eigen::Index a = 0; a < nodes; ++a) {
      for (Eigen::Index b = 0; b < nodes; ++b) {
        distance(a, b) = std::min(distance(a, b), distance(a, via) + distance(via, b));
      }
    }
  }
  return distance;
}

TEST(ShortestPath, IsAsLongAsNoOtherIsAndGoesAlongEdges) {
  int unreachable = 0;
  for (const Subject& subject : subjects()) {
    const CurveSkeleton& skeleton = subject.skeleton;
    const Eigen::MatrixXd distance = all_distances(skeleton);
    for (int a = 0; a < nodes_of(skeleton); a += 3) {
      for (int b = 0; b < nodes_of(skeleton); b += 2) {
        const Path path = shortest_path(skeleton, a, b);
        if (!std::isfinite(distance(a, b))) {
          EXPECT_TRUE(path.nodes.empty());
          ++unreachable;
          continue;
        }
        ASSERT_FALSE(path.nodes.empty());
        EXPECT_EQ(path.nodes.front(), a);
        EXPECT_EQ(path.nodes.back(), b);
        double length = 0;
        for (std::size_t k = 1; k < path.nodes.size(); ++k) {
          ASSERT_GE(edge_between(skeleton, path.nodes[k - 1], path.nodes[k]), 0);
          length +=
              (skeleton.nodes.row(path.nodes[k]) - skeleton.nodes.row(path.nodes[k - 1])).norm();
        }
        EXPECT_NEAR(length, path.length, 1e-12 * (1 + length));
        EXPECT_NEAR(path.length, distance(a, b), 1e-12 * (1 + length));
      }
    }
  }
  EXPECT_GT(unreachable, 0);
  EXPECT_THROW((void)shortest_path(subjects().front().skeleton, 0, -1), Error);
}

// ---- Findings -----------------------------------------------------------------------------------

/// Held against the certificate, which knows nothing of edges.
void expect_findings_agree(const Subject& subject, const SurfaceTree& tree,
                           const CurveSkeleton& skeleton) {
  const double diagonal = bounding_box_diagonal(subject.surface.positions);
  const Certificate certificate = evaluate(subject.surface, skeleton, {}, {});
  const Findings found = findings(tree, diagonal, skeleton, {}, {});
  EXPECT_EQ(static_cast<int>(found.spurs.size()), certificate.spurs);
  EXPECT_EQ(found.exits.empty(), certificate.inside_fraction == 1);
  double outside = 0;
  double deepest = 0;
  double lone = 0;
  for (std::size_t k = 0; k < found.exits.size(); ++k) {
    const Exit& exit = found.exits[k];
    EXPECT_GT(exit.length, 0);
    outside += exit.length;
    deepest = std::max(deepest, exit.depth);
    ASSERT_NE(exit.edge >= 0, exit.node >= 0);
    if (exit.edge < 0) {
      EXPECT_TRUE(neighbours_of(skeleton, exit.node).empty());
      continue;
    }
    ASSERT_LT(exit.edge, edges_of(skeleton));
    EXPECT_TRUE(k == 0 || found.exits[k - 1].edge < exit.edge);
  }
  for (int node = 0; node < nodes_of(skeleton); ++node) {
    if (neighbours_of(skeleton, node).empty())
      lone += diagonal * CertificateOptions{}.sample_spacing;
  }
  const double length = certificate.length * diagonal + lone;
  EXPECT_NEAR(outside / length, 1 - certificate.inside_fraction, 1e-9);
  EXPECT_NEAR(deepest / diagonal, certificate.deepest_exit, 1e-12);
}

TEST(Findings, AgreeWithTheCertificateWhateverWasDoneToTheSkeleton) {
  int exits = 0;
  int spurs = 0;
  for (const Subject& subject : subjects()) {
    const SurfaceTree tree(subject.surface);
    const double diagonal = bounding_box_diagonal(subject.surface.positions);
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(subject.name + ", seed " + std::to_string(seed));
      shapes::Random random(seed);
      CurveSkeleton skeleton = subject.skeleton;
      expect_findings_agree(subject, tree, skeleton);
      for (int step = 0; step < 15; ++step) {
        skeleton = RandomEdit(skeleton, random, nullptr).make().after;
      }
      const int node = static_cast<int>(random.index(static_cast<std::size_t>(nodes_of(skeleton))));
      const Eigen::Vector3d nearby = skeleton.nodes.row(node).array() + 0.01 * diagonal;
      skeleton = add_node(skeleton, node, nearby, &tree);
      expect_findings_agree(subject, tree, skeleton);
      const Findings found = findings(tree, diagonal, skeleton, {}, {});
      exits += static_cast<int>(found.exits.size());
      spurs += static_cast<int>(found.spurs.size());
    }
  }
  EXPECT_GT(exits, 0);
  EXPECT_GT(spurs, 0);
}

TEST(Findings, NameTheEdgeThatWasDraggedOutside) {
  const Subject& subject = subjects().front();
  const SurfaceTree tree(subject.surface);
  const double diagonal = bounding_box_diagonal(subject.surface.positions);
  ASSERT_TRUE(findings(tree, diagonal, subject.skeleton, {}, {}).exits.empty());
  for (int node = 0; node < nodes_of(subject.skeleton); ++node) {
    const Eigen::Vector3d outside =
        subject.skeleton.nodes.row(node).transpose() + diagonal * Eigen::Vector3d::UnitZ();
    const CurveSkeleton dragged = move_node(subject.skeleton, node, outside, &tree);
    EXPECT_EQ(dragged.radii[node], 0);
    std::vector<int> touching;
    for (int edge = 0; edge < edges_of(dragged); ++edge) {
      if (dragged.edges(edge, 0) == node || dragged.edges(edge, 1) == node)
        touching.push_back(edge);
    }
    const Findings all = findings(tree, diagonal, dragged, {}, {});
    std::vector<int> found;
    found.reserve(all.exits.size());
    for (const Exit& exit : all.exits) found.push_back(exit.edge);
    EXPECT_EQ(found, touching) << "node " << node;
  }
}

}  // namespace
}  // namespace curveskel::edit_laws
