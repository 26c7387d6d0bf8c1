#include "rig/fbx/fbx_joints.hpp"

#include <algorithm>
#include <unordered_map>

#include <curveskel/advanced/indices.hpp>
#include "rig/joints/parents_first.hpp"

namespace curveskel {

std::vector<FbxJoint> fbx_joints(const FbxScene& scene) {
  std::unordered_map<const FbxRecord*, int> number;
  std::vector<const FbxRecord*> models;
  for (const FbxRecord* model : scene.all("Model")) {
    if (!is_fbx_joint(*model)) continue;
    number.emplace(model, static_cast<int>(models.size()));
    models.push_back(model);
  }
  std::vector<int> parents;
  for (const FbxRecord* model : models) {
    const FbxRecord* above = scene.parent(*model);
    while (above != nullptr && !number.contains(above)) above = scene.parent(*above);
    parents.push_back(above == nullptr ? -1 : number.at(above));
  }
  std::vector<FbxJoint> joints;
  std::vector<int> place(models.size(), -1);  // of a joint, in the order
  for (const int joint : parents_first(parents)) {
    const int parent = parents[idx(joint)];
    place[idx(joint)] = static_cast<int>(joints.size());
    joints.push_back({models[idx(joint)], parent < 0 ? -1 : place[idx(parent)]});
  }
  return joints;
}

int fbx_joint_above(const FbxScene& scene, const std::vector<FbxJoint>& joints,
                    const FbxRecord& model) {
  const FbxRecord* above = scene.parent(model);
  while (above != nullptr && !is_fbx_joint(*above)) above = scene.parent(*above);
  const auto found = std::ranges::find(joints, above, &FbxJoint::model);
  return found == joints.end() ? -1 : static_cast<int>(found - joints.begin());
}

}  // namespace curveskel
