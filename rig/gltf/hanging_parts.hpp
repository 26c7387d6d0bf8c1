// Meshes that hang from a joint. Internal to rig/.
#pragma once

#include <vector>

#include <curveskel/rig.hpp>
#include "rig/gltf/dressed_document.hpp"
#include "rig/gltf/dressed_mesh.hpp"

namespace curveskel {

/// The weights of a document's vertices, where meshes without a skin, such as a sword in a hand,
/// follow the joint that they hang from. `parts` are those of the file. O(weights).
[[nodiscard]] SkinWeights with_hanging_parts(const SkinWeights& weights,
                                             const DressedDocument& document,
                                             const std::vector<DressedPart>& parts);

}  // namespace curveskel
