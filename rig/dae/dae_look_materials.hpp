// Materials of a COLLADA file.
#pragma once

#include <string>
#include <vector>

#include "rig/gltf/dressed_mesh.hpp"
#include "surface/read/dae_document.hpp"

namespace curveskel {

/// A material as one mesh shows it.
struct DaeMaterialUse {
  const XmlElement& material;
  const XmlElement* binding;             ///< <instance_material>, or nullptr
  const std::vector<std::size_t>& sets;  ///< of texture coordinates that the mesh has there
};

/// The look of a <material>, see `read_dae_looks`. Throws Error(Fault::input) with the line.
[[nodiscard]] DressedMaterial dae_look_of(const FileBytes& file, const DaeDocument& document,
                                          const DaeMaterialUse& use,
                                          std::vector<std::string>& notes);

}  // namespace curveskel
