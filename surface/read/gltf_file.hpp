// A glTF file parsed; `read_gltf_scene` walks over what it shows.
#pragma once

#include "surface/read/file_bytes.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

/// Text or GLB, with the buffers beside it; pictures are not loaded.
/// Throws Error(Fault::input), also for compressed geometry.
[[nodiscard]] tinygltf::Model parse_gltf(const FileBytes& file, const Monitor& monitor);

}  // namespace curveskel
