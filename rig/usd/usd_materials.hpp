// The materials of a glTF file as UsdPreviewSurface. Internal to rig/.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "rig/usd/usd_pictures.hpp"
#include "rig/usd/usd_text.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

struct UsdMaterials {
  std::vector<std::string> paths;  ///< of each material of the file
  /// Of each that shows colours of vertices, by which factor these show, else all 1.
  std::vector<std::array<double, 4>> colour_factors;
};

/// A scope with all of them below the prim `root`, whose body is open: colours, roughness, metal,
/// light of their own, opacity (of MASK with its threshold), clear coat, and the pictures of these,
/// of normals and of occlusion; `KHR_texture_transform`. Colours of vertices show where there is no
/// picture of colour, as of two factors USD takes one.
[[nodiscard]] UsdMaterials write_usd_materials(UsdText& text, const tinygltf::Model& model,
                                               const std::string& root, UsdPictures& pictures);

}  // namespace curveskel
