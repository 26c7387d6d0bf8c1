// Compressed parts of a glTF file, made plain where the file is edited.
#pragma once

#include "rig/gltf/gltf_document.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

/// Buffer views of EXT_meshopt_compression and primitives of KHR_draco_mesh_compression get plain
/// numbers, appended, and both extensions go from the file; the compressed bytes stay where they
/// are. `model` is the same file, parsed with all of its attributes decompressed.
void decode_gltf(GltfDocument& document, const tinygltf::Model& model);

}  // namespace curveskel
