#include "skeleton/match/branch_pairs.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include <curveskel/advanced/indices.hpp>
#include "base/least_pairs.hpp"
#include "skeleton/match/branch_laying.hpp"

namespace curveskel {
namespace {

/// A branch as a division of the paired tips: a letter for each pair, which says whether the pair's
/// tip lies beyond the branch's end, before its start, or in another component.
struct Division {
  int branch;
  std::string sides;    ///< turned such that the first tip of the component lies before it
  bool turned = false;  ///< the sides were exchanged for that
  double length = 0;    ///< over the unit
};

constexpr char is_before = '-';
constexpr char is_beyond = '+';
constexpr char is_elsewhere = ' ';

/// One of a skeleton's two, with the numbers of its tips' pairs.
class Divider {
 public:
  Divider(const MatchSide& side, const TipFeatures& features, std::vector<int> pair_of_tip,
          std::size_t pairs)
      : side_(side),
        features_(features),
        pair_of_tip_(std::move(pair_of_tip)),
        pairs_(pairs),
        all_(branches(side.skeleton)) {}

  /// Of branches that divide paired tips; a branch on a cycle divides nothing.
  [[nodiscard]] std::vector<Division> divide() const {
    std::vector<Division> divisions;
    for (std::size_t b = 0; b < all_.size(); ++b) {
      const std::vector<int>& nodes = all_[b].nodes;
      std::vector<char> reached(idx(side_.skeleton.nodes.rows()), 0);
      if (nodes.front() == nodes.back() || reaches_start(nodes, reached)) continue;
      Division division{static_cast<int>(b), std::string(pairs_, is_elsewhere), false};
      const int component = features_.component[idx(nodes.front())];
      for (std::size_t tip = 0; tip < pair_of_tip_.size(); ++tip) {
        const int pair = pair_of_tip_[tip];
        const int node = features_.tips[tip];
        if (pair < 0 || features_.component[idx(node)] != component) continue;
        division.sides[idx(pair)] = reached[idx(node)] != 0 ? is_beyond : is_before;
      }
      if (division.sides.find(is_beyond) == std::string::npos ||
          division.sides.find(is_before) == std::string::npos) {
        continue;
      }
      turn(division);
      divisions.push_back(std::move(division));
    }
    return divisions;
  }

 private:
  /// Marks what is reached from the end without the branch; true if its start is.
  bool reaches_start(const std::vector<int>& nodes, std::vector<char>& reached) const {
    std::vector<int> open{nodes.back()};
    reached[idx(nodes.back())] = 1;
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      for (const int next : features_.graph.neighbours(node)) {
        const bool is_branch = node == nodes.back() && next == nodes[nodes.size() - 2];
        if (is_branch || reached[idx(next)] != 0) continue;
        reached[idx(next)] = 1;
        open.push_back(next);
      }
    }
    return reached[idx(nodes.front())] != 0;
  }

  static void turn(Division& division) {
    const std::size_t first = division.sides.find_first_not_of(is_elsewhere);
    if (division.sides[first] == is_before) return;
    division.turned = true;
    for (char& side : division.sides) {
      if (side != is_elsewhere) side = side == is_before ? is_beyond : is_before;
    }
  }

  const MatchSide& side_;
  const TipFeatures& features_;
  std::vector<int> pair_of_tip_;
  std::size_t pairs_;
  std::vector<Branch> all_;
};

/// By branch: its division of the tips, if it has one.
std::map<int, Division> divisions_of(const MatchSide& side, const TipFeatures& features,
                                     const std::vector<int>& pair_of_tip, std::size_t pairs) {
  std::map<int, Division> divisions;
  for (Division& one : Divider(side, features, pair_of_tip, pairs).divide()) {
    const int branch = one.branch;
    divisions.emplace(branch, std::move(one));
  }
  return divisions;
}

/// True if the start of one comes to lie nearer to the other's end.
bool runs_against(const MatchSide& a, const Branch& one, const MatchSide& b, const Branch& other,
                  const NodeMotions& motions) {
  const BranchCurve from = branch_curve(a.skeleton, one);
  const BranchCurve to = branch_curve(b.skeleton, other);
  if (from.closed && to.closed) return goes_round_against(one, from, to, motions);
  const auto moved = [&](std::size_t place) -> Eigen::Vector3d {
    const int node = one.nodes[place];
    return motions.of_node[idx(node)](a.skeleton.nodes.row(node));
  };
  const auto at = [&](std::size_t place) -> Eigen::Vector3d {
    return b.skeleton.nodes.row(other.nodes[place]);
  };
  const std::size_t last = one.nodes.size() - 1;
  const std::size_t end = other.nodes.size() - 1;
  return (moved(0) - at(end)).norm() + (moved(last) - at(0)).norm() <
         (moved(0) - at(0)).norm() + (moved(last) - at(end)).norm();
}

}  // namespace

std::vector<BranchPair> pair_branches(const MatchedBodies& bodies, const std::vector<int>& partner,
                                      const Eigen::MatrixXd& overlaps, const NodeMotions& motions) {
  const auto& [a, of_a, b, of_b, like, stop] = bodies;
  std::vector<int> pair_in_a(of_a.tips.size(), -1);
  std::vector<int> pair_in_b(of_b.tips.size(), -1);
  int tip_pairs = 0;
  for (std::size_t i = 0; i < partner.size(); ++i) {
    if (partner[i] < 0) continue;
    pair_in_b[idx(partner[i])] = tip_pairs;
    pair_in_a[i] = tip_pairs++;
  }
  const auto divisions_a = divisions_of(a, of_a, pair_in_a, idx(tip_pairs));
  const auto divisions_b = divisions_of(b, of_b, pair_in_b, idx(tip_pairs));
  // The same division alone is enough, as half of the area is; both are best.
  constexpr double enough = 0.5;
  Eigen::MatrixXd costs = -overlaps;
  for (const auto& [i, one] : divisions_a) {
    for (const auto& [k, other] : divisions_b) {
      if (one.sides == other.sides) costs(i, k) -= enough;
    }
  }
  const std::vector<int> best = least_pairs(costs, stop);
  const std::vector<Branch> all_a = branches(a.skeleton);
  const std::vector<Branch> all_b = branches(b.skeleton);
  std::vector<BranchPair> pairs;
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (best[i] < 0 || costs(static_cast<Eigen::Index>(i), best[i]) > -enough) continue;
    const auto mine = divisions_a.find(static_cast<int>(i));
    const auto theirs = divisions_b.find(best[i]);
    const bool divided = mine != divisions_a.end() && theirs != divisions_b.end() &&
                         mine->second.sides == theirs->second.sides;
    const bool reversed = divided ? mine->second.turned != theirs->second.turned
                                  : runs_against(a, all_a[i], b, all_b[idx(best[i])], motions);
    pairs.push_back({static_cast<int>(i), best[i], reversed, false});
  }
  return pairs;
}

std::vector<std::pair<int, int>> pair_junctions(const MatchSide& a, const MatchSide& b,
                                                const std::vector<BranchPair>& branch_pairs) {
  const std::vector<Branch> of_a = branches(a.skeleton);
  const std::vector<Branch> of_b = branches(b.skeleton);
  std::map<std::pair<int, int>, int> votes;
  for (const BranchPair& pair : branch_pairs) {
    const std::vector<int>& nodes_a = of_a[idx(pair.a)].nodes;
    const std::vector<int>& nodes_b = of_b[idx(pair.b)].nodes;
    ++votes[{nodes_a.front(), pair.reversed ? nodes_b.back() : nodes_b.front()}];
    ++votes[{nodes_a.back(), pair.reversed ? nodes_b.front() : nodes_b.back()}];
  }
  const std::vector<int> degree_a = degrees(a.skeleton.nodes.rows(), a.skeleton.edges);
  const std::vector<int> degree_b = degrees(b.skeleton.nodes.rows(), b.skeleton.edges);
  std::vector<std::tuple<int, int, int>> order;  // most votes first
  for (const auto& [nodes, count] : votes) {
    if (count < 2 || degree_a[idx(nodes.first)] < 3 || degree_b[idx(nodes.second)] < 3) continue;
    order.emplace_back(-count, nodes.first, nodes.second);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::pair<int, int>> pairs;
  for (const auto& [count, in_a, in_b] : order) {
    const bool taken = std::any_of(pairs.begin(), pairs.end(), [&, j = in_a, k = in_b](auto pair) {
      return pair.first == j || pair.second == k;
    });
    if (!taken) pairs.emplace_back(in_a, in_b);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace curveskel
