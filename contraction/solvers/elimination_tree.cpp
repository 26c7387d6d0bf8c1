#include "contraction/solvers/elimination_tree.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"

namespace curveskel {
namespace {

constexpr int few_unknowns = 24;        // are eliminated at once: less to keep account of
constexpr int fewest_in_subtree = 256;  // so that one is worth a thread's coming
constexpr int subtrees_wanted = 16;

/// A stretch of the order that is still to be split.
struct Domain {
  int node = 0;  // of the tree as it grows, the root first
  int first = 0;
  int end = 0;
  int start = 0;      // an unknown to search from
  int lower_end = 0;  // after the split: [first, lower_end), [lower_end, upper_end), the separator
  int upper_end = 0;
  [[nodiscard]] int size() const { return end - first; }
};

class Dissection {
 public:
  explicit Dissection(const SparseMatrix& h)
      : h_(h),
        order_(idx(h.cols())),
        queue_(order_.size()),
        domain_(order_.size(), 0),
        level_(order_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
  }

  EliminationTree run(int threads) {
    const int all = static_cast<int>(order_.size());
    const int first_hub = hubs_to_the_end();
    nodes_.push_back({0, first_hub, all, -1, {}});
    std::vector<Domain> domains;
    if (first_hub > 0 && first_hub < all) {
      nodes_.push_back({0, 0, first_hub, 0, {}});
      for (int i = 0; i < first_hub; ++i) domain_[idx(order_[idx(i)])] = 1;
      for (int i = first_hub; i < all; ++i) domain_[idx(order_[idx(i)])] = -1;
      domains.push_back({1, 0, first_hub, far_unknown(1, first_hub), 0, 0});
    } else if (all > 0) {
      nodes_.back().pivots = 0;
      domains.push_back({0, 0, all, far_unknown(0, all), 0, 0});
    }
    while (!domains.empty()) {
      parallel_for(domains.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) split(domains[i]);
      });
      domains = next_domains(domains);
    }
    return in_postorder();
  }

 private:
  [[nodiscard]] std::span<const int> neighbours(int v) const {
    const int* outer = h_.outerIndexPtr() + v;
    return {h_.innerIndexPtr() + outer[0], h_.innerIndexPtr() + outer[1]};
  }

  /// Of an unknown that may be of a domain that another thread splits at the same time.
  [[nodiscard]] int level(int v) { return std::atomic_ref(level_[idx(v)]).load(relaxed); }
  void set_level(int v, int value) { std::atomic_ref(level_[idx(v)]).store(value, relaxed); }

  /// The level of what a search has yet to find tells the domains apart.
  [[nodiscard]] static int unseen(int node) { return -1 - node; }

  /// Breadth first from the unknown `start`; fills the queue from `tail` on, returns its end.
  int search(int start, int tail, int node) {
    int head = tail;
    queue_[idx(tail++)] = start;
    set_level(start, 0);
    for (; head < tail; ++head) {
      const int next = level(queue_[idx(head)]) + 1;
      for (const int u : neighbours(queue_[idx(head)])) {
        if (level(u) != unseen(node)) continue;
        set_level(u, next);
        queue_[idx(tail++)] = u;
      }
    }
    return tail;
  }

  /// Moves the hubs to the end of the order, the others keep theirs; the place of the first hub.
  int hubs_to_the_end() {
    const double most = 10 * std::sqrt(static_cast<double>(order_.size()));
    const auto first = std::stable_partition(order_.begin(), order_.end(), [&](int v) -> bool {
      return static_cast<double>(neighbours(v).size()) <= most;
    });
    return static_cast<int>(first - order_.begin());
  }

  /// Of the unknowns at [0, end), those of the first node to be split.
  int far_unknown(int node, int end) {
    for (int i = 0; i < end; ++i) level_[idx(order_[idx(i)])] = unseen(node);
    return queue_[idx(search(order_[0], 0, node) - 1)];
  }

  void split(Domain& domain) {
    domain.lower_end = domain.upper_end = domain.first;
    if (domain.size() <= few_unknowns) return;
    for (int i = domain.first; i < domain.end; ++i) set_level(order_[idx(i)], unseen(domain.node));
    const int tail = search(domain.start, domain.first, domain.node);
    if (tail < domain.end) {
      split_apart(domain, tail);
    } else {
      split_at_level(domain);
    }
  }

  /// Whole connected parts until half of the unknowns are there; no separator.
  void split_apart(Domain& domain, int tail) {
    domain.lower_end = tail;
    for (int i = domain.first; 2 * (tail - domain.first) < domain.size(); ++i) {
      if (level(order_[idx(i)]) >= 0) continue;
      domain.lower_end = tail;
      tail = search(order_[idx(i)], tail, domain.node);
    }
    if (tail < domain.end) domain.lower_end = tail;
    domain.upper_end = domain.end;
    for (int i = domain.first; i < domain.end; ++i) {
      if (level(order_[idx(i)]) < 0) queue_[idx(tail++)] = order_[idx(i)];
    }
    std::copy(queue_.begin() + domain.first, queue_.begin() + domain.end,
              order_.begin() + domain.first);
  }

  /// The smallest level with a quarter of the unknowns on either side, or else the middle one.
  void split_at_level(Domain& domain) {
    const auto level_at = [&](int i) { return level(queue_[idx(i)]); };
    if (level_at(domain.end - 1) < 2) return;  // as good as all joined to all
    int best_begin = 0;
    int best_end = 0;
    bool best_fair = false;
    for (int begin = domain.first, end = begin; begin < domain.end; begin = end) {
      while (end < domain.end && level_at(end) == level_at(begin)) ++end;
      const int below = begin - domain.first;
      const int above = domain.end - end;
      if (below == 0 || above == 0) continue;
      const bool fair = 4 * std::min(below, above) >= domain.size();
      const bool middle = 2 * below <= domain.size() && 2 * above <= domain.size();
      if (fair ? !best_fair || end - begin < best_end - best_begin
               : !best_fair && (middle || best_end == 0)) {
        best_begin = begin;
        best_end = end;
        best_fair = fair;
      }
    }
    arrange(domain, best_begin, best_end);
  }

  /// In this order: the vertices before the level [begin, end) of the queue, with those of the
  /// level that have no neighbour beyond it; the vertices after it; the rest of the level.
  void arrange(Domain& domain, int begin, int end) {
    const int beyond = level(queue_[idx(begin)]) + 1;
    int lower = begin;
    std::copy(queue_.begin() + domain.first, queue_.begin() + begin, order_.begin() + domain.first);
    std::vector<int> separator;
    for (int i = begin; i < end; ++i) {
      const std::span<const int> around = neighbours(queue_[idx(i)]);
      const bool joins = std::any_of(around.begin(), around.end(), [&](int u) {
        return domain_[idx(u)] == domain.node && level(u) == beyond;
      });
      if (joins) {
        separator.push_back(queue_[idx(i)]);
      } else {
        order_[idx(lower++)] = queue_[idx(i)];
      }
    }
    std::copy(queue_.begin() + end, queue_.begin() + domain.end, order_.begin() + lower);
    domain.lower_end = lower;
    domain.upper_end = lower + domain.end - end;
    std::copy(separator.begin(), separator.end(), order_.begin() + domain.upper_end);
  }

  std::vector<Domain> next_domains(const std::vector<Domain>& domains) {
    std::vector<Domain> next;
    const auto add = [&](int parent, int first, int end, int start) {
      const int node = static_cast<int>(nodes_.size());
      nodes_.push_back({first, first, end, parent, {}});
      next.push_back({node, first, end, order_[idx(start)], 0, 0});
      for (int i = first; i < end; ++i) domain_[idx(order_[idx(i)])] = node;
    };
    for (const Domain& domain : domains) {
      if (domain.upper_end == domain.first) continue;  // left whole
      nodes_[idx(domain.node)].pivots = domain.upper_end;
      // From beside the separator: levels then run across the last ones.
      add(domain.node, domain.first, domain.lower_end, domain.lower_end - 1);
      add(domain.node, domain.lower_end, domain.upper_end, domain.lower_end);
      for (int i = domain.upper_end; i < domain.end; ++i) domain_[idx(order_[idx(i)])] = -1;
    }
    return next;
  }

  EliminationTree in_postorder() {
    EliminationTree tree;
    std::vector<int> by_end(nodes_.size());
    std::iota(by_end.begin(), by_end.end(), 0);
    // Of two that end at one place the inner one was made later.
    std::sort(by_end.begin(), by_end.end(), [&](int a, int b) {
      return nodes_[idx(a)].end != nodes_[idx(b)].end ? nodes_[idx(a)].end < nodes_[idx(b)].end
                                                      : a > b;
    });
    std::vector<int> number(nodes_.size());
    for (std::size_t i = 0; i < by_end.size(); ++i) number[idx(by_end[i])] = static_cast<int>(i);
    tree.children.resize(nodes_.size());
    for (const int node : by_end) {
      tree.nodes.push_back(std::move(nodes_[idx(node)]));
      int& parent = tree.nodes.back().parent;
      if (parent < 0) continue;
      parent = number[idx(parent)];
      tree.children[idx(parent)].push_back(number[idx(node)]);
    }
    tree.place_of.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      tree.place_of[idx(order_[i])] = static_cast<int>(i);
    }
    tree.unknown_at = std::move(order_);
    return tree;
  }

  static constexpr auto relaxed = std::memory_order_relaxed;

  const SparseMatrix& h_;
  std::vector<int> order_;
  std::vector<int> queue_;
  std::vector<int> domain_;  // per unknown: its node, -1 = of a separator
  std::vector<int> level_;   // per unknown
  std::vector<EliminationNode> nodes_;
};

/// Subtrees of about a share of the unknowns each, and what is above them.
void schedule(EliminationTree& tree) {
  const int all = static_cast<int>(tree.unknown_at.size());
  const int most = std::max(all / subtrees_wanted, fewest_in_subtree);
  const auto small = [&](const EliminationNode& node) { return node.end - node.first <= most; };
  std::vector<int> round(tree.nodes.size(), -1);
  std::vector<int> members;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const EliminationNode& node = tree.nodes[i];
    if (small(node)) {
      members.push_back(static_cast<int>(i));
      if (node.parent >= 0 && small(tree.nodes[idx(node.parent)])) continue;
      tree.subtrees.push_back(std::exchange(members, {}));
    } else {
      int above = 0;
      for (const int child : tree.children[i]) above = std::max(above, round[idx(child)] + 1);
      round[i] = above;
      if (tree.rounds.size() <= idx(above)) tree.rounds.resize(idx(above) + 1);
      tree.rounds[idx(above)].push_back(static_cast<int>(i));
    }
  }
}

std::vector<int> border_of(const SparseMatrix& h, const EliminationTree& tree, int number) {
  const EliminationNode& node = tree.nodes[idx(number)];
  std::vector<int> border;
  for (const int child : tree.children[idx(number)]) {
    const std::vector<int>& below = tree.nodes[idx(child)].border;
    border.insert(border.end(), std::lower_bound(below.begin(), below.end(), node.end),
                  below.end());
  }
  for (int place = node.pivots; place < node.end; ++place) {
    const int v = tree.unknown_at[idx(place)];
    for (int k = h.outerIndexPtr()[v]; k < h.outerIndexPtr()[v + 1]; ++k) {
      const int other = tree.place_of[idx(h.innerIndexPtr()[k])];
      if (other >= node.end) border.push_back(other);
    }
  }
  std::sort(border.begin(), border.end());
  border.erase(std::unique(border.begin(), border.end()), border.end());
  return border;
}

}  // namespace

void EliminationTree::visit(int threads, const std::function<void(int node)>& visit_node) const {
  parallel_for(subtrees.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (const int node : subtrees[i]) visit_node(node);
    }
  });
  for (const std::vector<int>& round : rounds) {
    parallel_for(round.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) visit_node(round[i]);
    });
  }
}

EliminationTree dissect(const SparseMatrix& h, int threads) {
  EliminationTree tree = Dissection(h).run(threads);
  schedule(tree);
  tree.visit(threads, [&](int node) { tree.nodes[idx(node)].border = border_of(h, tree, node); });
  return tree;
}

}  // namespace curveskel
