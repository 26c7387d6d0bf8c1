#include "rig/gltf/gltf_weights.hpp"

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "rig/gltf/number_bytes.hpp"
#include "rig/gltf/skin_numbers.hpp"

namespace curveskel {
namespace {

/// Accessors of joints and of weights.
using SkinAccessors = std::pair<std::size_t, std::size_t>;

SkinAccessors add_rows(GltfDocument& document, const SkinRows& rows, std::size_t count) {
  const std::size_t joints =
      add_accessor(document, rows.joints, "VEC4", rows.in_words ? gltf_uint16 : gltf_uint8, count,
                   gltf_vertices);
  return {joints, add_accessor(document, rows.weights, "VEC4", gltf_float, count, gltf_vertices)};
}

/// Every mesh of these nodes is shown by one node alone.
void separate_meshes(OrderedJson& file, const std::set<int>& nodes) {
  std::set<std::size_t> taken;
  const auto mesh_of = [&](std::size_t node) -> OrderedJson& {
    return file["nodes"][node]["mesh"];
  };
  for (std::size_t node = 0; node < file["nodes"].size(); ++node) {
    if (nodes.contains(static_cast<int>(node)) || !file["nodes"][node].contains("mesh")) continue;
    const OrderedJson& mesh = mesh_of(node);
    if (mesh.is_number_unsigned()) taken.insert(mesh.get<std::size_t>());  // else of no mesh
  }
  for (const int node : nodes) {
    OrderedJson& mesh = mesh_of(static_cast<std::size_t>(node));
    if (taken.insert(mesh.get<std::size_t>()).second) continue;
    OrderedJson copy = file["meshes"][mesh.get<std::size_t>()];
    mesh = file["meshes"].size();
    file["meshes"].push_back(std::move(copy));
  }
}

void strip_weights(OrderedJson& mesh) {
  for (OrderedJson& primitive : mesh.at("primitives")) {
    OrderedJson kept = OrderedJson::object();
    for (const auto& [name, accessor] : primitive.at("attributes").items()) {
      if (!name.starts_with("JOINTS_") && !name.starts_with("WEIGHTS_")) kept[name] = accessor;
    }
    primitive["attributes"] = std::move(kept);
  }
}

}  // namespace

void write_gltf_weights(GltfDocument& document, const std::vector<GltfPart>& parts,
                        const GltfWeights& weights,
                        const std::vector<GltfSkinJoints>& joints_of_part) {
  std::set<int> nodes;
  for (const GltfPart& part : parts) nodes.insert(part.node);
  separate_meshes(document.json, nodes);
  const auto mesh_of = [&](int node) -> OrderedJson& {
    OrderedJson& file = document.json;
    return file["meshes"][file["nodes"][static_cast<std::size_t>(node)]["mesh"].get<std::size_t>()];
  };
  for (const int node : nodes) strip_weights(mesh_of(node));
  std::map<std::tuple<bool, std::int64_t, int>, SkinAccessors> known;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const GltfPart& part = parts[k];
    const GltfSkinJoints& skin = joints_of_part[k];
    const auto [entry, is_new] = known.try_emplace({part.in_soup, part.first_vertex, skin.skin});
    if (is_new) {
      const SkinWeights& all = part.in_soup ? weights.of_soup : weights.of_loose;
      entry->second = add_rows(document, skin_rows(all, part.first_vertex, part.count, skin.joints),
                               static_cast<std::size_t>(part.count));
    }
    OrderedJson& primitive =
        mesh_of(part.node)["primitives"][static_cast<std::size_t>(part.primitive)];
    primitive["attributes"]["JOINTS_0"] = entry->second.first;
    primitive["attributes"]["WEIGHTS_0"] = entry->second.second;
  }
}

}  // namespace curveskel
