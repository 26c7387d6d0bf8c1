// A rig's joints and skins in a glTF file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <curveskel/rig.hpp>
#include "rig/gltf/gltf_document.hpp"
#include "surface/read/gltf_scene.hpp"

namespace curveskel {

/// Appends a node that holds all joints (`name`, with a number behind it if a node has that name),
/// or lets the node `holder` do so, which is not moved; the joints, and a skin for each place from
/// which meshes come (`GltfPart::move`): a skinned mesh ignores its node's place. Where most
/// vertices come from elsewhere than the scene's origin by a similarity, a node of its own holds
/// the joints there; what other meshes need beyond that is in the inverse bind matrices. The nodes
/// of `parts` get their skins. A file without nodes gets one for each mesh first. Returns the
/// number of the first joint's node; the others follow.
std::size_t add_gltf_rig(GltfDocument& document, const std::vector<GltfPart>& parts, const Rig& rig,
                         const std::string& name, int holder = -1);

/// A node for each mesh, and a scene, where the file has no nodes.
void add_missing_nodes(GltfDocument& document);

}  // namespace curveskel
