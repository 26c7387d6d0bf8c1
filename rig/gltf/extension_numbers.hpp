// Numbers in the extensions of a parsed glTF file.
#pragma once

#include <tiny_gltf.h>

#include <array>

#include <curveskel/advanced/indices.hpp>
#include "rig/gltf/texture_transform.hpp"

namespace curveskel {

/// `otherwise` where the extension is not there, or has no such number.
[[nodiscard]] inline double number_in(const tinygltf::ExtensionMap& extensions,
                                      const char* extension, const char* name, double otherwise) {
  const auto found = extensions.find(extension);
  if (found == extensions.end() || !found->second.Has(name)) return otherwise;
  const tinygltf::Value& value = found->second.Get(name);
  return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

/// As where v counts from the lower edge.
[[nodiscard]] inline TextureTransform transform_in(const tinygltf::ExtensionMap& extensions) {
  const auto found = extensions.find(texture_transform_extension);
  if (found == extensions.end()) return {};
  const auto pair = [&](const char* name, double otherwise) {
    std::array<double, 2> numbers{otherwise, otherwise};
    if (!found->second.Has(name) || found->second.Get(name).ArrayLen() != 2) return numbers;
    for (const int k : {0, 1}) numbers[idx(k)] = found->second.Get(name).Get(k).GetNumberAsDouble();
    return numbers;
  };
  return flipped({pair("scale", 1),
                  -number_in(extensions, texture_transform_extension, "rotation", 0),
                  pair("offset", 0)});
}

}  // namespace curveskel
