#include "surface/read/gltf_compression.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>

namespace curveskel {
namespace {

using GltfJson = nlohmann::json;

/// The member of an object, where there is one; else null.
const GltfJson& member(const GltfJson& of, std::string_view name) {
  static const GltfJson nothing;
  const auto found = of.is_object() ? of.find(name) : of.end();
  return found == of.end() ? nothing : *found;
}

GltfJson* array_of(GltfJson& file, std::string_view name) {
  const auto found = file.is_object() ? file.find(name) : file.end();
  return found == file.end() || !found->is_array() ? nullptr : &*found;
}

void fill_empty_buffers(GltfJson& file, bool binary) {
  GltfJson* buffers = array_of(file, "buffers");
  if (buffers == nullptr) return;
  for (std::size_t i = 0; i < buffers->size(); ++i) {
    GltfJson& buffer = (*buffers)[i];
    if (!buffer.is_object()) continue;
    const GltfJson& fallback =
        member(member(member(buffer, "extensions"), meshopt_extension), "fallback");
    const bool has_content = buffer.contains("uri") || (binary && i == 0);
    if (has_content && fallback != true) continue;
    buffer["uri"] = "data:application/octet-stream;base64,AAAA";
    buffer["byteLength"] = 3;
  }
}

void take_out_empty_indices(GltfJson& file) {
  GltfJson* meshes = array_of(file, "meshes");
  GltfJson* accessors = array_of(file, "accessors");
  if (meshes == nullptr || accessors == nullptr) return;
  for (GltfJson& mesh : *meshes) {
    GltfJson* primitives = array_of(mesh, "primitives");
    if (primitives == nullptr) continue;
    for (GltfJson& primitive : *primitives) {
      if (!member(member(primitive, "extensions"), draco_extension).is_object()) continue;
      const GltfJson& indices = member(primitive, "indices");
      if (!indices.is_number_unsigned()) continue;
      const auto accessor = indices.get<std::size_t>();
      if (accessor < accessors->size() &&
          !member((*accessors)[accessor], "bufferView").is_number()) {
        primitive.erase("indices");
      }
    }
  }
}

}  // namespace

std::optional<std::string> json_for_tinygltf(std::string_view json, bool binary) {
  const auto mentions = [&](std::string_view name) { return json.find(name) != json.npos; };
  if (!mentions(draco_extension) && !mentions(meshopt_extension)) return std::nullopt;
  GltfJson file = GltfJson::parse(json, nullptr, false);
  if (file.is_discarded()) return std::nullopt;  // tinygltf says why
  fill_empty_buffers(file, binary);
  take_out_empty_indices(file);
  return file.dump(-1, ' ', false, GltfJson::error_handler_t::replace);
}

void decompress_gltf(const FileBytes& file, tinygltf::Model& model, GltfAttributes attributes,
                     const Monitor& monitor) {
  decompress_meshopt(file, model, monitor);
  decompress_draco(file, model, attributes, monitor);
}

}  // namespace curveskel
