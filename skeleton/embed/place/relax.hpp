// First places of points, and the last smoothing.
#pragma once

#include <stop_token>

#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/tuning.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {

struct RelaxOptions {
  int rounds = 4;
  double keep = 0.8;            ///< share of its inscribed radius that a moved point must keep
  double keep_junction = 0.95;  ///< the same for junctions, which belong in the thickest place
  double smoothing = 0.5;       ///< share of the neighbours' middle in a point's new place
  bool covered = false;         ///< keep the balls of neighbouring points overlapping; nodes stay
  RelaxTuning tuning = {};
  SectionTuning section = {};
  std::stop_token stop = {};
};

/// Rounds of centring and smoothing of all inner points and straightening at junctions. The result
/// does not depend on the number of threads. No cycle leaves its handle. Cross-sections are taken
/// of `sections`, which may be a coarser tree of the same body; the rest is asked of `tree`.
void relax(SkeletonGraph& graph, const SurfaceTree& tree, const SurfaceTree& sections,
           const RelaxOptions& options, HomologyGuard& guard, int threads);

}  // namespace curveskel
