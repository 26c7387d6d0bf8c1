// A node for every vertex.
#pragma once

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// The skeleton with a node for each vertex of the surface: those without one, or all if it names
/// none, belong to the node with the nearest ball. O(#V log #N). Throws Cancelled on a stop.
/// Precondition: node_of_vertex is empty or as long as the surface's vertices.
[[nodiscard]] CurveSkeleton fully_mapped(const Surface& surface, const CurveSkeleton& skeleton,
                                         int threads, const Monitor& monitor);

}  // namespace curveskel
