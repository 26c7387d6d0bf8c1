// The models of an FBX file where they stood when meshes were bound to joints. Internal to
// surface/ and rig/.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <unordered_map>

#include "surface/read/bound_joints.hpp"
#include "surface/read/fbx_scene.hpp"

namespace curveskel {

/// Figures that joints bend are as they were bound, each moved so that its topmost joint is where
/// the scene shows it; all else stays as shown. A file that contradicts itself in where a mesh or a
/// joint was bound is taken for one in which nothing is bent.
class FbxBind {
 public:
  /// Must not outlive the scene. Clusters with broken matrices tell nothing.
  explicit FbxBind(const FbxScene& scene);

  /// True if joints that move vertices bend them away from where they were bound.
  [[nodiscard]] bool is_posed() const { return !joints_.empty(); }

  /// Of a joint as the first mesh was bound to it; others go with the joint above them; without
  /// one they stay.
  [[nodiscard]] Eigen::Affine3d frame(const FbxRecord& model) const;

  /// That of its joint, as the cluster's own mesh was bound to it.
  [[nodiscard]] Eigen::Affine3d joint(const FbxRecord& cluster, const FbxRecord& joint) const;

  /// The mesh's place, as its clusters tell; nothing if they tell none.
  [[nodiscard]] std::optional<Eigen::Affine3d> mesh(const FbxRecord& geometry) const;

 private:
  /// The joints that clusters name, and what those say.
  void read(BoundJoints& joints);
  void join_chains(BoundJoints& joints) const;

  struct Cluster {
    const FbxRecord* joint;
    Eigen::Affine3d link;
    Eigen::Affine3d mesh;
  };

  const FbxScene& scene_;
  std::unordered_map<const FbxRecord*, Cluster> clusters_;
  std::unordered_map<SceneNode, MovedJoint> joints_;  // of figures that are bent
};

}  // namespace curveskel
