#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/plan/curve_tree.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// The way from a tip to another one.
struct Between {
  std::vector<int> path;
  std::vector<double> way;      // up to each node
  std::vector<double> hanging;  // length of the curve that hangs from each node beside the path

  [[nodiscard]] double length() const { return way.back(); }
  [[nodiscard]] double middle() const { return 0.5 * way.back(); }
};

class ShapePairs {
 public:
  explicit ShapePairs(const CurveTree& tree)
      : tree_(tree), from_first_(ways_from(tree, 0)), side_(tree.nodes.size(), 0) {
    weigh();
  }

  /// The longest first: fingers after arms, on which they then lie opposite each other.
  TipPairs find() {
    for (const auto& [worth, left, right] : candidates()) {
      if (side_[idx(left)] != 0 || side_[idx(right)] != 0) continue;
      const Between between = between_tips(left, right);
      if (leaves_opposite_sides(between)) accept(between);
    }
    if (!found_.ends.empty()) add_tips_of_trunk();
    return std::move(found_);
  }

 private:
  /// The length of the curve below each node, as seen from the first one.
  void weigh() {
    std::vector<int> order(tree_.nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return std::pair(-from_first_.distance[idx(a)], a) <
             std::pair(-from_first_.distance[idx(b)], b);
    });
    below_.assign(tree_.nodes.size(), 0);
    for (const int node : order) {
      const int before = from_first_.before[idx(node)];
      if (before < 0) continue;
      below_[idx(node)] += (tree_.nodes[idx(node)] - tree_.nodes[idx(before)]).norm();
      below_[idx(before)] += below_[idx(node)];
    }
  }

  /// The length of the curve that hangs from a node by way of a neighbour.
  [[nodiscard]] double length_beyond(int node, int next) const {
    return from_first_.before[idx(next)] == node ? below_[idx(next)]
                                                 : below_.front() - below_[idx(node)];
  }

  /// Worth, left and right: the best first.
  [[nodiscard]] std::vector<std::tuple<double, int, int>> candidates() const {
    constexpr std::size_t most_paired = 200;  // of a body; their pairs are looked at one by one
    const std::vector<int> tips = tips_of(tree_);
    std::vector<std::tuple<double, int, int>> found;
    if (tips.size() > most_paired) return found;
    for (std::size_t a = 0; a < tips.size(); ++a) {
      for (std::size_t b = a + 1; b < tips.size(); ++b) {
        const Between between = between_tips(tips[a], tips[b]);
        const int side = side_of_first(between);
        if (side == 0) continue;
        const double unlike = unlikeness(between);
        if (unlike > most_unlike) continue;
        const auto [left, right] =
            side > 0 ? std::pair(tips[a], tips[b]) : std::pair(tips[b], tips[a]);
        found.emplace_back(-between.length() * (1 - unlike), left, right);
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  [[nodiscard]] Between between_tips(int a, int b) const {
    Between between;
    between.path = from_first_.between(a, b);
    double way = 0;
    for (std::size_t k = 0; k < between.path.size(); ++k) {
      const int node = between.path[k];
      if (k > 0) way += (tree_.nodes[idx(node)] - tree_.nodes[idx(between.path[k - 1])]).norm();
      double hanging = 0;
      for (const int next : tree_.neighbours[idx(node)]) {
        const bool is_before = k > 0 && next == between.path[k - 1];
        const bool is_after = k + 1 < between.path.size() && next == between.path[k + 1];
        if (!is_before && !is_after) hanging += length_beyond(node, next);
      }
      between.way.push_back(way);
      between.hanging.push_back(hanging);
    }
    return between;
  }

  /// Places of both halves that are as far from the middle, from `from` of a half's length on.
  template <typename Visit>
  void for_both_halves(const Between& between, double from, double to, const Visit& visit) const {
    constexpr int samples = 32;
    std::size_t first = between.path.size() - 1;
    std::size_t last = 0;
    for (int k = 0; k < samples; ++k) {
      const double off = between.middle() * (from + (to - from) * (k + 0.5) / samples);
      while (first > 0 && between.way[first] > between.middle() - off) --first;
      while (last + 1 < between.path.size() && between.way[last] < between.middle() + off) ++last;
      visit(between.path[first], between.path[last]);
    }
  }

  /// 1 if the half with the first tip leaves the middle to the left of the other one, -1 if to its
  /// right, 0 if they lie rather before or above each other. Of their first third: beyond it a leg
  /// may be ahead of the other.
  [[nodiscard]] int side_of_first(const Between& between) const {
    double aside = 0;
    double otherwise = 0;
    for_both_halves(between, 0, 1.0 / 3, [&](int a, int b) {
      const Vector3d apart = tree_.nodes[idx(a)] - tree_.nodes[idx(b)];
      aside += apart.x();
      otherwise += std::hypot(apart.y(), apart.z());
    });
    if (std::abs(aside) <= otherwise) return 0;
    return aside > 0 ? 1 : -1;
  }

  /// How unlike the halves are: their radii, and where the rest of the curve hangs from them. 0 for
  /// mirror images, 1 where one of them has nothing of the other.
  [[nodiscard]] double unlikeness(const Between& between) const {
    double moment = 0;
    double all = 0;
    for (std::size_t k = 0; k < between.path.size(); ++k) {
      moment += between.hanging[k] * (between.way[k] - between.middle());
      all += between.hanging[k] * between.middle();
    }
    double differ = 0;
    double both = 0;
    for_both_halves(between, 0, 1, [&](int a, int b) {
      differ += std::abs(tree_.radii[idx(a)] - tree_.radii[idx(b)]);
      both += tree_.radii[idx(a)] + tree_.radii[idx(b)];
    });
    return std::max(both > 0 ? differ / both : 1, all > 0 ? std::abs(moment) / all : 0);
  }

  /// Of the trunk: where most of the rest hangs, near the middle.
  [[nodiscard]] std::size_t crossing(const Between& between) const {
    std::size_t best = 0;
    std::pair<double, double> most{-1, 0};
    for (std::size_t k = 0; k < between.path.size(); ++k) {
      const double off = std::abs(between.way[k] - between.middle());
      const bool is_near = off <= most_unlike * between.middle();
      const std::pair<double, double> worth{is_near ? between.hanging[k] : -1.0, -off};
      if (k > 0 && worth <= most) continue;
      most = worth;
      best = k;
    }
    return best;
  }

  /// True for what leaves a left limb and the right one, or the trunk twice.
  [[nodiscard]] bool leaves_opposite_sides(const Between& between) const {
    int first = 0;
    int last = 0;
    for (const int node : between.path) {
      if (side_[idx(node)] == 0) continue;
      if (first == 0) first = side_[idx(node)];
      last = side_[idx(node)];
    }
    return (first == 0 && last == 0) || (first > 0 && last < 0);
  }

  void accept(const Between& between) {
    const std::size_t middle = crossing(between);
    found_.mate[between.path.front()] = between.path.back();
    found_.ends.push_back(between.path[middle]);
    for (std::size_t k = 0; k < between.path.size(); ++k) {
      int& side = side_[idx(between.path[k])];
      if (k != middle && side == 0) side = k < middle ? 1 : -1;
    }
  }

  /// Head and tail: of what hangs from the trunk and has no pair the two that reach farthest.
  void add_tips_of_trunk() {
    const Ways ways = ways_from(tree_, found_.ends.front());
    std::vector<char> seen(tree_.nodes.size(), 0);
    for (const int end : found_.ends) {
      for (const int node : ways.path(end)) seen[idx(node)] = 1;
    }
    std::vector<std::pair<double, int>> tips;  // minus the length from the trunk on
    for (int first = 0; first < static_cast<int>(tree_.nodes.size()); ++first) {
      if (seen[idx(first)] != 0) continue;
      int nearest = first;
      int farthest = first;
      bool has_pair = false;
      for (const int node : part_of(tree_, first, seen)) {
        has_pair = has_pair || side_[idx(node)] != 0;
        if (ways.distance[idx(node)] > ways.distance[idx(farthest)]) farthest = node;
        if (ways.distance[idx(node)] < ways.distance[idx(nearest)]) nearest = node;
      }
      const double length = ways.distance[idx(farthest)] - ways.distance[idx(nearest)];
      if (!has_pair) tips.emplace_back(-length, farthest);
    }
    std::sort(tips.begin(), tips.end());
    for (std::size_t k = 0; k < std::min<std::size_t>(tips.size(), 2); ++k) {
      found_.ends.push_back(tips[k].second);
    }
  }

  const CurveTree& tree_;
  Ways from_first_;
  std::vector<double> below_;
  std::vector<int> side_;  // by node: 1 on a left limb, -1 on a right one
  TipPairs found_;
};

}  // namespace

TipPairs pairs_by_shape(const CurveTree& tree) {
  return tree.nodes.empty() ? TipPairs{} : ShapePairs(tree).find();
}

}  // namespace curveskel
