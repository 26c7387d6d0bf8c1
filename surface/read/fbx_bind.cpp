#include "surface/read/fbx_bind.hpp"

#include <algorithm>
#include <vector>

#include "surface/read/bound_joints.hpp"

namespace curveskel {

FbxBind::FbxBind(const FbxScene& scene) : scene_(scene) {
  std::vector<BoundJoint> moving;
  std::vector<std::vector<Eigen::Affine3d>> told;  // several times each: meshes, and joints
  std::unordered_map<const FbxRecord*, std::vector<Eigen::Affine3d>> joints;
  Eigen::AlignedBox3d box;
  for (const FbxRecord* deformer : scene.all("Deformer")) {
    if (deformer->text(2) != "Skin") continue;
    told.emplace_back();
    for (const FbxRecord* cluster : scene.below(*deformer, "Deformer", "Cluster")) {
      const FbxRecord* link = cluster->child("TransformLink");
      const FbxRecord* transform = cluster->child("Transform");
      const std::vector<const FbxRecord*> linked = scene.below(*cluster, "Model");
      if (link == nullptr || transform == nullptr || linked.empty()) continue;
      const Eigen::Affine3d bound = scene.matrix(*link);
      if (bound.linear().determinant() == 0) continue;
      joints[linked.front()].push_back(bound);
      told.back().push_back(bound * scene.matrix(*transform));
      box.extend(bound.translation().eval());
      if (cluster->child("Indexes") == nullptr) continue;
      moving.push_back({scene.frame(*linked.front()), bound});
    }
  }
  for (const auto& [joint, frames] : joints) {
    bound_.emplace(joint, frames.front());
    told.push_back(frames);
  }
  is_posed_ = are_posed(moving) && std::ranges::all_of(told, [&](const auto& frames) {
                return are_alike(frames, box.diagonal().norm());
              });
}

Eigen::Affine3d FbxBind::frame(const FbxRecord& model) const {
  for (const FbxRecord* next = &model; next != nullptr; next = scene_.parent(*next)) {
    const auto found = bound_.find(next);
    if (found == bound_.end()) continue;
    const Eigen::Affine3d& shown = scene_.frame(*next);
    if (shown.linear().determinant() == 0) break;
    return found->second * shown.inverse() * scene_.frame(model);
  }
  return scene_.frame(model);
}

Eigen::Affine3d FbxBind::joint(const FbxRecord& cluster, const FbxRecord& joint) const {
  const FbxRecord* link = cluster.child("TransformLink");
  return link == nullptr ? frame(joint) : scene_.matrix(*link);
}

}  // namespace curveskel
