// Joints that would only be in the way of whoever poses a rig.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include <curveskel/rig.hpp>

namespace curveskel {

/// Without the joints amid a limb that move none of `vertices` (-1 = none at all): what hangs from
/// one hangs from its parent then, and the joints of each limb are counted anew ("limb2_1",
/// "limb2_2"). The first `planned` stay, so do roots, a joint whose mirror image moves something,
/// and tips, but for those at a planned joint from which another planned one goes on as far.
/// O(weights + joints log joints).
[[nodiscard]] Rig without_idle_joints(const Rig& rig, std::size_t planned,
                                      const Eigen::VectorXi& vertices);

}  // namespace curveskel
