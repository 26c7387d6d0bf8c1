// Seams of skinned meshes: one place of the surface, of which the file has several vertices, as
// texture coordinates or materials differ.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace curveskel {

struct GltfSeamVertex {
  std::int64_t vertex;       ///< of the soup
  Eigen::Vector3d modelled;  ///< before joints have moved it
};

/// The two sides of a seam have weights that differ by a rounding, so joints part them. Vertices
/// that coincide as modelled and nearly do as placed, to 5e-5 of the bounding box's diagonal, get
/// the place of the first of them. `coordinates` are x y z x y z ... O(n log n).
void rejoin_seams(std::vector<GltfSeamVertex> vertices, std::vector<double>& coordinates);

}  // namespace curveskel
