// Branches for tips of the surface that the curve does not reach.
#pragma once

#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/lives.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// A tip's deficit is its distance from the curve's balls over the radius of its rim, which counts
/// as `spacing` at least, and at most its life: as much of the life as the curve does not show.
/// While the largest deficit is `least` or more, that tip gets a branch: from the place of the
/// curve whose ball is nearest to the rim's centre, of those that see it, to the middle of the
/// part's end, by the rim's centre if that is not seen directly. Nothing that is there moves, and
/// the order does not depend on `least`, so a lower one adds to what a higher one gives. Two tips
/// that are each other's mirror images decide together, by the mean of their deficits. A tip whose
/// rim or end nothing sees gets none.
///
/// Preconditions: one component with lives and radii; `node_of_vertex` and `lives` are by vertices
/// of `surface`; `tree` is over that surface or a finer one; planes through the origin and normal
/// to `mirror_axes` take the surface to itself. Returns the number of branches.
/// O(tips x nodes + branches x their nodes x nodes).
int add_finer_branches(CurveSkeleton& skeleton, const Surface& surface, const SurfaceTree& tree,
                       const std::vector<TipLife>& lives, const std::vector<int>& mirror_axes,
                       double least, double spacing = 0);

}  // namespace curveskel
