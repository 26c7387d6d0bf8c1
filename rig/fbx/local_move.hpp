// A frame as FBX has it: a shift, three angles and a scale. Internal to rig/.
#pragma once

#include <Eigen/Geometry>

#include "surface/read/fbx_scene.hpp"

namespace curveskel {

/// Angles about x, then y, then z; without the shear, if there is any.
[[nodiscard]] FbxMove local_move(const Eigen::Affine3d& frame);

/// Of all angles that make the same rotation those nearest to `before`.
[[nodiscard]] Eigen::Vector3d nearest_angles(const Eigen::Vector3d& angles,
                                             const Eigen::Vector3d& before);

}  // namespace curveskel
