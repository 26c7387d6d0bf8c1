// Materials of an OBJ file (MTL) as those of glTF.
#pragma once

#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/gltf/gltf_document.hpp"
#include "rig/gltf/obj_file.hpp"

namespace curveskel {

/// One material for each that faces name, in that order: base colour (Kd) with its texture
/// (map_Kd), opacity (d, Tr, map_d of the same picture), emission (Ke, map_Ke), a normal map
/// (norm), metalness and roughness (Pm, Pr, else from Ns). Pictures are taken in. `notes` has a
/// line for each library or picture that is missing or of another kind than PNG and JPEG, and for
/// each material that no library has: then the name alone is kept.
void add_obj_materials(GltfDocument& document, const ObjFile& obj, const FileBytes& file,
                       std::vector<std::string>& notes, const Monitor& monitor);

}  // namespace curveskel
