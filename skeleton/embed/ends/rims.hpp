// Ends of tubes that the file left open: the curve goes on to where they open.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Adds a node in the middle of each rim that something leads to from near by: within 2.5 radii of
/// ball or rim, the rim at least half as wide as the ball, the way to its middle inside, D/1000
/// inside the closing of its hole. Where what closes a hole is the nearest of the surface, the
/// radius becomes the distance to the rest.
///
/// A tip faces a rim if the way to its middle turns by less than 60 degrees from where the tip's
/// limb arrives from outside the tip's ball; nodes at the tip that bend elsewhere move onto the
/// way. Each tip leads to one rim, those first that bend least, then the nearest. A curve that lies
/// within one ball (1.5 of its radii) has no direction: between two rims its nodes move onto the
/// straight line, if that is no narrower half-way (0.7). A rim that no tip leads to and that is 0.7
/// as wide as the ball of a node 1.1 radii away or more gets a branch from there, from a junction
/// by preference: the waist of trousers; its life is its length over the ball's radius. A tip that
/// is led on hands its life to the new one. Other nodes stay. `rims` name vertices of `surface`,
/// whose D is `diagonal`: one of many components costs no more than it is large; `tree` is over the
/// component that has skeleton and rims, `open` is that component without what closes holes, or
/// empty. O(nodes x rims + #F log #F).
void reach_rims(CurveSkeleton& skeleton, const Surface& surface, double diagonal,
                const SurfaceTree& tree, const Surface& open,
                const std::vector<std::vector<std::int32_t>>& rims);

}  // namespace curveskel
