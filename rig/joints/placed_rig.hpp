// Rigs in other coordinates.
#pragma once

#include <Eigen/Geometry>

#include <curveskel/rig.hpp>

namespace curveskel {

/// The rig moved by a similarity. Its `to_y_up` is spent then, the identity.
[[nodiscard]] Rig placed(Rig rig, const Eigen::Affine3d& place);

}  // namespace curveskel
