// The materials of a glTF file as FBX has them. Internal to rig/.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rig/fbx/fbx_document.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

/// Colours, roughness as shininess, metal as reflection, light of its own, opacity; pictures of
/// colour, normals and light, inside the file. The number of each material's object.
/// Precondition: the pictures that the file holds lie in buffer views.
/// `map_names` are those of `fbx_map_names`.
[[nodiscard]] std::vector<std::int64_t> add_fbx_materials(
    FbxDocument& document, const tinygltf::Model& model,
    const std::vector<std::vector<std::string>>& map_names);

/// For faces that name no material.
[[nodiscard]] std::int64_t add_fbx_plain_material(FbxDocument& document);

}  // namespace curveskel
