#include "skeleton/match/tip_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/monitor.hpp>
#include "base/least_pairs.hpp"

namespace curveskel {
namespace {

struct Candidate {
  int a;
  int b;
  double own;    ///< log of likeness and of how near the moved tip comes
  double share;  ///< 0..1, of the assignment
  double score;  ///< log
};

/// The same tip, moved, lies within a twentieth of the size, most likely.
constexpr double place_scale = 0.05;

Eigen::Matrix3Xd tips_of(const MatchSide& side, const TipFeatures& features) {
  return side.skeleton.nodes(features.tips, Eigen::all).transpose();
}

Eigen::Matrix3Xd moved_tips(const MatchSide& side, const TipFeatures& features,
                            const NodeMotions& motions) {
  Eigen::Matrix3Xd places = tips_of(side, features);
  for (std::size_t tip = 0; tip < features.tips.size(); ++tip) {
    const Eigen::Vector3d at = places.col(static_cast<Eigen::Index>(tip));
    places.col(static_cast<Eigen::Index>(tip)) = motions.of_node[idx(features.tips[tip])](at);
  }
  return places;
}

/// Places are over b's unit.
std::vector<Candidate> candidates_of(const TipFeatures& a, const TipFeatures& b,
                                     const Eigen::MatrixXd& like, const Eigen::Matrix3Xd& places_a,
                                     const Eigen::Matrix3Xd& places_b,
                                     const std::vector<int>& component_pairs) {
  constexpr std::size_t most = 16;
  std::vector<Candidate> all;
  for (int i = 0; i < static_cast<int>(a.tips.size()); ++i) {
    std::vector<Candidate> row;
    const int component = component_pairs[idx(a.component[idx(a.tips[idx(i)])])];
    for (int j = 0; j < static_cast<int>(b.tips.size()); ++j) {
      if (b.component[idx(b.tips[idx(j)])] != component) continue;
      const double off = (places_b.col(j) - places_a.col(i)).norm() / place_scale;
      // A motion that was lost on the way to the tip says nothing of where the tip is.
      const double own = std::log(1e-4 + like(i, j)) + std::log(0.02 + std::exp(-0.5 * off * off));
      row.push_back({i, j, own, 0, own});
    }
    std::stable_sort(row.begin(), row.end(),
                     [](const Candidate& x, const Candidate& y) { return x.own > y.own; });
    if (row.size() > most) row.resize(most);
    all.insert(all.end(), row.begin(), row.end());
  }
  return all;
}

/// Rows and columns that sum to one at most: what is left of each is for no partner.
void normalise(std::vector<Candidate>& candidates, std::size_t rows, std::size_t columns,
               double temperature) {
  // A pair as good as this is as good as none.
  constexpr double none = -6;
  double top = none;
  for (const Candidate& one : candidates) top = std::max(top, one.score);
  for (Candidate& one : candidates) one.share = std::exp((one.score - top) / temperature);
  const double alone = std::exp((none - top) / temperature);
  for (int round = 0; round < 30; ++round) {
    std::vector<double> row(rows, alone);
    for (const Candidate& one : candidates) row[idx(one.a)] += one.share;
    for (Candidate& one : candidates) one.share /= row[idx(one.a)];
    std::vector<double> column(columns, alone);
    for (const Candidate& one : candidates) column[idx(one.b)] += one.share;
    for (Candidate& one : candidates) one.share /= column[idx(one.b)];
  }
}

/// Of each component of a the candidates of its tips.
std::vector<std::vector<std::size_t>> by_component(const std::vector<Candidate>& candidates,
                                                   const TipFeatures& a) {
  std::vector<std::vector<std::size_t>> numbers(a.middle.size());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    numbers[idx(a.component[idx(a.tips[idx(candidates[k].a)])])].push_back(k);
  }
  return numbers;
}

/// 0..1: the other pairs of the component, by their shares, that are as far from this in a as in b.
double support(const Candidate& one, const std::vector<Candidate>& candidates,
               const std::vector<std::size_t>& of_component, const TipFeatures& a,
               const TipFeatures& b) {
  double agreed = 0;
  double all = 0;
  for (const std::size_t k : of_component) {
    const Candidate& other = candidates[k];
    if (other.a == one.a || other.b == one.b || other.share < 1e-6) continue;
    const double in_a = a.apart(one.a, other.a);
    const double in_b = b.apart(one.b, other.b);
    const double off = (in_a - in_b) / (0.03 + 0.1 * std::min(in_a, in_b));
    agreed += other.share * std::exp(-0.5 * off * off);
    all += other.share;
  }
  return all > 0 ? agreed / all : 1;
}

}  // namespace

std::vector<int> pair_tips(const MatchedBodies& bodies, const NodeMotions& motions,
                           const std::vector<int>& component_pairs) {
  const auto& [a, of_a, b, of_b, like, stop] = bodies;
  std::vector<int> partner(of_a.tips.size(), -1);
  if (of_a.tips.empty() || of_b.tips.empty()) return partner;
  std::vector<Candidate> candidates =
      candidates_of(of_a, of_b, like, moved_tips(a, of_a, motions) / of_b.unit,
                    tips_of(b, of_b) / of_b.unit, component_pairs);
  const auto of_components = by_component(candidates, of_a);
  constexpr int rounds = 16;
  for (int round = 0; round < rounds; ++round) {
    const double temperature = 1.5 * std::pow(0.85, round);
    normalise(candidates, of_a.tips.size(), of_b.tips.size(), temperature);
    std::vector<double> scores(candidates.size());
    for (const std::vector<std::size_t>& numbers : of_components) {
      throw_if_stopped(stop);
      for (const std::size_t k : numbers) {
        const double agreed = support(candidates[k], candidates, numbers, of_a, of_b);
        scores[k] = candidates[k].own + 4 * std::log(0.02 + agreed);
      }
    }
    for (std::size_t k = 0; k < candidates.size(); ++k) candidates[k].score = scores[k];
  }
  // Worse than the worst that a pair can be and still is one.
  constexpr double no_pair = 1e3;
  constexpr double least_score = -8;
  Eigen::MatrixXd costs =
      Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(of_a.tips.size()),
                                static_cast<Eigen::Index>(of_b.tips.size()), no_pair);
  for (const Candidate& one : candidates) costs(one.a, one.b) = -one.score;
  const std::vector<int> pairs = least_pairs(costs, stop);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i] < 0) continue;
    if (costs(static_cast<Eigen::Index>(i), pairs[i]) < -least_score) partner[i] = pairs[i];
  }
  return partner;
}

}  // namespace curveskel
