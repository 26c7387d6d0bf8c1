// Rigs in other coordinates.
#pragma once

#include <Eigen/Geometry>

#include <curveskel/rig.hpp>

namespace curveskel {

/// The rig where the similarity takes it, with which it is done: `to_y_up` is the identity then.
[[nodiscard]] Rig placed(Rig rig, const Eigen::Affine3d& place);

}  // namespace curveskel
