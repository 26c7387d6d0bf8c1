// KHR_draco_mesh_compression: primitives whose triangles and vertices Draco has encoded.
#include <tiny_gltf.h>

#include <draco/compression/decode.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "surface/read/gltf_compression.hpp"
#include "surface/read/gltf_numbers.hpp"

namespace curveskel {
namespace {

std::optional<int> component_type(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return TINYGLTF_COMPONENT_TYPE_BYTE;
    case draco::DT_UINT8:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    case draco::DT_INT16:
      return TINYGLTF_COMPONENT_TYPE_SHORT;
    case draco::DT_UINT16:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    case draco::DT_UINT32:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    case draco::DT_FLOAT32:
      return TINYGLTF_COMPONENT_TYPE_FLOAT;
    default:
      return std::nullopt;
  }
}

/// The numbers of faces and vertices that the data announce, the larger of both; 0: unknown, as
/// metadata come first, or the data are older than version 2.2.
std::uint64_t announced_count(const unsigned char* data, std::size_t size) {
  constexpr std::size_t header = 11;  // "DRACO", version, kind, method, flags
  if (size < header + 1 || std::memcmp(data, "DRACO", 5) != 0) return 0;
  const bool has_metadata = (data[10] & 0x80U) != 0;
  if (has_metadata || data[5] * 256 + data[6] < 2 * 256 + 2) return 0;
  const bool by_edges = data[8] == 1;  // then the kind of traversal is named first
  std::size_t at = header + (by_edges ? 1 : 0);
  std::uint64_t largest = 0;
  for (int k = 0; k < 2; ++k) {
    std::uint64_t number = 0;
    for (unsigned shift = 0; at < size && shift < 63; shift += 7) {
      const unsigned char byte = data[at++];
      number |= static_cast<std::uint64_t>(byte & 0x7fU) << shift;
      if ((byte & 0x80U) == 0) break;
    }
    largest = std::max(largest, number);
  }
  return largest;
}

class DracoPrimitive {
 public:
  DracoPrimitive(const FileBytes& file, tinygltf::Model& model, tinygltf::Primitive& primitive)
      : file_(file),
        model_(model),
        primitive_(primitive),
        extension_(primitive.extensions.at(std::string(draco_extension))) {}

  void decode(GltfAttributes attributes) {
    if (!extension_.IsObject() || !extension_.Get("attributes").IsObject()) refuse("no attributes");
    mesh_ = decoded();
    add_indices();
    for (auto& [name, accessor] : primitive_.attributes) {
      const bool places = attributes == GltfAttributes::all || name == "POSITION" ||
                          name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
      const tinygltf::Value& id = extension_.Get("attributes").Get(name);
      if (places && id.IsNumber()) accessor = add_attribute(name, accessor, id.GetNumberAsInt());
    }
  }

 private:
  [[nodiscard]] std::unique_ptr<draco::Mesh> decoded() const {
    const tinygltf::Value& named = extension_.Get("bufferView");
    const auto& view = gltf_element(file_, model_.bufferViews,
                                    named.IsNumber() ? named.GetNumberAsInt() : -1, "buffer view");
    const auto& bytes = gltf_element(file_, model_.buffers, view.buffer, "buffer").data;
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset) {
      refuse(std::to_string(view.byteLength) + " bytes from " + std::to_string(view.byteOffset) +
             " of " + std::to_string(bytes.size()));
    }
    const unsigned char* data = bytes.data() + view.byteOffset;
    // The most regular meshes have a few hundred vertices a byte.
    const std::uint64_t most = 1'000'000 + 1000 * static_cast<std::uint64_t>(view.byteLength);
    if (const auto count = announced_count(data, view.byteLength); count > most) {
      refuse(std::to_string(count) + " faces or vertices in " + std::to_string(view.byteLength) +
             " bytes");
    }
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(data), view.byteLength);
    std::string reason;
    try {
      auto result = draco::Decoder().DecodeMeshFromBuffer(&buffer);
      if (result.ok()) return std::move(result).value();
      reason = result.status().error_msg_string();
    } catch (const std::exception& failure) {
      reason = failure.what();
    }
    refuse("data that Draco refuses: " + reason);
  }

  void add_indices() {
    std::vector<unsigned char> bytes(std::size_t{12} * mesh_->num_faces());
    for (draco::FaceIndex face(0); face < mesh_->num_faces(); ++face) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = mesh_->face(face)[k].value();
        std::memcpy(bytes.data() + 12 * std::size_t{face.value()} + 4 * k, &vertex, 4);
      }
    }
    tinygltf::Accessor accessor;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.count = std::size_t{3} * mesh_->num_faces();
    primitive_.indices = add(std::move(accessor), std::move(bytes));
    primitive_.mode = TINYGLTF_MODE_TRIANGLES;
  }

  /// In the type that Draco has kept, which is the type that went in.
  int add_attribute(const std::string& name, int of, int id) {
    tinygltf::Accessor accessor = gltf_element(file_, model_.accessors, of, "accessor");
    const draco::PointAttribute* attribute =
        id < 0 ? nullptr : mesh_->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
    const auto type = attribute == nullptr ? std::nullopt : component_type(attribute->data_type());
    if (!type || attribute->num_components() !=
                     tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type))) {
      refuse("attribute " + std::to_string(id) + " for " + in_quotes(name) +
             " that is not there or of another type");
    }
    const auto row_bytes = static_cast<std::size_t>(attribute->byte_stride());
    std::vector<unsigned char> bytes(row_bytes * mesh_->num_points());
    for (draco::PointIndex point(0); point < mesh_->num_points(); ++point) {
      const draco::AttributeValueIndex row = attribute->mapped_index(point);
      if (row.value() >= attribute->size()) refuse("a vertex without " + in_quotes(name));
      attribute->GetValue(row, bytes.data() + row_bytes * point.value());
    }
    accessor.componentType = *type;
    accessor.count = mesh_->num_points();
    return add(std::move(accessor), std::move(bytes));
  }

  int add(tinygltf::Accessor accessor, std::vector<unsigned char> bytes) {
    tinygltf::BufferView view;
    view.buffer = static_cast<int>(model_.buffers.size());
    view.byteLength = bytes.size();
    tinygltf::Buffer buffer;
    buffer.data = std::move(bytes);
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    accessor.byteOffset = 0;
    accessor.sparse.isSparse = false;
    model_.buffers.push_back(std::move(buffer));
    model_.bufferViews.push_back(std::move(view));
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  [[noreturn]] void refuse(const std::string& found) const {
    file_.fail(found + " (" + std::string(draco_extension) + ")", "what the extension prescribes",
               "compress the file again, with gltf-transform");
  }

  const FileBytes& file_;
  tinygltf::Model& model_;
  tinygltf::Primitive& primitive_;
  const tinygltf::Value extension_;
  std::unique_ptr<draco::Mesh> mesh_;
};

/// With its positions beside the compressed ones.
bool has_plain_numbers(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const auto positions = primitive.attributes.find("POSITION");
  if (positions == primitive.attributes.end()) return false;
  const auto accessor = static_cast<std::size_t>(positions->second);
  return primitive.indices >= 0 && accessor < model.accessors.size() &&
         model.accessors[accessor].bufferView >= 0;
}

}  // namespace

void decompress_draco(const FileBytes& file, tinygltf::Model& model, GltfAttributes attributes,
                      const Monitor& monitor) {
  for (tinygltf::Mesh& mesh : model.meshes) {
    for (tinygltf::Primitive& primitive : mesh.primitives) {
      if (!primitive.extensions.contains(std::string(draco_extension))) continue;
      monitor.report("read", 0.3);
      if (!has_plain_numbers(model, primitive))
        DracoPrimitive(file, model, primitive).decode(attributes);
    }
  }
}

}  // namespace curveskel
