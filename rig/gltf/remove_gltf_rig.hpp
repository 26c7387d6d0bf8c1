// The old rig of a glTF file, taken out.
#pragma once

#include <string>
#include <vector>

#include "rig/gltf/gltf_document.hpp"
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// All that went; nodes by their old numbers.
struct RemovedRig {
  int joints = 0;             ///< nodes that were joints
  int channels = 0;           ///< of animations
  int holder = -1;            ///< the node that stays and held all joints, if there is one
  std::vector<int> new_node;  ///< of each node; -1 = gone
};

/// Takes out the skins that move meshes of the shown scene and those that move nothing; their
/// joints and all below them, where neither a mesh, a camera nor an extension hangs from them, and
/// the nodes that held nothing else; channels of animations that moved these, and animations that
/// have no others. Rows of joints and weights stay in the meshes. Skins of meshes in other scenes
/// stay, with their joints. `shown`: by node, in the scene.
/// Throws Error(Fault::input) where an extension speaks of nodes, which get other numbers.
[[nodiscard]] RemovedRig remove_gltf_rig(GltfDocument& document, const std::vector<bool>& shown,
                                         const FileBytes& file);

}  // namespace curveskel
