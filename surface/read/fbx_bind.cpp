#include "surface/read/fbx_bind.hpp"

#include <algorithm>
#include <vector>

#include <curveskel/error.hpp>

namespace curveskel {
namespace {

std::optional<Eigen::Affine3d> usable_matrix(const FbxScene& scene, const FbxRecord* record) {
  if (record == nullptr) return std::nullopt;
  try {
    return scene.matrix(*record);
  } catch (const Error&) {
    return std::nullopt;  // what is shown may not depend on it
  }
}

int models_above(const FbxScene& scene, const FbxRecord& model) {
  int count = 0;
  for (const FbxRecord* next = scene.parent(model); next != nullptr; next = scene.parent(*next)) {
    ++count;
  }
  return count;
}

}  // namespace

FbxBind::FbxBind(const FbxScene& scene) : scene_(scene) {
  BoundJoints joints;
  read(joints);
  join_chains(joints);
  for (const FbxRecord* skin : scene.all("Deformer")) {
    std::vector<Eigen::Affine3d> told;
    for (const FbxRecord* cluster : scene.below(*skin, "Deformer", "Cluster")) {
      const auto found = clusters_.find(cluster);
      if (found != clusters_.end()) told.push_back(found->second.mesh);
    }
    if (!are_alike(told, joints.size())) return;
  }
  joints_ = joints.bent_figures();
}

void FbxBind::read(BoundJoints& joints) {
  for (const FbxRecord* skin : scene_.all("Deformer")) {
    if (skin->text(2) != "Skin") continue;
    for (const FbxRecord* cluster : scene_.below(*skin, "Deformer", "Cluster")) {
      const auto link = usable_matrix(scene_, cluster->child("TransformLink"));
      const auto transform = usable_matrix(scene_, cluster->child("Transform"));
      const std::vector<const FbxRecord*> linked = scene_.below(*cluster, "Model");
      if (!link || !transform || linked.empty() || !is_invertible(*link)) continue;
      const FbxRecord& joint = *linked.front();
      clusters_.emplace(cluster, Cluster{&joint, *link, *link * *transform});
      joints.add(&joint, {scene_.frame(joint), *link, models_above(scene_, joint),
                          cluster->child("Indexes") != nullptr});
      joints.join(&joint, skin);
    }
  }
}

/// Joints hang from each other where there is nothing but joints between them.
void FbxBind::join_chains(BoundJoints& joints) const {
  for (const FbxRecord* model : scene_.all("Model")) {
    if (!joints.contains(model)) continue;
    const FbxRecord* topmost = model;
    const FbxRecord* next = scene_.parent(*model);
    for (; next != nullptr; next = scene_.parent(*next)) {
      if (!is_fbx_joint(*next) && !joints.contains(next)) break;
      topmost = next;
    }
    joints.join(model, topmost);
  }
}

Eigen::Affine3d FbxBind::frame(const FbxRecord& model) const {
  for (const FbxRecord* next = &model; next != nullptr; next = scene_.parent(*next)) {
    const auto found = joints_.find(next);
    if (found == joints_.end()) continue;
    const Eigen::Affine3d& shown = scene_.frame(*next);
    if (!is_invertible(shown)) break;
    const auto& [bound, move] = found->second;
    return move * bound * shown.inverse() * scene_.frame(model);
  }
  return scene_.frame(model);
}

Eigen::Affine3d FbxBind::joint(const FbxRecord& cluster, const FbxRecord& joint) const {
  const auto told = clusters_.find(&cluster);
  const auto found = joints_.find(&joint);
  if (told == clusters_.end() || found == joints_.end()) return frame(joint);
  return found->second.move * told->second.link;
}

std::optional<Eigen::Affine3d> FbxBind::mesh(const FbxRecord& geometry) const {
  for (const FbxRecord* skin : scene_.below(geometry, "Deformer", "Skin")) {
    for (const FbxRecord* cluster : scene_.below(*skin, "Deformer", "Cluster")) {
      const auto told = clusters_.find(cluster);
      if (told == clusters_.end()) continue;
      const auto found = joints_.find(told->second.joint);
      if (found != joints_.end()) return found->second.move * told->second.mesh;
    }
  }
  return std::nullopt;
}

}  // namespace curveskel
