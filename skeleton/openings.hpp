// Ends of tubes that the file left open: the curve goes on to where they open.
#pragma once

#include <cstdint>
#include <vector>

#include "skeleton/curve_skeleton.hpp"
#include "surface/surface.hpp"
#include "surface/tree.hpp"

namespace curveskel {

/// Adds a node in the middle of each opening that a tip faces from near by: within 2.5 radii of tip
/// or opening, the opening at least half as wide as the tip's ball, the way to it inside. The node
/// lies D/1000 inside the opening's closing; its radius is the distance to the opening's rim. Other
/// nodes stay. `tree` is over `surface`; openings name vertices of it. O(tips x openings).
void reach_openings(CurveSkeleton& skeleton, const Surface& surface, const SurfaceTree& tree,
                    const std::vector<std::vector<std::int32_t>>& openings);

}  // namespace curveskel
