#include "rig/joints/rooted_tree.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include "rig/joints/hanging.hpp"

namespace curveskel {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

}  // namespace

class RootedTrees::Rooting {
 public:
  Rooting(const CurveSkeleton& skeleton, int wanted, const std::vector<int>& ground)
      : skeleton_(skeleton),
        graph_(graph_of(skeleton.nodes.rows(), skeleton.edges)),
        mass_(idx(skeleton.nodes.rows())),
        paths_(skeleton.nodes.rows()),
        wanted_(wanted) {
    for (const auto& edge : skeleton.edges.rowwise()) {
      const double half = 0.5 * length(edge[0], edge[1]);
      mass_[idx(edge[0])] += half * radius(edge[0]);
      mass_[idx(edge[1])] += half * radius(edge[1]);
    }
    components_ = find_components();
    std::stable_partition(components_.begin(), components_.end(),
                          [this](const auto& nodes) { return has_wanted(nodes); });
    if (components_.empty()) return;
    hanging_ = std::make_unique<HangingComponents>(skeleton_, usable_radii(skeleton_), components_,
                                                   ground);
  }

  RootedTree grow(const Eigen::Vector3d& up) {
    RootedTree tree;
    tree.parent.assign(mass_.size(), -1);
    tree.children.resize(mass_.size());
    const std::vector<Hinge> hinges = rooted_hinges(up);
    for (const std::size_t component : outwards(hinges)) {
      const std::vector<int>& nodes = components_[component];
      const int root = hinges[component].node;
      tree.roots.push_back(root);
      tree.above.push_back(hinges[component].above);
      walk(root, cut_at(nodes, root));
      for (const int node : nodes) {
        const int parent = tree.parent[idx(node)] = paths_.before(node);
        if (parent >= 0) tree.children[idx(parent)].push_back(node);
      }
    }
    return tree;
  }

 private:
  [[nodiscard]] bool has_wanted(const std::vector<int>& nodes) const {
    return std::binary_search(nodes.begin(), nodes.end(), wanted_);
  }

  /// Those that hang from none have a root of their own.
  [[nodiscard]] std::vector<Hinge> rooted_hinges(const Eigen::Vector3d& up) {
    if (components_.empty()) return {};
    std::vector<Hinge> hinges = hanging_->hinges(up);
    for (std::size_t k = 0; k < components_.size(); ++k) {
      if (k == 0 && has_wanted(components_[k])) {
        hinges[k].node = wanted_;
      } else if (k == 0 || hinges[k].above < 0) {
        hinges[k].node = root_of(components_[k], components_.size() > 1);
      }
    }
    return hinges;
  }

  [[nodiscard]] double length(int a, int b) const {
    return (skeleton_.nodes.row(a) - skeleton_.nodes.row(b)).norm();
  }
  [[nodiscard]] double radius(int node) const {
    return skeleton_.radii.size() > 0 ? skeleton_.radii[node] : 1;
  }
  [[nodiscard]] int degree(int node) const { return graph_.degree(node); }

  /// The heaviest first, of those as heavy (but for rounding) the one with the first node; nodes
  /// ascending.
  [[nodiscard]] std::vector<std::vector<int>> find_components() const {
    std::vector<std::pair<double, std::vector<int>>> components;
    std::vector<bool> seen(mass_.size());
    for (std::size_t first = 0; first < seen.size(); ++first) {
      if (seen[first]) continue;
      seen[first] = true;
      std::vector<int> nodes{static_cast<int>(first)};
      double weight = 0;
      for (std::size_t next = 0; next < nodes.size(); ++next) {
        weight += mass_[idx(nodes[next])];
        for (const int other : graph_.neighbours(nodes[next])) {
          if (!seen[idx(other)]) nodes.push_back(other);
          seen[idx(other)] = true;
        }
      }
      std::sort(nodes.begin(), nodes.end());
      components.emplace_back(weight, std::move(nodes));
    }
    double heaviest = 0;
    for (const auto& component : components) heaviest = std::max(heaviest, component.first);
    if (heaviest > 0) {
      for (auto& component : components) {
        component.first = std::round(1e6 * component.first / heaviest);
      }
    }
    std::stable_sort(components.begin(), components.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::vector<int>> only_nodes;
    only_nodes.reserve(components.size());
    for (auto& component : components) only_nodes.push_back(std::move(component.second));
    return only_nodes;
  }

  /// Each after the one that it hangs from, the first one first.
  [[nodiscard]] std::vector<std::size_t> outwards(const std::vector<Hinge>& hinges) const {
    std::vector<std::size_t> component_of(mass_.size());
    for (std::size_t component = 0; component < components_.size(); ++component) {
      for (const int node : components_[component]) component_of[idx(node)] = component;
    }
    std::vector<std::vector<std::size_t>> below(components_.size());
    std::vector<std::size_t> order;
    for (std::size_t component = 0; component < components_.size(); ++component) {
      const int above = hinges[component].above;
      if (above < 0) order.push_back(component);
      if (above >= 0) below[component_of[idx(above)]].push_back(component);
    }
    for (std::size_t next = 0; next < order.size(); ++next) {
      const std::vector<std::size_t>& hanging = below[order[next]];
      order.insert(order.end(), hanging.begin(), hanging.end());
    }
    return order;
  }

  [[nodiscard]] int root_of(const std::vector<int>& nodes, bool others_hang_from_it) {
    std::vector<int> junctions;
    std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(junctions),
                 [this](int node) { return degree(node) >= 3; });
    if (junctions.empty() && others_hang_from_it) return middle_of(nodes);
    if (junctions.empty()) return end_of(nodes);
    keep_central(junctions, nodes);
    int best = junctions.front();
    double least = nowhere;
    for (const int junction : junctions) {
      walk(junction, {-1, -1});
      double sum = 0;
      for (const int node : nodes) sum += mass_[idx(node)] * paths_.distance(node);
      if (sum < least) {
        least = sum;
        best = junction;
      }
    }
    return best;
  }

  /// Of very many junctions only those nearest to the centre of mass are tried.
  void keep_central(std::vector<int>& junctions, const std::vector<int>& nodes) const {
    constexpr std::size_t most = 64;
    if (junctions.size() <= most) return;
    Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
    double all = 0;
    for (const int node : nodes) {
      centre += mass_[idx(node)] * skeleton_.nodes.row(node);
      all += mass_[idx(node)];
    }
    if (all > 0) centre /= all;
    const auto nearer = [&](int a, int b) {
      return (skeleton_.nodes.row(a) - centre).squaredNorm() <
             (skeleton_.nodes.row(b) - centre).squaredNorm();
    };
    std::stable_sort(junctions.begin(), junctions.end(), nearer);
    junctions.resize(most);
  }

  /// Of a chain the end with the larger ball, of a ring its thickest node.
  [[nodiscard]] int end_of(const std::vector<int>& nodes) const {
    const bool is_ring =
        std::all_of(nodes.begin(), nodes.end(), [this](int node) { return degree(node) == 2; });
    int best = -1;
    for (const int node : nodes) {
      const bool may_be = is_ring || degree(node) <= 1;
      if (may_be && (best < 0 || radius(node) > radius(best))) best = node;
    }
    return best;
  }

  /// Of a chain the node that has half of the mass before it, as a body with limbs of their own has
  /// no head and tail; of a ring its thickest node.
  [[nodiscard]] int middle_of(const std::vector<int>& nodes) {
    const auto is_end = [this](int node) { return degree(node) <= 1; };
    const auto end = std::find_if(nodes.begin(), nodes.end(), is_end);
    if (end == nodes.end()) return end_of(nodes);
    walk(*end, {-1, -1});
    std::vector<int> along = nodes;
    std::stable_sort(along.begin(), along.end(),
                     [this](int a, int b) { return paths_.distance(a) < paths_.distance(b); });
    const double all = std::accumulate(along.begin(), along.end(), 0.0,
                                       [this](double sum, int n) { return sum + mass_[idx(n)]; });
    double passed = 0;
    for (const int node : along) {
      passed += mass_[idx(node)];
      if (passed >= 0.5 * all) return node;
    }
    return along.back();
  }

  /// A ring is cut beside its root, so that it is one chain.
  [[nodiscard]] std::pair<int, int> cut_at(const std::vector<int>& nodes, int root) const {
    const bool is_ring =
        std::all_of(nodes.begin(), nodes.end(), [this](int node) { return degree(node) == 2; });
    if (!is_ring) return {-1, -1};
    return {root, graph_.neighbours(root).back()};
  }

  /// Shortest paths from the root without the edge `cut`.
  void walk(int root, std::pair<int, int> cut) {
    paths_.search(graph_, root, ShortestPaths::no_target, [&](int node, int other, int /*edge*/) {
      const bool is_cut =
          (node == cut.first && other == cut.second) || (node == cut.second && other == cut.first);
      return is_cut ? ShortestPaths::unreachable : length(node, other);
    });
  }

  const CurveSkeleton& skeleton_;
  Graph graph_;
  std::vector<double> mass_;  // by node: length times radius of what is nearest to it
  ShortestPaths paths_;       // from the root of the last walk
  int wanted_;
  std::vector<std::vector<int>> components_;
  std::unique_ptr<const HangingComponents> hanging_;
};

RootedTrees::RootedTrees(const CurveSkeleton& skeleton, int wanted, const std::vector<int>& ground)
    : rooting_(std::make_unique<Rooting>(skeleton, wanted, ground)) {}

RootedTrees::~RootedTrees() = default;

RootedTree RootedTrees::with_up(const Eigen::Vector3d& up) const { return rooting_->grow(up); }

Eigen::VectorXd usable_radii(const CurveSkeleton& skeleton) {
  const bool has_radii = skeleton.radii.size() > 0 && skeleton.radii.maxCoeff() > 0;
  if (has_radii) return skeleton.radii.cwiseMax(0.01 * skeleton.radii.maxCoeff());
  const double diagonal = bounding_box_diagonal(skeleton.nodes);
  return Eigen::VectorXd::Constant(skeleton.nodes.rows(), diagonal > 0 ? diagonal / 50 : 1);
}

RootedTree rooted_tree(const CurveSkeleton& skeleton, int wanted, const std::vector<int>& ground,
                       const Eigen::Vector3d& up) {
  return RootedTrees(skeleton, wanted, ground).with_up(up);
}

}  // namespace curveskel
