// Wavefront OBJ with all that a corner of a face may name: texture coordinates, normals, materials.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// Indices from 0; -1 = none.
struct ObjCorner {
  std::int32_t place = -1;
  std::int32_t texture = -1;
  std::int32_t normal = -1;
};

/// Face f has the corners corners[offsets[f]] .. corners[offsets[f + 1] - 1].
struct ObjFile {
  std::vector<double> places;  ///< x y z x y z ...
  std::vector<std::array<float, 2>> textures;
  std::vector<std::array<float, 3>> normals;
  std::vector<ObjCorner> corners;
  std::vector<std::int64_t> offsets{0};
  std::vector<int> material_of_face;   ///< -1 = before any is named
  std::vector<std::string> materials;  ///< in the order in which faces name them
  std::vector<std::string> libraries;  ///< files of materials, as named

  /// Something that a bare rig would lose.
  [[nodiscard]] bool has_looks() const {
    return !textures.empty() || !normals.empty() || !materials.empty();
  }
};

/// Throws Error(Fault::input) as `read_polygons`. Indices of texture coordinates and normals that
/// are not there count as none.
[[nodiscard]] ObjFile read_obj_file(const FileBytes& file, const Monitor& monitor);

}  // namespace curveskel
