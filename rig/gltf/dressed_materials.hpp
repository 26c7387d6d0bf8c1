// Materials and pictures of another format as those of glTF.
#pragma once

#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "rig/gltf/dressed_mesh.hpp"
#include "rig/gltf/gltf_document.hpp"

namespace curveskel {

/// In their order. Pictures are taken in, each once, TGA, BMP, GIF and PSD as PNG; `notes` has a
/// line for each that is missing or of another kind.
void add_materials(GltfDocument& document, const std::vector<DressedMaterial>& materials,
                   std::vector<std::string>& notes, const Monitor& monitor);

}  // namespace curveskel
