// Branches that reach the ends of their limbs.
#pragma once

#include <vector>

#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/tuning.hpp"

namespace curveskel {

/// Cuts each leaf arc back to where its rest and the surface ahead are within `reach` x the
/// local inscribed radius, or its rest turns away within the ball or into a narrow corner beside
/// it; then prolongs it straight ahead, centring as it goes, until the surface ahead is within
/// `gap` x the radius, or nearest.
void shape_tips(SkeletonGraph& graph, const SurfaceTree& tree, double reach, double gap,
                const TipTuning& tuning = {});

/// Prolongs leaf arcs that end inside the inscribed ball of their junction to just beyond it, if
/// there is room: their tip must keep 0.4 of the junction's radius.
void lengthen_short_leaves(SkeletonGraph& graph, const SurfaceTree& tree,
                           const TipTuning& tuning = {});

/// A tip and the way it looks, as a unit vector.
struct TipHeading {
  int node = -1;
  Point direction = Point::Zero();
  double radius = 0;  ///< inscribed, when the heading was taken
};

/// The direction of each tip: along the chord of the curve from three inscribed radii before it,
/// but at least D/25 (D = 1), to one. Nearer the curve may bend into a corner, and a tip that
/// looked where its own moves lead would drift.
[[nodiscard]] std::vector<TipHeading> tip_headings(const SkeletonGraph& graph,
                                                   const SurfaceTree& tree,
                                                   const RelaxTuning& tuning = {});

/// Moves each tip half-way to the centre of the cross-section there normal to its heading, if it
/// keeps 0.95 of the inscribed radius that it had.
void centre_tips(SkeletonGraph& graph, const SurfaceTree& tree,
                 const std::vector<TipHeading>& headings, const RelaxTuning& tuning = {});

}  // namespace curveskel
