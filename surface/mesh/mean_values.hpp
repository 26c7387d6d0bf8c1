// Mean value coordinates: a place as a mean of a closed surface's vertices.
#pragma once

#include <Eigen/Core>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Ju, Schaefer and Warren (2005): weights of the vertices, 1 in all, whose mean is the place; the
/// same for the place's image in an affine image of the surface. Of other places than on the
/// surface, where numbers may be anything. O(#F).
[[nodiscard]] Eigen::VectorXd mean_value_coordinates(const Surface& surface,
                                                     const Eigen::Vector3d& place);

}  // namespace curveskel
