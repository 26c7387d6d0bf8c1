// Level set of a function as a closed triangle surface.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel::shapes {

using Field = std::function<double(const Eigen::Vector3d&)>;  ///< negative inside, continuous

/// Marching tetrahedra on a body-centred cubic lattice, hence always a closed oriented 2-manifold,
/// outward where the field grows; then rounds of tangential smoothing and Newton steps onto the
/// zero set. Only lattice cells near the surface are visited: it is followed from where it is first
/// met along +x from each of `seeds`, points inside; a component that no seed reaches is left out.
/// Edges are about 0.6 `spacing` (model units) long. Some 40 evaluations of the field per vertex.
[[nodiscard]] Surface mesh_level_set(const Field& field, const std::vector<Eigen::Vector3d>& seeds,
                                     double spacing);

}  // namespace curveskel::shapes
