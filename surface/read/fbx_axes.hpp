// The axes and the unit that an FBX file says it has. Internal to surface/ and rig/.
#pragma once

#include <Eigen/Geometry>

#include "surface/read/fbx_tree.hpp"

namespace curveskel {

/// From the file's coordinates to those of glTF: y up, z ahead, metres. Without axes that make
/// sense they are as in glTF; without a unit it is the centimetre.
[[nodiscard]] Eigen::Affine3d fbx_to_gltf(const FbxRecord& root);

/// True if the file says that z is up.
[[nodiscard]] bool fbx_has_z_up(const FbxRecord& root);

}  // namespace curveskel
