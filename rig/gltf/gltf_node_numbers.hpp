// Where a glTF file names nodes by their numbers, and what to do when they get others.
#pragma once

#include <vector>

#include "rig/gltf/gltf_document.hpp"
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// Takes out the nodes whose new number is -1 and gives the others theirs, wherever the standard
/// names nodes: children, scenes, skins, channels of animations (also those of
/// KHR_animation_pointer). Channels that moved nodes that are gone go, and animations that are then
/// empty. Returns the number of channels that went.
int renumber_nodes(GltfDocument& document, const std::vector<int>& new_node);

/// Throws Error(Fault::input) by name where an extension of the file, a scene or a node seems to
/// name nodes: those of VRM do.
void refuse_node_numbers_in_extensions(const GltfDocument& document, const FileBytes& file);

}  // namespace curveskel
