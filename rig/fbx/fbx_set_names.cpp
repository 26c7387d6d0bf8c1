#include "rig/fbx/fbx_set_names.hpp"

#include <tiny_gltf.h>

#include <algorithm>

#include <curveskel/advanced/indices.hpp>

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

}  // namespace curveskel
