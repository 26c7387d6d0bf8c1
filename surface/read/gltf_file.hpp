// A glTF file parsed; `read_gltf_scene` walks over what it shows.
#pragma once

#include <string_view>

#include "surface/read/file_bytes.hpp"
#include "surface/read/gltf_compression.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

/// Text or GLB, with the buffers beside it; pictures are not loaded.
/// Compressed geometry is decompressed. Throws Error(Fault::input), by name for glTF 1.0 and for
/// required extensions that change the geometry and are not known here.
[[nodiscard]] tinygltf::Model parse_gltf(const FileBytes& file, const Monitor& monitor,
                                         GltfAttributes attributes = GltfAttributes::placing);

/// The file's JSON: the first chunk of GLB, else all. Precondition: `parse_gltf` took the file.
[[nodiscard]] std::string_view gltf_json(const FileBytes& file);

}  // namespace curveskel
