// The look of the meshes in an FBX file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/gltf/dressed_file.hpp"

namespace curveskel {

/// Texture coordinates (of each mesh up to four sets), normals, colours (as sRGB), materials and
/// shape keys; nothing where there is none of these. Of a material: diffuse colour and picture
/// (those of Maya's and 3ds Max's own materials, too), normal map, emission, opacity, roughness
/// from the shininess as Blender has it, and, of files of Blender's and of this program, metalness.
/// Pictures are taken from the file, or sought where it names them, beside it, and in "textures"
/// and "<file>.fbm". `notes` has a line where further sets are left out.
[[nodiscard]] std::optional<DressedFile> read_fbx_looks(const FileBytes& file,
                                                        std::vector<std::string>& notes,
                                                        const Monitor& monitor);

}  // namespace curveskel
