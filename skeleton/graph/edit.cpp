#include <curveskel/edit.hpp>

#include <algorithm>
#include <limits>
#include <string>

#include <curveskel/error.hpp>
#include <curveskel/levels.hpp>
#include "base/option_ranges.hpp"
#include "skeleton/graph/draft.hpp"

namespace curveskel {
namespace {

[[noreturn]] void refuse_edit(const std::string& edit, const std::string& found,
                              const std::string& needed) {
  throw Error(Fault::input, edit + ": found " + found + ", needed " + needed);
}

std::string in_words(int a, int b) { return std::to_string(a) + " and " + std::to_string(b); }

void require_two_nodes(const CurveSkeleton& skeleton, int a, int b, const std::string& edit) {
  require_node(skeleton, a, edit);
  require_node(skeleton, b, edit);
  if (a == b)
    refuse_edit(edit, "node " + std::to_string(a) + " twice", "two nodes; choose another");
}

void require_place(const Eigen::Vector3d& position, const std::string& edit) {
  if (position.allFinite()) return;
  refuse_edit(edit, "a coordinate that is no finite number",
              "three finite ones; choose another place");
}

/// The branch's nodes, from its tip to the junction that it hangs on.
std::vector<int> from_tip(const Draft& draft, Branch branch) {
  const auto degree = [&](int node) { return draft.neighbours(node).size(); };
  const bool hangs_on_last = degree(branch.nodes.front()) == 1 && degree(branch.nodes.back()) > 2;
  const bool hangs_on_first = degree(branch.nodes.back()) == 1 && degree(branch.nodes.front()) > 2;
  if (!hangs_on_first && !hangs_on_last) {
    refuse_edit("prune_branch",
                "a branch from node " + in_words(branch.nodes.front(), branch.nodes.back()) +
                    " that does not lead from a junction to a tip",
                "one that does; cut an edge, or remove its nodes one by one");
  }
  if (hangs_on_first) std::reverse(branch.nodes.begin(), branch.nodes.end());
  return branch.nodes;
}

int nearest_of(const Draft& draft, int node, const std::vector<int>& others) {
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const int other : others) {
    const double distance = (draft.position(other) - draft.position(node)).norm();
    if (nearest >= 0 && distance >= least) continue;
    nearest = other;
    least = distance;
  }
  return nearest;
}

}  // namespace

CurveSkeleton prune_branch(const CurveSkeleton& skeleton, const Branch& branch) {
  if (branch.nodes.size() < 2)
    refuse_edit("prune_branch", "a branch without an edge", "one with edges");
  for (const int node : branch.nodes) require_node(skeleton, node, "prune_branch");
  for (std::size_t k = 1; k < branch.nodes.size(); ++k) {
    const int a = branch.nodes[k - 1];
    const int b = branch.nodes[k];
    if (edge_between(skeleton, a, b) >= 0) continue;
    refuse_edit("prune_branch", "no edge between nodes " + in_words(a, b) + " of the branch",
                "one of branches(skeleton)");
  }
  Draft draft(skeleton);
  const std::vector<int> nodes = from_tip(draft, branch);
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    if (k > 0 && draft.neighbours(nodes[k]).size() > 1) {
      refuse_edit("prune_branch",
                  "a junction, node " + std::to_string(nodes[k]) + ", on the branch",
                  "one of branches(skeleton)");
    }
    draft.dissolve(nodes[k], nodes[k + 1]);
  }
  return draft.finish();
}

CurveSkeleton prune_branch(const CurveSkeleton& skeleton, int edge) {
  require_edge(skeleton, edge, "prune_branch");
  const int a = skeleton.edges(edge, 0);
  const int b = skeleton.edges(edge, 1);
  for (const Branch& branch : branches(skeleton)) {
    for (std::size_t k = 1; k < branch.nodes.size(); ++k) {
      if (std::minmax({branch.nodes[k - 1], branch.nodes[k]}) == std::pair(a, b)) {
        return prune_branch(skeleton, branch);
      }
    }
  }
  refuse_edit("prune_branch", "edges that are not sorted",
              "a skeleton as CurveSkeleton describes it");
}

CurveSkeleton remove_node(const CurveSkeleton& skeleton, int node) {
  require_node(skeleton, node, "remove_node");
  if (skeleton.nodes.rows() == 1) {
    refuse_edit("remove_node", "the only node", "a skeleton with more; keep it");
  }
  Draft draft(skeleton);
  std::vector<int> heirs = draft.neighbours(node);
  if (heirs.empty()) {
    for (int other = 0; other < skeleton.nodes.rows(); ++other) {
      if (other != node) heirs.push_back(other);
    }
  }
  draft.dissolve(node, nearest_of(draft, node, heirs));
  return draft.finish();
}

CurveSkeleton merge_nodes(const CurveSkeleton& skeleton, int a, int b, MergePlace place,
                          const SurfaceTree* tree) {
  OptionCheck("merge_nodes").number("place", static_cast<int>(place), {0, 1});
  require_two_nodes(skeleton, a, b, "merge_nodes");
  Draft draft(skeleton);
  const bool at_first = place == MergePlace::first;
  const Eigen::Vector3d position =
      at_first ? draft.position(a) : (draft.position(a) + draft.position(b)) / 2;
  const double radius = at_first ? draft.radius(a) : (draft.radius(a) + draft.radius(b)) / 2;
  draft.place(std::min(a, b), position, radius, tree);
  draft.dissolve(std::max(a, b), std::min(a, b));
  return draft.finish();
}

CurveSkeleton move_node(const CurveSkeleton& skeleton, int node, const Eigen::Vector3d& position,
                        const SurfaceTree* tree) {
  require_node(skeleton, node, "move_node");
  require_place(position, "move_node");
  Draft draft(skeleton);
  draft.place(node, position, draft.radius(node), tree);
  return draft.finish();
}

CurveSkeleton cut_edge(const CurveSkeleton& skeleton, int edge) {
  require_edge(skeleton, edge, "cut_edge");
  Draft draft(skeleton);
  draft.disconnect(skeleton.edges(edge, 0), skeleton.edges(edge, 1));
  return draft.finish();
}

CurveSkeleton join_nodes(const CurveSkeleton& skeleton, int a, int b) {
  require_two_nodes(skeleton, a, b, "join_nodes");
  Draft draft(skeleton);
  if (draft.connected(a, b)) {
    refuse_edit("join_nodes", "an edge between nodes " + in_words(a, b),
                "two that are not joined yet; choose another");
  }
  draft.connect(a, b);
  return draft.finish();
}

CurveSkeleton split_edge(const CurveSkeleton& skeleton, int edge, double share,
                         const SurfaceTree* tree) {
  require_edge(skeleton, edge, "split_edge");
  if (!(share > 0 && share < 1)) {
    refuse_edit("split_edge", "the share " + std::to_string(share), "one between 0 and 1");
  }
  Draft draft(skeleton);
  const int i = skeleton.edges(edge, 0);
  const int j = skeleton.edges(edge, 1);
  const int middle = draft.add((1 - share) * draft.position(i) + share * draft.position(j),
                               (1 - share) * draft.radius(i) + share * draft.radius(j), tree);
  draft.disconnect(i, j);
  draft.connect(i, middle);
  draft.connect(middle, j);
  return draft.finish();
}

CurveSkeleton add_node(const CurveSkeleton& skeleton, int neighbour,
                       const Eigen::Vector3d& position, const SurfaceTree* tree) {
  require_node(skeleton, neighbour, "add_node");
  require_place(position, "add_node");
  Draft draft(skeleton);
  const int added = draft.add(position, draft.radius(neighbour), tree);
  if (has_lives(skeleton)) draft.set_life(added, skeleton.lives[neighbour]);
  draft.connect(neighbour, added);
  return draft.finish();
}

}  // namespace curveskel
