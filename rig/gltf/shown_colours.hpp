// Colours of vertices where there are pictures, too.
#pragma once

#include <string_view>
#include <vector>

#include "rig/gltf/dressed_mesh.hpp"

namespace curveskel {

/// The name of a set that `show_colours` has made.
inline constexpr std::string_view shown_colours = "colours as shown";

/// glTF takes the first set as factors on the pictures, where programs that have both mean
/// something else by colours, masks mostly. So a set comes first that is white on faces whose
/// material has a picture, and on the others is the file's first. Nothing is done where no face has
/// both. `is_pictured`: by material. Precondition: the mesh has parts.
void show_colours(DressedMesh& mesh, const std::vector<bool>& is_pictured);

}  // namespace curveskel
