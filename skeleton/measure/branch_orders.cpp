// A. N. Strahler, Quantitative analysis of watershed geomorphology, 1957.
#include "skeleton/measure/branch_orders.hpp"

#include <algorithm>
#include <map>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

/// The root of each component.
std::vector<int> roots_of(const CurveSkeleton& skeleton, int chosen) {
  const std::vector<int> component = component_of_node(skeleton);
  std::map<int, int> roots;
  for (int node = 0; node < skeleton.nodes.rows(); ++node) {
    const auto [known, added] = roots.emplace(component[idx(node)], node);
    const bool thicker =
        skeleton.radii.size() > 0 && skeleton.radii[node] > skeleton.radii[known->second];
    if (!added && thicker) known->second = node;
  }
  if (chosen >= 0) roots[component[idx(chosen)]] = chosen;
  std::vector<int> nodes;
  nodes.reserve(roots.size());
  for (const auto& [number, node] : roots) nodes.push_back(node);
  return nodes;
}

/// Branches breadth first from the roots.
class Walk {
 public:
  Walk(const CurveSkeleton& skeleton, const std::vector<Branch>& all)
      : all_(all),
        at_node_(idx(skeleton.nodes.rows())),
        inner_of_(idx(skeleton.nodes.rows()), -1),
        reached_(idx(skeleton.nodes.rows()), false),
        orders_{std::vector<int>(all.size(), 0), std::vector<int>(all.size(), 0)},
        beyond_(all.size()) {
    for (std::size_t b = 0; b < all.size(); ++b) {
      const std::vector<int>& nodes = all[b].nodes;
      for (std::size_t k = 1; k + 1 < nodes.size(); ++k) inner_of_[idx(nodes[k])] = int(b);
      at_node_[idx(nodes.front())].push_back(static_cast<int>(b));
      if (nodes.back() != nodes.front()) at_node_[idx(nodes.back())].push_back(static_cast<int>(b));
    }
  }

  void from(int root) {
    order_.clear();
    has_cycles_ = false;
    std::vector<Arrival> arrivals;
    const int own = inner_of_[idx(root)];
    if (own >= 0) {
      visit(own, 1);
      arrive(all_[idx(own)].nodes.front(), own, arrivals);
      if (all_[idx(own)].nodes.back() != all_[idx(own)].nodes.front()) {
        arrive(all_[idx(own)].nodes.back(), own, arrivals);
      } else {
        has_cycles_ = true;
      }
    } else {
      arrive(root, -1, arrivals);
    }
    for (std::size_t next = 0; next < arrivals.size(); ++next) leave(arrivals[next], arrivals);
    if (!has_cycles_) count_streams();
  }

  BranchOrders take() { return std::move(orders_); }

 private:
  /// At a node, by way of a branch; -1 = the walk began there.
  struct Arrival {
    int node;
    int by;
  };

  void visit(int branch, int order) {
    orders_.centrifugal[idx(branch)] = order;
    order_.push_back(branch);
  }

  void arrive(int node, int by, std::vector<Arrival>& arrivals) {
    if (reached_[idx(node)]) {
      has_cycles_ = true;
      return;
    }
    reached_[idx(node)] = true;
    arrivals.push_back({node, by});
  }

  void leave(Arrival arrival, std::vector<Arrival>& arrivals) {
    const int before = arrival.by < 0 ? 0 : orders_.centrifugal[idx(arrival.by)];
    for (const int branch : at_node_[idx(arrival.node)]) {
      if (orders_.centrifugal[idx(branch)] > 0) continue;
      visit(branch, before + 1);
      if (arrival.by >= 0) beyond_[idx(arrival.by)].push_back(branch);
      const std::vector<int>& nodes = all_[idx(branch)].nodes;
      arrive(nodes.front() == arrival.node ? nodes.back() : nodes.front(), branch, arrivals);
    }
  }

  /// Branches that hang from one come after it.
  void count_streams() {
    for (std::size_t k = order_.size(); k-- > 0;) {
      int most = 0;
      int number = 0;
      for (const int child : beyond_[idx(order_[k])]) {
        const int order = orders_.strahler[idx(child)];
        if (order > most) number = 0;
        most = std::max(most, order);
        number += order == most ? 1 : 0;
      }
      orders_.strahler[idx(order_[k])] = most == 0 ? 1 : most + (number >= 2 ? 1 : 0);
    }
  }

  const std::vector<Branch>& all_;
  std::vector<std::vector<int>> at_node_;  ///< branches that end there
  std::vector<int> inner_of_;              ///< the branch that a node of degree 2 is within
  std::vector<bool> reached_;
  std::vector<int> order_;  ///< of the component's branches, as they were visited
  bool has_cycles_ = false;
  BranchOrders orders_;
  std::vector<std::vector<int>> beyond_;  ///< of each branch those that are reached by way of it
};

}  // namespace

BranchOrders branch_orders(const CurveSkeleton& skeleton, const std::vector<Branch>& all,
                           int root) {
  Walk walk(skeleton, all);
  for (const int node : roots_of(skeleton, root)) walk.from(node);
  return walk.take();
}

}  // namespace curveskel
