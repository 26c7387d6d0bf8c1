// Pictures beside a glTF or OBJ file, taken into the file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/gltf/gltf_document.hpp"
#include "surface/read/file_bytes.hpp"

namespace curveskel {

/// Pictures that are files of their own become buffer views, named as the files if they have no
/// name; those in the JSON stay there. `notes`
/// gets a line for each that is not found or no picture that glTF knows: it stays as it is named.
void take_in_pictures(GltfDocument& document, const FileBytes& file,
                      std::vector<std::string>& notes, const Monitor& monitor);

/// By the first bytes; nothing where it is no picture that glTF or its extensions have.
[[nodiscard]] std::optional<std::string> picture_type(std::string_view bytes);

}  // namespace curveskel
