// Materials of an FBX file, read.
#pragma once

#include <vector>

#include "rig/gltf/dressed_mesh.hpp"
#include "surface/read/fbx_scene.hpp"

namespace curveskel {

/// The look of one "Material" of the scene, see `read_fbx_looks`. `root` is the scene's; among the
/// texture coordinates of `geometry` its textures have theirs.
[[nodiscard]] DressedMaterial fbx_look_of(const FileBytes& file, const FbxRecord& root,
                                          const FbxScene& scene, const FbxRecord& material,
                                          const FbxRecord& geometry);

}  // namespace curveskel
