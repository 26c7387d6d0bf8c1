#include <curveskel/match.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/branch_measures.hpp>
#include <curveskel/branch_territories.hpp>
#include "base/parallel.hpp"
#include "skeleton/match/branch_overlaps.hpp"
#include "skeleton/match/branch_pairs.hpp"
#include "skeleton/match/component_pairs.hpp"
#include "skeleton/match/core_alignment.hpp"
#include "skeleton/match/motions.hpp"
#include "skeleton/match/part_seats.hpp"
#include "skeleton/match/tip_pairs.hpp"
#include "skeleton/match/tips.hpp"
#include "skeleton/match/vertex_pairs.hpp"

namespace curveskel {
namespace {

/// A fit within a fifth, or within a thousandth of the size, is as good.
constexpr double as_good = 1.2;
constexpr double as_near = 1e-3;

constexpr std::size_t most_alignments = 3;

/// By alignment: how a might have become b.
std::vector<NodeMotions> follow_cores(const MatchSide& a, const TipFeatures& of_a,
                                      const SurfaceTree& tree_b,
                                      const std::vector<CoreAlignment>& alignments, int threads,
                                      const Monitor& monitor) {
  std::vector<NodeMotions> hypotheses(alignments.size());
  monitor.report("match", 0.3);
  parallel_for(hypotheses.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      hypotheses[k] = follow_motions(a, of_a, tree_b, alignments[k].motion);
    }
  });
  return hypotheses;
}

/// The same body keeps its size, whatever it has lost; another of its kind has that of its area.
std::vector<double> scales_between(const TipFeatures& a, const TipFeatures& b) {
  constexpr double as_large = 0.02;
  const double ratio = b.unit / a.unit;
  if (std::abs(ratio - 1) < as_large || std::abs(std::log(ratio)) > std::log(1.5)) return {ratio};
  return {1, ratio};
}

struct PairingOutcome {
  std::vector<BranchPair> pairs;
  NodeMotions motions;
  double misfit;
};

/// Of each branch of a with a partner: how much longer or thicker the partner is, as the sum of the
/// absolute logarithms over the scale; 0 of others.
std::vector<double> stretches(const std::vector<BranchMeasures>& of_a,
                              const std::vector<BranchMeasures>& of_b, double scale,
                              const std::vector<BranchPair>& pairs) {
  std::vector<double> stretch(of_a.size(), 0);
  for (const BranchPair& pair : pairs) {
    const BranchMeasures& one = of_a[idx(pair.a)];
    const BranchMeasures& other = of_b[idx(pair.b)];
    // A short branch is as long as its junctions make it.
    const double slack = scale * one.mean_radius + other.mean_radius;
    stretch[idx(pair.a)] =
        std::abs(std::log((scale * one.length + slack) / (other.length + slack))) +
        std::abs(std::log((scale * one.mean_radius + 1e-9) / (other.mean_radius + 1e-9)));
  }
  return stretch;
}

/// A pair is ambiguous if another outcome that fits as well gives another partner.
void mark_ambiguous(std::vector<BranchPair>& pairs, const std::vector<BranchPair>& otherwise) {
  std::map<int, int> partner;
  for (const BranchPair& pair : otherwise) partner[pair.a] = pair.b;
  for (BranchPair& pair : pairs) {
    const auto found = partner.find(pair.a);
    if (found != partner.end() && found->second != pair.b) pair.ambiguous = true;
  }
}

/// All that trials have in common, made once.
class Trials {
 public:
  Trials(const MatchedBodies& bodies, const SurfaceTree& tree_b, int threads)
      : bodies_(bodies),
        tree_b_(tree_b),
        threads_(threads),
        territories_a_(branch_territories(bodies.a.surface, bodies.a.skeleton)),
        territories_b_(branch_territories(bodies.b.surface, bodies.b.skeleton)),
        pairing_(bodies.a, territories_a_, bodies.b, territories_b_, threads),
        seats_(bodies, threads),
        measures_a_(branch_measures(bodies.a.skeleton)),
        measures_b_(branch_measures(bodies.b.skeleton)) {
    constexpr int most_samples = 2000;
    const auto all = static_cast<int>(bodies.a.surface.positions.rows());
    const int step = std::max(1, all / most_samples);
    for (int vertex = 0; vertex < all; vertex += step) samples_.push_back(vertex);
  }

  [[nodiscard]] PairingOutcome outcome_of(NodeMotions motions) const {
    std::vector<int> components =
        pair_components(bodies_.of_a, bodies_.of_b, motions, bodies_.stop);
    std::vector<BranchPair> pairs = pairs_of(motions, components);
    if (!seats_.empty()) {
      seats_.seat(motions, pairing_.pair(pairs, motions, seats_.vertices()).partner);
      components = pair_components(bodies_.of_a, bodies_.of_b, motions, bodies_.stop);
      seats_.lay_onto_partners(motions, components);
      pairs = pairs_of(motions, components);
    }
    const double misfit = misfit_of(pairs, motions);
    return {std::move(pairs), std::move(motions), misfit};
  }

  [[nodiscard]] NodeMotions anchored(const PairingOutcome& outcome) const {
    return anchored_motions(bodies_.a, bodies_.of_a, bodies_.b, outcome.pairs, outcome.motions);
  }

  [[nodiscard]] Eigen::VectorXi vertex_of_a(const std::vector<BranchPair>& pairs,
                                            const NodeMotions& motions) const {
    std::vector<int> all(idx(bodies_.a.surface.positions.rows()));
    std::iota(all.begin(), all.end(), 0);
    return pairing_.pair(pairs, motions, all).partner;
  }

 private:
  [[nodiscard]] std::vector<BranchPair> pairs_of(const NodeMotions& motions,
                                                 const std::vector<int>& components) const {
    const std::vector<int> tips = pair_tips(bodies_, motions, components);
    const Landings landings = landings_of(bodies_.a, territories_b_, tree_b_, motions, threads_);
    const Eigen::MatrixXd overlaps = branch_overlaps(territories_a_, territories_b_, landings);
    return pair_branches(bodies_, tips, overlaps, motions);
  }

  /// Over the unit: how far a's vertices, where they are thought to go, are from b's surface in the
  /// partner's territory, in the mean, and what their branches are stretched by. A vertex without a
  /// partner is a tenth of the size off; so is one whose branch is stretched e times.
  [[nodiscard]] double misfit_of(const std::vector<BranchPair>& pairs,
                                 const NodeMotions& motions) const {
    constexpr double lost = 0.1;
    const Eigen::VectorXi& branch_of_vertex = territories_a_.branch_of_vertex;
    const VertexPairs moved = pairing_.pair(pairs, motions, samples_);
    const std::vector<double> stretch =
        stretches(measures_a_, measures_b_, motions.of_node.front().scale, pairs);
    double sum = 0;
    for (const int v : samples_) {
      if (moved.partner[v] < 0) {
        sum += lost;
        continue;
      }
      const double pulled = stretch[idx(branch_of_vertex[v])];
      sum += std::min(lost, moved.distance[v] / bodies_.of_b.unit + lost * pulled);
    }
    return sum / static_cast<double>(samples_.size());
  }

  const MatchedBodies& bodies_;
  const SurfaceTree& tree_b_;
  int threads_;
  BranchTerritories territories_a_;
  BranchTerritories territories_b_;
  VertexPairing pairing_;
  PartSeats seats_;
  std::vector<BranchMeasures> measures_a_;
  std::vector<BranchMeasures> measures_b_;
  std::vector<int> samples_;  ///< vertices of a, by which an outcome is judged
};

/// Of each way that a might have become b, and of the same with clear pairs taken for granted: they
/// put right a motion that was followed wrongly. The best first.
std::vector<PairingOutcome> outcomes_of(const Trials& trials,
                                        const std::vector<NodeMotions>& hypotheses,
                                        const Monitor& monitor) {
  std::vector<PairingOutcome> outcomes;
  for (const NodeMotions& hypothesis : hypotheses) {
    outcomes.push_back(trials.outcome_of(hypothesis));
    constexpr int rounds = 2;
    for (int round = 0; round < rounds; ++round) {
      throw_if_stopped(monitor.stop);
      PairingOutcome next = trials.outcome_of(trials.anchored(outcomes.back()));
      const bool settled = next.pairs == outcomes.back().pairs;
      outcomes.push_back(std::move(next));
      if (settled) break;
    }
    monitor.report("match", 0.5);
  }
  std::stable_sort(outcomes.begin(), outcomes.end(),
                   [](const PairingOutcome& one, const PairingOutcome& other) {
                     return one.misfit < other.misfit;
                   });
  return outcomes;
}

}  // namespace

SkeletonMatch match_skeletons(const MatchSide& a, const MatchSide& b, const MatchOptions& options,
                              const Monitor& monitor) {
  monitor.report("match", 0);
  const TipFeatures of_a = tip_features(a, "A");
  const TipFeatures of_b = tip_features(b, "B");
  const Eigen::MatrixXd like = likeness(of_a, of_b);
  monitor.report("match", 0.1);
  const SurfaceTree tree_b(b.surface, options.threads);
  const MatchedBodies bodies{a, of_a, b, of_b, like, monitor.stop};
  std::vector<CoreAlignment> alignments;
  for (const double scale : scales_between(of_a, of_b)) {
    const auto found = align_cores(bodies, tree_b, scale, most_alignments, options, monitor.stop);
    alignments.insert(alignments.end(), found.begin(), found.end());
  }
  const Trials trials(bodies, tree_b, options.threads);
  const std::vector<PairingOutcome> outcomes = outcomes_of(
      trials, follow_cores(a, of_a, tree_b, alignments, options.threads, monitor), monitor);
  const PairingOutcome& best = outcomes.front();
  SkeletonMatch match;
  match.branches = best.pairs;
  for (std::size_t k = 1; k < outcomes.size(); ++k) {
    if (outcomes[k].misfit > as_good * best.misfit + as_near) break;
    mark_ambiguous(match.branches, outcomes[k].pairs);
  }
  match.junctions = pair_junctions(a, b, match.branches);
  monitor.report("match", 0.7);
  match.vertex_of_a = trials.vertex_of_a(match.branches, best.motions);
  return match;
}

}  // namespace curveskel
