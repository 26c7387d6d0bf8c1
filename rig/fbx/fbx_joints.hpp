// The joints of an FBX file. Internal to rig/.
#pragma once

#include <vector>

#include "surface/read/fbx_scene.hpp"

namespace curveskel {

struct FbxJoint {
  const FbxRecord* model = nullptr;
  int parent = -1;  ///< number of the nearest joint above it; -1 = none
};

/// Its limbs, parents first, in the order of `parents_first`. Must not outlive the scene.
[[nodiscard]] std::vector<FbxJoint> fbx_joints(const FbxScene& scene);

/// The number of the nearest joint above a model; -1 = none.
[[nodiscard]] int fbx_joint_above(const FbxScene& scene, const std::vector<FbxJoint>& joints,
                                  const FbxRecord& model);

}  // namespace curveskel
