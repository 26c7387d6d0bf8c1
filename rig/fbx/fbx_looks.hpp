// The look of the meshes in an FBX file.
#pragma once

#include <curveskel/monitor.hpp>
#include "rig/gltf/dressed_file.hpp"

namespace curveskel {

/// Texture coordinates and colours (as sRGB; of each mesh up to eight sets), normals, materials and
/// shape keys. Of a material: diffuse colour and picture
/// (those of Maya's and 3ds Max's own materials, too), normal map, emission, opacity, roughness
/// from the shininess as Blender has it, and, of files of Blender's and of this program, metalness.
/// Pictures are taken from the file, or sought where it names them, beside it, and in "textures"
/// and "<file>.fbm". `as_bound` as of `ReadOptions`. Throws Error(Fault::input) as `read_polygons`.
[[nodiscard]] DressedFile read_fbx_looks(const FileBytes& file, bool as_bound,
                                         const Monitor& monitor);

}  // namespace curveskel
