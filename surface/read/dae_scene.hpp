// The meshes of a COLLADA file where its scene shows them. Internal to surface/ and rig/.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string_view>
#include <vector>

#include <curveskel/monitor.hpp>
#include "surface/read/dae_document.hpp"
#include "surface/read/dae_mesh.hpp"
#include "surface/read/placed_meshes.hpp"

namespace curveskel {

/// All are there while the document is.
struct DaeShownMesh {
  const XmlElement* instance;  ///< what shows it; nullptr in a file without a scene
  const DaeMesh& mesh;         ///< morphed by the weights that the file gives
  Eigen::Affine3d frame;       ///< from the mesh to the world
  MeshSkin skin;
  const XmlElement* morph;  ///< <morph> of the mesh, or nullptr
  std::string_view name;    ///< of the node that shows it, or its own; may be empty
  const DaeMesh& base;      ///< of which `mesh` is the morph, or itself
  int node = -1;            ///< that shows it, among `dae_nodes`; -1 in a file without a scene
};

/// Each mesh as often as the scene shows it, in the order in which `read_polygons` has them; where
/// joints bend meshes away from where they were bound, `as_bound` as of `ReadOptions`. Returns
/// whether they do. Throws Error(Fault::input) with the line.
bool for_each_dae_mesh(const DaeDocument& document, const Monitor& monitor, bool as_bound,
                       const std::function<void(const DaeShownMesh&)>& take);

/// True if the file says that z is up.
[[nodiscard]] bool has_z_up(const DaeDocument& document);

/// From the file's coordinates to those of glTF: y up, z ahead, metres. Where the file does not say
/// its axes are as in glTF, and its unit is the metre.
[[nodiscard]] Eigen::Affine3d dae_to_gltf(const DaeDocument& document);

/// The document's root. Throws Error(Fault::input) with the line.
[[nodiscard]] XmlElement parse_dae(const FileBytes& file);

}  // namespace curveskel
