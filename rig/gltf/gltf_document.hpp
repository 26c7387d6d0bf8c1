// A glTF file as it is: its JSON, member by member, and its numbers, byte by byte.
#pragma once

#include <nlohmann/json.hpp>

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/rig_files.hpp>
#include "surface/read/file_bytes.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

using OrderedJson = nlohmann::ordered_json;

/// All buffer views lie in one buffer, `numbers`; pictures, too, where their files were found.
struct GltfDocument {
  OrderedJson json;
  std::string numbers;
  std::string chunks;  ///< of a binary file those behind the numbers, which only some program knows
};

/// The bytes of the first buffer, unchanged, then those of the others. Files of pictures that are
/// beside the file are taken in; those that are missing, or are no pictures, are left as they are
/// named, and `notes` has a line for each. `model` is the same file, parsed.
/// Throws Error(Fault::input) where JSON and model disagree.
[[nodiscard]] GltfDocument read_gltf_document(const FileBytes& file, const tinygltf::Model& model,
                                              std::vector<std::string>& notes,
                                              const Monitor& monitor);

/// The member, which is made if there is none: an array.
[[nodiscard]] OrderedJson& array_in(OrderedJson& object, const std::string& name);

/// Appends bytes, from a multiple of four on, as a buffer view. `target` 0 = none is named.
std::size_t add_view(GltfDocument& document, std::string_view bytes, int target = 0);

/// The rows as a buffer view with an accessor of its own; returns the accessor. `type` as in glTF:
/// "VEC4"; `component` and `target` as in rig/gltf/number_bytes.hpp.
std::size_t add_accessor(GltfDocument& document, std::string_view rows, const std::string& type,
                         int component, std::size_t count, int target = 0);

/// Places of vertices, a column each, as an accessor with the bounds that the standard wants, which
/// are those of finite ones.
std::size_t add_places(GltfDocument& document, const Eigen::Matrix3Xf& places);

/// A binary file up to the end of its JSON; chunks of so many bytes, heads included, are to follow.
/// Throws Error(Fault::output) beyond 4 GB.
[[nodiscard]] std::string glb_head(std::string json, std::size_t rest);

/// As a binary file, or as text with the buffer in it. Throws Error(Fault::output) beyond 4 GB.
[[nodiscard]] std::string format_gltf(GltfDocument document, RigFormat format);

}  // namespace curveskel
