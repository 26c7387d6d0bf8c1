// Central and smooth: where the points of a graph go.
#pragma once

#include <functional>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel {

/// Of D: points need not lie nearer together, however thin the limb.
inline constexpr double least_spacing = 1.0 / 400;

/// The inscribed radius at each point, negative outside.
[[nodiscard]] std::vector<double> radii_at(const SurfaceTree& tree,
                                           const std::vector<Point>& points);

/// Places the inner points of each arc evenly, half of its median inscribed radius apart, but at
/// most `most_spacing`. Lengths relative to D = 1.
void space_evenly(SkeletonGraph& graph, const SurfaceTree& tree, double most_spacing);

/// The same with half of the inscribed radius that each place has: points that crowd in a wide one
/// take many rounds to become smooth, as each follows its neighbours.
void space_by_radius(SkeletonGraph& graph, const SurfaceTree& tree, double most_spacing);

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
};

/// Rounds of centring and smoothing of all inner points and straightening at junctions. The result
/// does not depend on the number of threads. No cycle leaves its handle.
void relax(SkeletonGraph& graph, const SurfaceTree& tree, const RelaxOptions& options,
           HomologyGuard& guard, int threads);

/// Moves each junction away from the nearest surface as long as that widens its inscribed ball, by
/// one radius at most.
void centre_junctions(SkeletonGraph& graph, const SurfaceTree& tree);

/// Drops inner points that crowd (nearer than half an inscribed radius and than `most_spacing`)
/// where the balls of their neighbours overlap without them, or the line between these neighbours
/// meets no surface.
void thin_out(SkeletonGraph& graph, const SurfaceTree& tree, double most_spacing);

/// Takes the chord wherever the arc goes a detour within its own ball: between two points that
/// lie in each other's balls it need not be longer than 1.4 chords. The chord lies in a ball, so
/// inside.
void cut_detours(SkeletonGraph& graph, const SurfaceTree& tree);

}  // namespace curveskel
