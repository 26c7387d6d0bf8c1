// The last places of all points: central and smooth at once.
#pragma once

#include <functional>
#include <stop_token>

#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/tuning.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {

struct SettleOptions {
  int rounds = 5;
  double keep = 0.8;  ///< share of its inscribed radius that a moved point must keep
  /// True if a triangle of the tree belongs to an arc: flat limbs are centred from one edge to the
  /// other. Called from all threads.
  std::function<bool(int triangle, int arc)> is_own;
  RelaxTuning tuning = {};
  SectionTuning section = {};
  std::stop_token stop = {};
};

/// Moves the points p of each arc to the least of the sum of |p - c|^2 + (w / 2)^2 |p'|^2, c the
/// centre of the cross-section at p and w its width; how far a point lies along its arc is free and
/// stays. One linear system for each arc and round (tridiagonal, O(points)); a section is taken
/// anew only when its point has moved by a share of its width. Junctions go to where the axes of
/// their arcs meet, tips to the centre of the section there. No cycle leaves its handle; the result
/// does not depend on the number of threads.
void settle(SkeletonGraph& graph, const SurfaceTree& tree, const SettleOptions& options,
            HomologyGuard& guard, int threads);

}  // namespace curveskel
