#pragma once

#include <Eigen/Core>
#include <cstdint>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// The corner nearest to `p` of the triangle nearest to it; `tree` is over `surface`.
[[nodiscard]] inline std::int32_t nearest_vertex(const Surface& surface, const SurfaceTree& tree,
                                                 const Eigen::Vector3d& p) {
  const auto corners = surface.triangles.row(tree.nearest(p).triangle);
  Eigen::Index nearest = 0;
  (surface.positions(corners.transpose(), Eigen::all).rowwise() - p.transpose())
      .rowwise()
      .squaredNorm()
      .minCoeff(&nearest);
  return corners(nearest);
}

}  // namespace curveskel
