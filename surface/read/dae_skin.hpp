// The skin of a COLLADA controller. Internal to surface/.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <string>
#include <vector>

#include "surface/read/dae_document.hpp"
#include "surface/read/placed_meshes.hpp"

namespace curveskel {

/// As its <skin> has it.
struct DaeSkin {
  std::vector<std::string> joints;  ///< names or ids of nodes
  bool joints_are_ids = false;
  std::vector<Eigen::Affine3d> inverse_bind;  ///< one per joint
  Eigen::Affine3d bind_shape;                 ///< from the mesh to the world as it was bound
  std::vector<SkinWeight> weights;
};

/// `vertices`: how many its mesh has. Throws Error(Fault::input) with the line.
[[nodiscard]] DaeSkin read_dae_skin(const DaeDocument& document, const XmlElement& skin,
                                    std::size_t vertices);

}  // namespace curveskel
