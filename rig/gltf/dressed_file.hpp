// Files other than glTF whose look is known.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/gltf/dressed_mesh.hpp"
#include "surface/read/file_bytes.hpp"

namespace curveskel {

struct DressedFile {
  DressedMesh mesh;  ///< vertices and faces as `read_polygons` gives them, but for shapes
  std::vector<DressedMaterial> materials;
};

struct LookOptions {
  bool as_bound = false;       ///< as of `ReadOptions`
  bool with_polygons = false;  ///< a file is taken, too, if all it has are polygons
  bool without_look = false;   ///< every file is taken
};

/// Of OBJ, COLLADA, FBX and PLY; nothing where the file has no look, or is of another format.
/// `notes` has a line for each thing that is left out. Throws Error(Fault::input) as
/// `read_polygons`.
[[nodiscard]] std::optional<DressedFile> read_dressed_file(const FileBytes& file,
                                                           const LookOptions& options,
                                                           std::vector<std::string>& notes,
                                                           const Monitor& monitor);

}  // namespace curveskel
