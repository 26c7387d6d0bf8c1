#include "rig/gltf/gltf_decoded.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/gltf/number_bytes.hpp"
#include "surface/read/gltf_compression.hpp"

namespace curveskel {
namespace {

/// True if it was there; an empty list of extensions goes, too.
bool take_out(OrderedJson& owner, std::string_view extension) {
  const auto list = owner.find("extensions");
  if (list == owner.end() || !list->contains(extension)) return false;
  list->erase(std::string(extension));
  if (list->empty()) owner.erase("extensions");
  return true;
}

std::string_view bytes_of(const tinygltf::Model& model, int view) {
  const tinygltf::BufferView& named = model.bufferViews.at(idx(view));
  const auto& data = model.buffers.at(idx(named.buffer)).data;
  return std::string_view(reinterpret_cast<const char*>(data.data()), data.size())
      .substr(named.byteOffset, named.byteLength);
}

void decode_views(GltfDocument& document, const tinygltf::Model& model) {
  OrderedJson& views = array_in(document.json, "bufferViews");
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (!take_out(views[k], meshopt_extension)) continue;
    const std::string_view bytes = bytes_of(model, static_cast<int>(k));
    document.numbers.resize((document.numbers.size() + 3) / 4 * 4);
    views[k]["buffer"] = 0;
    views[k]["byteOffset"] = document.numbers.size();
    views[k]["byteLength"] = bytes.size();
    document.numbers += bytes;
  }
}

/// Rows of vertices begin at multiples of four.
std::string padded(std::string_view rows, std::size_t count, std::size_t stride) {
  const std::size_t row = rows.size() / std::max<std::size_t>(count, 1);
  std::string all;
  for (std::size_t k = 0; k < count; ++k) {
    all += rows.substr(k * row, row);
    all.resize((k + 1) * stride);
  }
  return all;
}

/// Bounds of positions, which the standard wants; of all others none.
void set_bounds(OrderedJson& accessor, const std::string& rows, bool wanted) {
  accessor.erase("min");
  accessor.erase("max");
  if (!wanted || accessor.at("componentType") != TINYGLTF_COMPONENT_TYPE_FLOAT) return;
  const Eigen::Map<const Eigen::Matrix3Xf> points(reinterpret_cast<const float*>(rows.data()), 3,
                                                  accessor.at("count").get<Eigen::Index>());
  for (Eigen::Index k = 0; k < 3; ++k) {
    accessor["min"].push_back(points.row(k).minCoeff());
    accessor["max"].push_back(points.row(k).maxCoeff());
  }
}

/// A plain accessor with the numbers of the model's; returns its index.
std::size_t add_plain(GltfDocument& document, const tinygltf::Model& model, int decoded,
                      const OrderedJson& like, const std::string& meaning) {
  const tinygltf::Accessor& numbers = model.accessors.at(idx(decoded));
  const bool are_indices = meaning == "indices";
  const std::string_view rows = bytes_of(model, numbers.bufferView);
  const std::size_t row = rows.size() / std::max<std::size_t>(numbers.count, 1);
  const std::size_t stride = are_indices ? row : (row + 3) / 4 * 4;
  const std::string all = padded(rows, numbers.count, stride);
  const std::size_t view = add_view(document, all, are_indices ? gltf_indices : gltf_vertices);
  if (stride != row) document.json["bufferViews"][view]["byteStride"] = stride;
  OrderedJson accessor = like;
  accessor["bufferView"] = view;
  accessor.erase("byteOffset");
  accessor["componentType"] = numbers.componentType;
  accessor["count"] = numbers.count;
  set_bounds(accessor, all, meaning == "POSITION");
  OrderedJson& accessors = array_in(document.json, "accessors");
  accessors.push_back(std::move(accessor));
  return accessors.size() - 1;
}

void decode_primitive(GltfDocument& document, const tinygltf::Model& model, OrderedJson& primitive,
                      const tinygltf::Primitive& decoded) {
  for (const auto& [name, accessor] : decoded.attributes) {
    OrderedJson& named = primitive["attributes"][name];
    if (named == accessor) continue;  // was not compressed
    const OrderedJson like = document.json["accessors"].at(named.get<std::size_t>());
    named = add_plain(document, model, accessor, like, name);
  }
  const bool had_indices = primitive.contains("indices");
  if (decoded.indices < 0 || (had_indices && primitive["indices"] == decoded.indices)) return;
  const OrderedJson like =
      had_indices ? document.json["accessors"].at(primitive["indices"].get<std::size_t>())
                  : OrderedJson{{"type", "SCALAR"}};
  primitive["indices"] = add_plain(document, model, decoded.indices, like, "indices");
  primitive["mode"] = TINYGLTF_MODE_TRIANGLES;
}

void decode_primitives(GltfDocument& document, const tinygltf::Model& model) {
  OrderedJson& meshes = array_in(document.json, "meshes");
  for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
    OrderedJson& primitives = meshes[mesh]["primitives"];
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      if (!take_out(primitives[k], draco_extension)) continue;
      decode_primitive(document, model, primitives[k], model.meshes.at(mesh).primitives.at(k));
    }
  }
}

void take_out_of_list(OrderedJson& file, const std::string& list) {
  if (!file.contains(list)) return;
  OrderedJson kept = OrderedJson::array();
  for (OrderedJson& name : file[list]) {
    if (name != std::string(draco_extension) && name != std::string(meshopt_extension)) {
      kept.push_back(std::move(name));
    }
  }
  file[list] = std::move(kept);
  if (file[list].empty()) file.erase(list);
}

}  // namespace

void decode_gltf(GltfDocument& document, const tinygltf::Model& model) {
  decode_views(document, model);
  decode_primitives(document, model);
  for (OrderedJson& buffer : array_in(document.json, "buffers"))
    take_out(buffer, meshopt_extension);
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    take_out_of_list(document.json, list);
  }
}

}  // namespace curveskel
