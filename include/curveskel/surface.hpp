// The values that every stage shares.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace curveskel {

/// #V by 3 vertex positions, one per row, in model units.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// #F by 3 vertex indices, counter-clockwise as seen from outside.
using Triangles = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// A triangle surface. Stages past `clean` may rely on: every component is a closed, oriented
/// 2-manifold, outward (positive volume), without isolated vertices.
struct Surface {
  Positions positions;  ///< #V by 3
  Triangles triangles;  ///< #F by 3, rows index into positions
};

}  // namespace curveskel
