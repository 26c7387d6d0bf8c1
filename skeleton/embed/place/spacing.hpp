// The spacing of the points on the arcs of a graph.
#pragma once

#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/surface.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/tuning.hpp"

namespace curveskel {

/// Bounds of the distance between neighbouring points. D = 1.
struct Spacing {
  double least = 1.0 / 400;
  double most = 1.0 / 60;
  double straight = 1.0 / 400;  ///< on straight runs, at last
};

/// Of a surface: the points of an arc lie no farther apart than D / 60, or than the surface is
/// coarse, so that the curve is not sampled more finely than the limb. O(#F).
[[nodiscard]] Spacing spacing_on(const Surface& surface, const SpacingTuning& tuning);

/// Places the inner points of each arc evenly, half of its median inscribed radius apart.
void space_evenly(SkeletonGraph& graph, const SurfaceTree& tree, const Spacing& spacing);

/// The same with half of the inscribed radius that each place has: points that crowd in a wide one
/// take many rounds to become smooth, as each follows its neighbours.
void space_by_radius(SkeletonGraph& graph, const SurfaceTree& tree, const Spacing& spacing);

/// Drops inner points that crowd (nearer than half an inscribed radius and than `spacing.most`)
/// where the balls of their neighbours overlap without them, or the line between these neighbours
/// meets no surface.
void thin_out(SkeletonGraph& graph, const SurfaceTree& tree, const Spacing& spacing);

/// Drops inner points of straight runs, those whose neighbours come no farther apart than
/// `spacing.straight`: where the chord meets no surface, and places and radii lie within a tenth of
/// the radius (`tuning.bend`) of what it has there. The same from either end of an arc. O(points x
/// splits).
void thin_straight_runs(SkeletonGraph& graph, const SurfaceTree& tree, const Spacing& spacing,
                        const SpacingTuning& tuning);

/// Takes the chord wherever the arc goes a detour within its own ball: between two points that
/// lie in each other's balls it need not be longer than 1.4 chords. The chord lies in a ball, so
/// inside.
void cut_detours(SkeletonGraph& graph, const SurfaceTree& tree, const RelaxTuning& tuning = {});

/// Each arc gets an inner point, a closed one two, where it has none: whatever comes then, two arcs
/// between the same nodes are told apart.
void keep_simple(SkeletonGraph& graph);

/// The same only for closed arcs, and for all but one of the arcs without points between the same
/// nodes. O(arcs log arcs).
void tell_twins_apart(SkeletonGraph& graph);

}  // namespace curveskel
