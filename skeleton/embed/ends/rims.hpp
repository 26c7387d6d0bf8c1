// Ends of tubes that the file left open: the curve goes on to where they open.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Adds a node in the middle of each opening that something leads to from near by: within 2.5 radii
/// of ball or opening, the opening at least half as wide as the ball, the way to it inside, D/1000
/// inside the opening's closing; its radius is the least distance to the opening's rim.
///
/// A tip faces an opening if the way to it turns by less than 60 degrees from where its limb
/// arrives from outside the tip's ball; nodes at the tip that bend elsewhere move onto the way.
/// Each tip leads to one opening, those first that bend least, then the nearest. A curve that lies
/// within one ball (1.5 of its radii) has no direction: between two openings its nodes move onto
/// the straight line, if that is no narrower half-way (0.7). An opening that no tip leads to and
/// that is 0.7 as wide as the ball of a node 1.1 radii away or more gets a branch from there, from
/// a junction by preference: the waist of trousers. Other nodes stay. `tree` is over `surface`;
/// openings name vertices of it. O(nodes x openings).
void reach_rims(CurveSkeleton& skeleton, const Surface& surface, const SurfaceTree& tree,
                const std::vector<std::vector<std::int32_t>>& openings);

}  // namespace curveskel
