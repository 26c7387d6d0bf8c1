// Directions of meshes that a scene moves.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "surface/read/placed_meshes.hpp"

namespace curveskel {

/// By vertex, of `count`, what moves its surroundings to the world: the weighted mean of its
/// joints, or `frame` where it has none.
[[nodiscard]] std::vector<Eigen::Matrix3d> vertex_maps(const MeshSkin& skin,
                                                       const Eigen::Affine3d& frame,
                                                       std::size_t count);

/// The same of normals, which come out in any length: the inverse transpose times a number above 0.
[[nodiscard]] std::vector<Eigen::Matrix3d> normal_maps(std::vector<Eigen::Matrix3d> maps);

}  // namespace curveskel
