// Central and smooth: where the points of a graph go.
#pragma once

#include <functional>

#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/tuning.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {

struct RelaxOptions {
  int rounds = 4;
  double keep = 0.8;            ///< share of its inscribed radius that a moved point must keep
  double keep_junction = 0.95;  ///< the same for junctions, which belong in the thickest place
  bool meet = false;            ///< junctions go to where the axes of their arcs meet
  double smoothing = 0.5;       ///< share of the neighbours' middle in a point's new place
  bool tips = false;            ///< tips go to the centre of the section there (centre_tips)
  bool covered = false;         ///< keep the balls of neighbouring points overlapping; nodes stay
  /// True if a triangle of the tree belongs to an arc. If given, flat limbs are centred from one
  /// edge to the other. Called from all threads.
  std::function<bool(int triangle, int arc)> is_own = {};
  RelaxTuning tuning = {};
  SectionTuning section = {};
};

/// Rounds of centring and smoothing of all inner points and straightening at junctions. The result
/// does not depend on the number of threads. No cycle leaves its handle.
void relax(SkeletonGraph& graph, const SurfaceTree& tree, const RelaxOptions& options,
           HomologyGuard& guard, int threads);

}  // namespace curveskel
