// Do a skeleton's cycles go round the handles?
#pragma once

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>
#include "skeleton/homology/linking.hpp"

namespace curveskel {

/// The number of the skeleton's cycles that are independent in the enclosed solid: the rank of its
/// homology there (coefficients in Z/2). A cycle that goes along a handle and comes back, or lies
/// in a ball, counts nothing; two that go round the same handle count once. For a skeleton inside
/// it is at most the surface's genus.
///
/// Loops on the surface generate the homology of the outside, and linking numbers pair that
/// perfectly with the homology inside (Alexander duality). So it is the rank of the matrix of the
/// linking numbers of cycles with loops, counted as crossings in a projection.
/// Precondition: surface closed, no position NaN or infinite. O(#F) and, with g handles and loops
/// of n edges, O(g n + (#N + cycles g) g / 64).
[[nodiscard]] int homology_rank(const Surface& surface, const CurveSkeleton& skeleton);

/// The same within one component, given its loops.
[[nodiscard]] int homology_rank(linking::SeenLoops& loops, const CurveSkeleton& skeleton);

}  // namespace curveskel
