// The look of the meshes in a COLLADA file.
#pragma once

#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/gltf/dressed_file.hpp"

namespace curveskel {

/// Texture coordinates and colours (as sRGB; of each mesh up to eight sets), normals, materials and
/// morphs. Of a material of the common profile: diffuse colour and picture, emission, opacity,
/// roughness from the shininess as of FBX, the map of normals of FCOLLADA's extension, and whether
/// it has two sides. Pictures are sought where the file names them, beside it, and in "textures",
/// "images" and a folder with the file's name. `as_bound` as of `ReadOptions`; `notes` has a line
/// for each map of bumps, which is left out. Throws Error(Fault::input) with the line.
[[nodiscard]] DressedFile read_dae_looks(const FileBytes& file, bool as_bound,
                                         std::vector<std::string>& notes, const Monitor& monitor);

}  // namespace curveskel
