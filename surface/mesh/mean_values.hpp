// Mean value coordinates: a place as a mean of a closed surface's vertices.
#pragma once

#include <Eigen/Core>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Ju, Schaefer and Warren (2005): weights of the vertices, 1 in all. The mean of the vertices by
/// these is the place, and so in any affine image of both. On the surface itself numbers may be
/// anything. O(#F).
[[nodiscard]] Eigen::VectorXd mean_value_coordinates(const Surface& surface,
                                                     const Eigen::Vector3d& place);

}  // namespace curveskel
