// The values that every stage shares.
#pragma once

#include <Eigen/Core>
#include <cstdint>

// Matrices cross the border of the library, where one side frees what the other has allocated. By
// itself Eigen allocates in another way for each instruction set that is compiled for.
#if !EIGEN_MALLOC_ALREADY_ALIGNED || EIGEN_MAX_ALIGN_BYTES != 16 || \
    EIGEN_MAX_STATIC_ALIGN_BYTES != 16
#error \
    "curveskel needs matrices that are allocated as its own: link the CMake target \
curveskel::curveskel, or compile everything with -DEIGEN_MALLOC_ALREADY_ALIGNED=1 \
-DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MAX_STATIC_ALIGN_BYTES=16"
#endif

namespace curveskel {

/// #V by 3 vertex positions, one per row, in model units.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// #F by 3 vertex indices, counter-clockwise as seen from outside.
using Triangles = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// A triangle surface. Stages past `clean` may rely on: every component is a closed, oriented
/// 2-manifold, outward (positive volume), without isolated vertices. Functions that need this check
/// the first and the last of it where they are entered, see `require_closed_manifold`.
struct Surface {
  Positions positions;  ///< #V by 3
  Triangles triangles;  ///< #F by 3, rows index into positions
};

}  // namespace curveskel
