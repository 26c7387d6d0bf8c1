// Meshes and places that hang from joints. Internal to rig/.
#pragma once

#include <vector>

#include <curveskel/rig.hpp>
#include "rig/animations/add_joint_animations.hpp"
#include "rig/gltf/dressed_document.hpp"
#include "rig/gltf/dressed_mesh.hpp"

namespace curveskel {

/// The weights of a document's vertices, where meshes without a skin, such as a sword in a hand,
/// follow the joint that they hang from. `parts` are those of the file. O(weights).
[[nodiscard]] SkinWeights with_hanging_parts(const SkinWeights& weights,
                                             const DressedDocument& document,
                                             const std::vector<DressedPart>& parts);

/// A node for each place that hangs from a joint of an FBX or COLLADA file without being one or
/// having a mesh, such as a socket for a sword; it hangs from the joint's node. Throws
/// Error(Fault::input). O(nodes).
void add_hanging_places(GltfDocument& document, const FileBytes& file, const GltfJoints& joints,
                        const Monitor& monitor);

}  // namespace curveskel
