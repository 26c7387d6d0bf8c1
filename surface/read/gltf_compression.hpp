// Compressed glTF made plain: KHR_draco_mesh_compression and EXT_meshopt_compression.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <curveskel/monitor.hpp>
#include "surface/read/file_bytes.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

/// The JSON such that tinygltf takes it, where it speaks of compression; else nothing. tinygltf
/// refuses indices without a buffer view, as Draco leaves them, and buffers without content, as
/// meshopt leaves them to programs that do not decompress: the former are taken out, the latter get
/// three bytes. `binary`: the first buffer is the file's own.
[[nodiscard]] std::optional<std::string> json_for_tinygltf(std::string_view json, bool binary);

/// Of what Draco has: those that place vertices (positions, joints, weights), or all.
enum class GltfAttributes { placing, all };

/// Decompresses all that is compressed into buffers of its own, to which accessors and buffer views
/// then point. A primitive that has its numbers uncompressed, too, stays as it is.
/// Throws Error(Fault::input) where the data are broken or announce more than they can hold.
void decompress_gltf(const FileBytes& file, tinygltf::Model& model, GltfAttributes attributes,
                     const Monitor& monitor);

/// The parts of `decompress_gltf`.
void decompress_meshopt(const FileBytes& file, tinygltf::Model& model, const Monitor& monitor);
void decompress_draco(const FileBytes& file, tinygltf::Model& model, GltfAttributes attributes,
                      const Monitor& monitor);

inline constexpr std::string_view draco_extension = "KHR_draco_mesh_compression";
inline constexpr std::string_view meshopt_extension = "EXT_meshopt_compression";

}  // namespace curveskel
