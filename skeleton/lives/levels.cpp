#include <curveskel/levels.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <curveskel/advanced/embed.hpp>
#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "skeleton/embed/tuning.hpp"
#include "skeleton/graph/sound_skeleton.hpp"

namespace curveskel {
namespace {

constexpr double usual_detail = EmbedOptions().detail;

/// Depth-first trees, with what Tarjan (1974) needs to find bridges. Cycles live for ever.
class LifeTree {
 public:
  explicit LifeTree(const CurveSkeleton& skeleton)
      : skeleton_(skeleton),
        graph_(graph_of(skeleton.nodes.rows(), skeleton.edges)),
        parent_(idx(graph_.nodes()), -1),
        edge_above_(parent_.size(), -1),
        lowest_(parent_.size(), 0),
        own_(parent_.size(), 0),
        below_(parent_.size(), 0),
        above_(parent_.size(), 0) {
    walk();
    find_cycles();
    if (has_lives(skeleton)) {
      for (int node = 0; node < graph_.nodes(); ++node) {
        if (graph_.degree(node) != 1) continue;
        own_[idx(node)] = std::max(own_[idx(node)], skeleton.lives[node]);
      }
    }
    sum_up();
  }

  Eigen::VectorXd edge_lives() {
    Eigen::VectorXd lives = Eigen::VectorXd::Constant(skeleton_.edges.rows(), lives_for_ever);
    for (const int node : order_) {
      if (parent_[idx(node)] < 0 || on_cycle_[idx(node)] != 0) continue;
      lives[edge_above_[idx(node)]] = std::min(below_[idx(node)], above_[idx(node)]);
    }
    keep_eldest(lives);
    return lives;
  }

 private:
  /// Depth first, as bridges are found by it.
  void walk() {
    depth_.assign(parent_.size(), -1);
    std::vector<int> next(graph_.first.begin(), graph_.first.end() - 1);
    for (int root = 0; root < graph_.nodes(); ++root) {
      if (depth_[idx(root)] >= 0) continue;
      roots_.push_back(root);
      depth_[idx(root)] = 0;
      std::vector<int> way{root};
      order_.push_back(root);
      while (!way.empty()) {
        const int node = way.back();
        if (next[idx(node)] == graph_.first[idx(node) + 1]) {
          way.pop_back();
          continue;
        }
        const std::size_t step = idx(next[idx(node)]++);
        const int other = graph_.neighbour[step];
        if (depth_[idx(other)] >= 0) continue;
        depth_[idx(other)] = depth_[idx(node)] + 1;
        parent_[idx(other)] = node;
        edge_above_[idx(other)] = graph_.edge[step];
        way.push_back(other);
        order_.push_back(other);
      }
    }
  }

  [[nodiscard]] bool is_child(int node, int of) const { return parent_[idx(node)] == of; }

  /// A node is on a cycle with its parent if something below reaches above both.
  void find_cycles() {
    on_cycle_.assign(parent_.size(), 0);
    for (std::size_t k = order_.size(); k-- > 0;) {
      const int node = order_[k];
      const int parent = parent_[idx(node)];
      int lowest = depth_[idx(node)];
      for (int step = graph_.first[idx(node)]; step < graph_.first[idx(node) + 1]; ++step) {
        if (graph_.edge[idx(step)] == edge_above_[idx(node)]) continue;
        const int other = graph_.neighbour[idx(step)];
        lowest = std::min(lowest, is_child(other, node) ? lowest_[idx(other)] : depth_[idx(other)]);
      }
      lowest_[idx(node)] = lowest;
      if (parent < 0 || lowest >= depth_[idx(node)]) continue;
      on_cycle_[idx(node)] = 1;
      own_[idx(node)] = own_[idx(parent)] = lives_for_ever;
    }
  }

  /// The clearest tip below each node, itself included, and beyond the edge above it.
  void sum_up() {
    for (std::size_t k = order_.size(); k-- > 0;) {
      const int node = order_[k];
      below_[idx(node)] = std::max(below_[idx(node)], own_[idx(node)]);
      const int parent = parent_[idx(node)];
      if (parent >= 0) below_[idx(parent)] = std::max(below_[idx(parent)], below_[idx(node)]);
    }
    for (const int node : order_) {
      const int eldest = eldest_child(node, -1);
      const int second = eldest_child(node, eldest);
      for (const int child : graph_.neighbours(node)) {
        if (!is_child(child, node)) continue;
        const int rival = child == eldest ? second : eldest;
        double beyond = std::max(own_[idx(node)], above_[idx(node)]);
        if (rival >= 0) beyond = std::max(beyond, below_[idx(rival)]);
        above_[idx(child)] = beyond;
      }
    }
  }

  [[nodiscard]] int eldest_child(int node, int but) const {
    int eldest = -1;
    for (const int child : graph_.neighbours(node)) {
      if (!is_child(child, node) || child == but) continue;
      if (eldest < 0 || below_[idx(child)] > below_[idx(eldest)]) eldest = child;
    }
    return eldest;
  }

  /// Of a component without cycles the way between its two eldest tips.
  void keep_eldest(Eigen::VectorXd& lives) {
    from_.assign(parent_.size(), -1);
    way_.assign(parent_.size(), -1);
    for (const int root : roots_) {
      if (below_[idx(root)] >= lives_for_ever || graph_.degree(root) == 0) continue;
      const int eldest = eldest_from(root);
      for (int node = eldest_from(eldest); node != eldest; node = from_[idx(node)]) {
        const int before = from_[idx(node)];
        lives[edge_above_[idx(is_child(node, before) ? node : before)]] = lives_for_ever;
      }
    }
  }

  /// The tip with the largest life in the tree but `start`, the farthest of equals by number of
  /// edges; `from_` leads back.
  [[nodiscard]] int eldest_from(int start) {
    std::vector<int> reached{start};
    from_[idx(start)] = -1;
    way_[idx(start)] = 0;
    int best = -1;
    const auto rank = [&](int node) { return std::pair(own_[idx(node)], way_[idx(node)]); };
    for (std::size_t k = 0; k < reached.size(); ++k) {
      const int node = reached[k];
      const bool is_tip = graph_.degree(node) == 1 && node != start;
      if (is_tip && (best < 0 || rank(node) > rank(best))) best = node;
      for (const int other : graph_.neighbours(node)) {
        if (other == from_[idx(node)]) continue;
        from_[idx(other)] = node;
        way_[idx(other)] = way_[idx(node)] + 1;
        reached.push_back(other);
      }
    }
    return best;
  }

  const CurveSkeleton& skeleton_;
  const Graph graph_;
  std::vector<int> roots_;
  std::vector<int> order_;  // parents before children
  std::vector<int> parent_;
  std::vector<int> edge_above_;
  std::vector<int> depth_;
  std::vector<int> lowest_;     // depth that is reached from below a node
  std::vector<char> on_cycle_;  // with its parent
  std::vector<double> own_;
  std::vector<double> below_;
  std::vector<double> above_;
  std::vector<int> from_;  // of the last `eldest_from`: the node before
  std::vector<int> way_;   // edges from its start
};

/// Outwards from the branches that live for ever: all others hang in trees from them, so that each
/// is reached from its inner end. `at`: per node the branches that end there.
void set_parents(const std::vector<Branch>& all, const std::vector<std::vector<int>>& at,
                 std::vector<BranchLevel>& levels) {
  std::vector<int> holder(at.size(), -1);  // per node, of those it is reached from the eldest
  std::vector<int> reached;                // nodes
  const auto reach = [&](int node, int from) {
    if (holder[idx(node)] >= 0) return;
    holder[idx(node)] = from;
    reached.push_back(node);
  };
  for (std::size_t b = 0; b < all.size(); ++b) {
    if (levels[b].life < lives_for_ever) continue;
    reach(all[b].nodes.front(), static_cast<int>(b));
    reach(all[b].nodes.back(), static_cast<int>(b));
  }
  std::size_t next = 0;
  while (next < reached.size()) {
    const int node = reached[next++];
    for (const int b : at[idx(node)]) {
      const Branch& branch = all[idx(b)];
      if (levels[idx(b)].life >= lives_for_ever || b == holder[idx(node)]) continue;
      levels[idx(b)].parent = holder[idx(node)];
      reach(branch.nodes.front() == node ? branch.nodes.back() : branch.nodes.front(), b);
    }
  }
}

}  // namespace

bool has_lives(const CurveSkeleton& skeleton) {
  return skeleton.lives.size() == skeleton.nodes.rows() && skeleton.nodes.rows() > 0;
}

void set_lives(CurveSkeleton& skeleton, const std::vector<TipLife>& lives) {
  require_sound(skeleton, "set_lives");
  for (const TipLife& life : lives) {
    if (life.vertex >= 0 && life.vertex < skeleton.node_of_vertex.size()) continue;
    throw Error(Fault::input, "set_lives: found a life of vertex " + std::to_string(life.vertex) +
                                  ", needed one of the " +
                                  std::to_string(skeleton.node_of_vertex.size()) +
                                  " that have a node");
  }
  skeleton.lives.setZero(skeleton.nodes.rows());
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  std::vector<int> tip_of(idx(skeleton.nodes.rows()), -1);  // by node, of the leaf it lies on
  for (const Branch& branch : branches(skeleton)) {
    const int first = branch.nodes.front();
    const int last = branch.nodes.back();
    const bool first_is_tip = degree[idx(first)] == 1;
    const bool last_is_tip = degree[idx(last)] == 1;
    if (!first_is_tip && !last_is_tip) continue;
    const std::size_t count = branch.nodes.size();
    for (std::size_t k = 0; k < count; ++k) {
      const int node = branch.nodes[k];
      if (degree[idx(node)] > 2) continue;
      const bool nearer_to_first = first_is_tip && (!last_is_tip || 2 * k < count);
      tip_of[idx(node)] = nearer_to_first ? first : last;
    }
  }
  for (const TipLife& life : lives) {
    const int node = skeleton.node_of_vertex[life.vertex];
    const int tip = node < 0 ? -1 : tip_of[idx(node)];
    if (tip >= 0) skeleton.lives[tip] = std::max(skeleton.lives[tip], life.life);
  }
}

Eigen::VectorXd edge_lives(const CurveSkeleton& skeleton) {
  require_sound(skeleton, "edge_lives");
  if ((skeleton.edges.col(0).array() == skeleton.edges.col(1).array()).any()) {
    throw Error(Fault::input,
                "edge_lives: found an edge from a node to itself, needed edges between two nodes");
  }
  return LifeTree(skeleton).edge_lives();
}

std::vector<BranchLevel> branch_levels(const CurveSkeleton& skeleton) {
  const std::vector<Branch> all = branches(skeleton);
  const Eigen::VectorXd lives = edge_lives(skeleton);
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  std::vector<BranchLevel> levels(all.size());
  std::vector<std::vector<int>> at(degree.size());  // the branches that end in a node
  for (std::size_t b = 0; b < all.size(); ++b) {
    const std::vector<int>& nodes = all[b].nodes;
    levels[b].life = lives[require_edge(skeleton, nodes[0], nodes[1], "branch_levels")];
    const int first = nodes.front();
    const int last = nodes.back();
    at[idx(first)].push_back(static_cast<int>(b));
    if (last != first) at[idx(last)].push_back(static_cast<int>(b));
    const bool has_radii = skeleton.radii.size() > 0;
    if (!has_radii || degree[idx(first)] < 3 || degree[idx(last)] < 3 || first == last) continue;
    const double radii = skeleton.radii[first] + skeleton.radii[last];
    const double apart = (skeleton.nodes.row(first) - skeleton.nodes.row(last)).norm();
    levels[b].merge = radii > 0 ? apart / radii : lives_for_ever;
  }
  set_parents(all, at, levels);
  return levels;
}

CurveSkeleton level_of(const CurveSkeleton& skeleton, double least_life) {
  require_sound(skeleton, "level_of");
  if (!has_lives(skeleton)) return skeleton;
  least_life = std::min(least_life, lives_for_ever);
  const Eigen::VectorXd lives = edge_lives(skeleton);
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  std::vector<int> number(degree.size(), -1);  // in the level
  std::vector<char> stays(degree.size(), 0);
  for (std::size_t node = 0; node < degree.size(); ++node) stays[node] = degree[node] == 0 ? 1 : 0;
  std::vector<int> kept_edges;
  for (int e = 0; e < skeleton.edges.rows(); ++e) {
    if (lives[e] < least_life) continue;
    kept_edges.push_back(e);
    stays[idx(skeleton.edges(e, 0))] = stays[idx(skeleton.edges(e, 1))] = 1;
  }
  std::vector<int> kept_nodes;
  for (int node = 0; node < static_cast<int>(stays.size()); ++node) {
    if (stays[idx(node)] == 0) continue;
    number[idx(node)] = static_cast<int>(kept_nodes.size());
    kept_nodes.push_back(node);
  }
  // The rest hangs in trees from it.
  const Graph graph = graph_of(skeleton.nodes.rows(), skeleton.edges);
  std::vector<int> reached = kept_nodes;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    for (const int other : graph.neighbours(reached[k])) {
      if (number[idx(other)] >= 0) continue;
      number[idx(other)] = number[idx(reached[k])];
      reached.push_back(other);
    }
  }
  CurveSkeleton level;
  level.nodes = skeleton.nodes(kept_nodes, Eigen::all);
  level.lives = skeleton.lives(kept_nodes);
  if (skeleton.radii.size() > 0) level.radii = skeleton.radii(kept_nodes);
  level.edges = skeleton.edges(kept_edges, Eigen::all);
  for (std::int32_t& node : level.edges.reshaped()) node = number[idx(node)];
  level.node_of_vertex = skeleton.node_of_vertex;
  for (int& node : level.node_of_vertex) {
    if (node >= 0) node = number[idx(node)];
  }
  return level;
}

double least_life(double detail) {
  constexpr double least = 0.3;
  constexpr double most = 4;
  if (detail >= usual_detail) return 0;
  return least * std::pow(most / least, (usual_detail - detail) / usual_detail);
}

double least_deficit(double detail) {
  const double most = EmbedTuning{}.prominence;  // what sticks out more has its branch by then
  constexpr double least = 0.15;  // a tip that has its branch lacks as much, see `tip_gap`
  return least + (most - least) * std::min(1.0, (1 - detail) / (1 - usual_detail));
}

std::vector<double> level_limits(const CurveSkeleton& skeleton, int most) {
  std::vector<double> lives;
  for (const BranchLevel& level : branch_levels(skeleton)) {
    if (level.life > 0 && level.life < lives_for_ever) lives.push_back(level.life);
  }
  std::sort(lives.begin(), lives.end());
  constexpr double least_ratio = 1.06;          // a life is known to about .055 of its logarithm
  std::vector<std::pair<double, double>> gaps;  // minus the ratio, the limit
  for (std::size_t k = 1; k < lives.size(); ++k) {
    if (lives[k] > least_ratio * lives[k - 1]) {
      gaps.emplace_back(-lives[k] / lives[k - 1], std::sqrt(lives[k] * lives[k - 1]));
    }
  }
  // The gap to what lives for ever is so by definition: after all that are measured.
  if (!lives.empty()) gaps.emplace_back(0.0, least_ratio * lives.back());
  std::sort(gaps.begin(), gaps.end());
  std::vector<double> limits{0.0};
  for (std::size_t k = 0; k < gaps.size() && static_cast<int>(limits.size()) < most; ++k) {
    limits.push_back(gaps[k].second);
  }
  std::sort(limits.begin(), limits.end());
  return limits;
}

}  // namespace curveskel
