// Wavefront OBJ with all that a corner of a face may name: texture coordinates, normals, materials.
#pragma once

#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/gltf/dressed_mesh.hpp"
#include "surface/read/file_bytes.hpp"

namespace curveskel {

struct ObjFile {
  DressedMesh mesh;                    ///< materials in the order in which faces name them
  std::vector<std::string> libraries;  ///< files of materials, as named
};

/// Throws Error(Fault::input) as `read_polygons`. Indices of texture coordinates and normals that
/// are not there count as none.
[[nodiscard]] ObjFile read_obj_file(const FileBytes& file, const Monitor& monitor);

}  // namespace curveskel
