// A mesh of a glTF file as FBX has it. Internal to rig/.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rig/fbx/fbx_document.hpp"
#include "rig/gltf/whole_mesh.hpp"
#include "surface/read/file_bytes.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

struct FbxMesh : WholeMesh {  ///< colours as sRGB
  std::vector<std::string> map_names;
  std::vector<std::string> colour_names;
};

/// As `read_whole_mesh`; `map_names` has one for each set of texture coordinates. Throws
/// Error(Fault::input) where numbers are wrong.
[[nodiscard]] FbxMesh read_fbx_mesh(const FileBytes& file, const tinygltf::Model& model, int mesh,
                                    std::size_t joints, std::vector<std::string> map_names);

struct FbxGeometry {
  std::int64_t number = 0;
  std::vector<std::int64_t> sliders;  ///< one of each shape
};

/// The geometry with its shapes; the weights of shapes connect to it.
[[nodiscard]] FbxGeometry add_fbx_geometry(FbxDocument& document, const std::string& name,
                                           FbxMesh mesh);

}  // namespace curveskel
