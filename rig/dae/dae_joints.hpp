// The joints of a COLLADA file. Internal to rig/.
#pragma once

#include <vector>

#include "surface/read/dae_nodes.hpp"

namespace curveskel {

struct DaeJoint {
  int node = -1;    ///< number among the scene's
  int parent = -1;  ///< number of the nearest joint above it; -1 = none
};

/// The nodes that say that they are joints, parents first. `nodes` are those of `dae_nodes`.
[[nodiscard]] std::vector<DaeJoint> dae_joints(const std::vector<DaeNode>& nodes);

[[nodiscard]] bool is_dae_joint(const DaeNode& node);

/// By node the number of the joint that it is, or of the nearest above it; -1 = none.
[[nodiscard]] std::vector<int> dae_joint_of_node(const std::vector<DaeNode>& nodes);

}  // namespace curveskel
