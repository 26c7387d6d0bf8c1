// The parts of the surface that belong to the branches of its skeleton.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct BranchTerritories {
  Eigen::VectorXi branch_of_vertex;  ///< #V, of `branches(skeleton)`; -1 = of none
  Eigen::VectorXi branch_of_face;    ///< #F: of two of its vertices or of the first; -1 = of none
  std::vector<double> areas;         ///< per branch, of its faces, in square model units
  /// Per branch, in cubic model units: its faces, closed where they meet another branch's by
  /// triangles to the junction that both share, or to the nearest end of either where they share
  /// none. Other components and the origin of coordinates do not matter. All together are the
  /// volume of the surface, less the faces of no branch.
  std::vector<double> volumes;
};

/// A vertex belongs to the branch of its node; at a junction to that which leaves it in the
/// direction nearest to the vertex. Precondition: `node_of_vertex` is by the surface's vertices.
/// O(#V + #F + #N + #E log #E).
[[nodiscard]] BranchTerritories branch_territories(const Surface& surface,
                                                   const CurveSkeleton& skeleton);

/// The branch of each polygon, corners [offsets[f], offsets[f + 1]): of most of its corners, of
/// several the one that comes first. -1 = of none. O(corners).
[[nodiscard]] Eigen::VectorXi majority_labels(const Eigen::VectorXi& label_of_vertex,
                                              const std::vector<std::int32_t>& corners,
                                              const std::vector<std::int64_t>& offsets);

}  // namespace curveskel
