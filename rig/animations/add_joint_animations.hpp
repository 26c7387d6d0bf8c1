// Animations of joints in a glTF document. Internal to rig/.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>

#include <curveskel/rig.hpp>
#include "rig/animations/joint_animation.hpp"
#include "rig/gltf/gltf_document.hpp"

namespace curveskel {

/// The document's coordinates are `to_gltf` times the file's. `rig` is in the document's, its joint
/// k is node `first` + k, turned by `bone_axes`; it has the joints of the animations. Each joint
/// moves from where the rig has it as the file's joint moves from its rest; one whose rest is no
/// frame, as its scale is zero, goes with its parent. A shear, which glTF has not, is left out.
/// Numbers that stay as at rest have no channel. Times before 0, which glTF has not, move the whole
/// animation. O(joints times moments).
void add_joint_animations(GltfDocument& document, const AnimatedJoints& animated, const Rig& rig,
                          std::size_t first, const Eigen::Affine3d& to_gltf);

}  // namespace curveskel
