#include "rig/fbx/fbx_set_names.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstdint>
#include <map>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>

namespace curveskel {
namespace {

std::string numbered(const std::string& name, std::size_t number) {
  if (number == 0) return name;
  const std::string digits = std::to_string(number);
  return name + "." + std::string(3 - std::min<std::size_t>(3, digits.size()), '0') + digits;
}

/// Of the first primitive that has the attribute, or nullptr.
const tinygltf::Accessor* accessor_of(const tinygltf::Model& model, const tinygltf::Mesh& mesh,
                                      const std::string& attribute) {
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    if (primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES) continue;
    const auto found = primitive.attributes.find(attribute);
    const bool is_there = found != primitive.attributes.end() && found->second >= 0 &&
                          idx(found->second) < model.accessors.size();
    if (is_there) return &model.accessors[idx(found->second)];
  }
  return nullptr;
}

bool has_texture(const tinygltf::Material& material) {
  return material.pbrMetallicRoughness.baseColorTexture.index >= 0 ||
         material.normalTexture.index >= 0 || material.emissiveTexture.index >= 0;
}

/// Meshes that share a textured material, be it by way of others, have one number.
std::vector<int> groups_by_textures(const tinygltf::Model& model) {
  UnionFind groups(static_cast<std::int64_t>(model.meshes.size()));
  std::map<int, int> first_with;  // by material
  for (int mesh = 0; idx(mesh) < model.meshes.size(); ++mesh) {
    for (const tinygltf::Primitive& primitive : model.meshes[idx(mesh)].primitives) {
      const int material = primitive.material;
      if (material < 0 || idx(material) >= model.materials.size()) continue;
      if (!has_texture(model.materials[idx(material)])) continue;
      groups.unite(mesh, first_with.try_emplace(material, mesh).first->second);
    }
  }
  return groups.numbers();
}

}  // namespace

std::vector<std::string> fbx_set_names(const tinygltf::Model& model, const tinygltf::Mesh& mesh,
                                       const FbxSetKind& kind) {
  std::vector<std::string> names;
  const auto is_taken = [&](const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  for (;;) {
    const std::string attribute = kind.attribute + std::to_string(names.size() + kind.first_set);
    const tinygltf::Accessor* accessor = accessor_of(model, mesh, attribute);
    if (accessor == nullptr) return names;
    std::string name = accessor->name;
    for (std::size_t k = names.size(); name.empty() || is_taken(name); ++k) {
      name = numbered(kind.name, k);
    }
    names.push_back(std::move(name));
  }
}

std::vector<std::vector<std::string>> fbx_map_names(const tinygltf::Model& model) {
  std::vector<std::vector<std::string>> names;
  for (const tinygltf::Mesh& mesh : model.meshes) {
    names.push_back(fbx_set_names(model, mesh, fbx_maps));
  }
  const std::vector<int> group_of = groups_by_textures(model);
  std::vector<std::vector<std::string>> common(names.size());  // of a group
  std::vector<bool> agrees(names.size(), true);
  for (std::size_t mesh = 0; mesh < names.size(); ++mesh) {
    std::vector<std::string>& others = common[idx(group_of[mesh])];
    const auto [own, other] = std::ranges::mismatch(names[mesh], others);
    if (own != names[mesh].end() && other != others.end()) agrees[idx(group_of[mesh])] = false;
    if (names[mesh].size() > others.size()) others = names[mesh];
  }
  for (std::size_t mesh = 0; mesh < names.size(); ++mesh) {
    if (agrees[idx(group_of[mesh])]) continue;
    for (std::size_t k = 0; k < names[mesh].size(); ++k) {
      names[mesh][k] = numbered(fbx_maps.name, k);
    }
  }
  return names;
}

}  // namespace curveskel
