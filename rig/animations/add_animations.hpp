// Animations of a file other than glTF in a glTF document. Internal to rig/.
#pragma once

#include <vector>

#include "rig/animations/add_joint_animations.hpp"
#include "rig/animations/joint_animation.hpp"
#include "rig/animations/shape_animation.hpp"
#include "rig/gltf/gltf_document.hpp"

namespace curveskel {

/// One for each clip of the file that moves joints or shapes. `node_of_part`: of each part the node
/// with its mesh, -1 = left out; a mesh's weights are those at rest. Times before 0, which glTF has
/// not, move the whole animation; numbers that stay as at rest have no channel. O(numbers).
void add_animations(GltfDocument& document, const AnimatedJoints& joints, const GltfJoints& made,
                    const std::vector<ShapeAnimation>& shapes,
                    const std::vector<int>& node_of_part);

}  // namespace curveskel
