// Names of the sets of texture coordinates and colours of an FBX mesh. Internal to rig/.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
struct Mesh;
}  // namespace tinygltf

namespace curveskel {

struct FbxSetKind {
  const char* attribute;      ///< "TEXCOORD_" or "COLOR_"
  const char* name;           ///< for sets without one: "UVMap", "UVMap.001" and so on
  std::size_t first_set = 0;  ///< of the attributes
};

inline constexpr FbxSetKind fbx_maps{"TEXCOORD_", "UVMap"};

/// Of each set that the mesh's triangles have, as its accessor is called, each another one.
[[nodiscard]] std::vector<std::string> fbx_set_names(const tinygltf::Model& model,
                                                     const tinygltf::Mesh& mesh,
                                                     const FbxSetKind& kind);

/// Of each mesh those of its texture coordinates. A texture names one set, whichever mesh shows it:
/// meshes of one textured material whose accessors are called otherwise have "UVMap" and so on.
[[nodiscard]] std::vector<std::vector<std::string>> fbx_map_names(const tinygltf::Model& model);

}  // namespace curveskel
