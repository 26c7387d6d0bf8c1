// An OBJ file with its materials and pictures as a glTF file.
#pragma once

#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/gltf/gltf_document.hpp"
#include "rig/gltf/obj_file.hpp"
#include "surface/read/gltf_scene.hpp"

namespace curveskel {

struct ObjDocument {
  GltfDocument document;
  std::vector<GltfPart> parts;
  std::vector<int> row_of_vertex;  ///< of each vertex written the vertex of the file
};

/// One mesh with a primitive for each material, in the order in which faces name them; all share
/// the vertices: first those of the file, in its order, then copies for corners that meet in a
/// vertex with other texture coordinates or normals. Corners without a normal get that of
/// `normals_across_seams`. Faces are triangulated; one with a vertex that has no place is left out.
/// Throws Error(Fault::output) where single precision does not do.
[[nodiscard]] ObjDocument obj_document(const ObjFile& obj, const FileBytes& file,
                                       const std::string& name, std::vector<std::string>& notes,
                                       const Monitor& monitor);

}  // namespace curveskel
