// The cotangent Laplacian and the area that goes with it.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <curveskel/surface.hpp>

namespace curveskel {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// #V by #V cotangent Laplacian (eq. 2): L_ij = (cot a_ij + cot b_ij) / 2 for an edge,
/// L_ii = -sum_j L_ij; symmetric, negative semi-definite, L 1 = 0. Unit-free.
[[nodiscard]] SparseMatrix cotangent_laplacian(const Surface& surface);

/// The same operator on the intrinsic Delaunay triangulation of the mollified surface (Sharp and
/// Crane 2020): off-diagonal entries are >= 0, also where triangles have degenerated. Edge lengths
/// are first grown by the least epsilon that gives every triangle a slack of `mollify` times the
/// mean edge length; edge weights are clamped to [0, max_weight].
[[nodiscard]] SparseMatrix intrinsic_delaunay_laplacian(const Surface& surface,
                                                        double mollify = 1e-4,
                                                        double max_weight = 1e3);

/// #V barycentric areas, a third of the area of the faces around each vertex, in square units.
[[nodiscard]] Eigen::VectorXd vertex_areas(const Surface& surface);

}  // namespace curveskel
