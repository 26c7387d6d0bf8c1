// The models of an FBX file where they stood when meshes were bound to joints. Internal to
// surface/.
#pragma once

#include <Eigen/Geometry>
#include <unordered_map>

#include "surface/read/fbx_scene.hpp"

namespace curveskel {

class FbxBind {
 public:
  /// Must not outlive the scene. Throws Error(Fault::input) where matrices are broken.
  explicit FbxBind(const FbxScene& scene);

  /// True if joints that move vertices bend them away from where they were bound. A file that
  /// contradicts itself in where a mesh was bound is taken for one that does not.
  [[nodiscard]] bool is_posed() const { return is_posed_; }

  /// Of a joint as the first mesh was bound to it; others go with the joint above them; without
  /// one they stay.
  [[nodiscard]] Eigen::Affine3d frame(const FbxRecord& model) const;

  /// "TransformLink" of a cluster, or the frame of its joint where it has none.
  [[nodiscard]] Eigen::Affine3d joint(const FbxRecord& cluster, const FbxRecord& joint) const;

 private:
  const FbxScene& scene_;
  std::unordered_map<const FbxRecord*, Eigen::Affine3d> bound_;  // joints
  bool is_posed_ = false;
};

}  // namespace curveskel
