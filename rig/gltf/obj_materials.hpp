// Materials of an OBJ file (MTL).
#pragma once

#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/gltf/dressed_mesh.hpp"
#include "rig/gltf/obj_file.hpp"

namespace curveskel {

/// One for each that faces name, in that order: base colour (Kd) with its texture (map_Kd, its
/// scale -s and shift -o), opacity (d, Tr, map_d of the same picture), emission (Ke, map_Ke), a
/// normal map (norm), metalness and roughness (Pm, Pr, else from Ns). `notes` has a line for each
/// library that is missing, and for each material that no library has: then the name alone is
/// known.
[[nodiscard]] std::vector<DressedMaterial> read_obj_materials(const ObjFile& obj,
                                                              const FileBytes& file,
                                                              std::vector<std::string>& notes,
                                                              const Monitor& monitor);

}  // namespace curveskel
