// Joints over time in an animation of a glTF document. Internal to rig/.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include <curveskel/rig.hpp>
#include "rig/animations/gltf_clip.hpp"
#include "rig/animations/joint_animation.hpp"
#include "rig/animations/node_move.hpp"

namespace curveskel {

/// The joints of a document whose coordinates are `to_gltf` times the file's. `rig` is in the
/// document's, its joint k is node `first` + k, turned by `bone_axes`; it has the joints of the
/// animations.
struct GltfJoints {
  const Rig& rig;
  std::size_t first;
  Eigen::Affine3d to_gltf;
};

/// In the world of the document, turned by `bone_axes`.
[[nodiscard]] JointFrames bound_frames(const Rig& rig);

class JointMover {
 public:
  JointMover(GltfJoints joints, const JointFrames& rest);

  /// Each joint moves from where the rig has it as the file's joint moves from its rest; one whose
  /// rest is no frame, as its scale is zero, goes with its parent. A shear, which glTF has not, is
  /// left out. Numbers that stay as at rest have no channel. O(joints times moments).
  void add(GltfClip& clip, const JointAnimation& animation) const;

 private:
  /// One joint's node over time.
  using Moves = std::vector<NodeMove>;

  void take(const JointFrames& frames, std::vector<Moves>& moves) const;
  void add_joint(GltfClip& clip, std::size_t joint, const Moves& moves, std::size_t times) const;

  GltfJoints joints_;
  JointFrames bound_;            // in the world of the document
  JointFrames back_;             // of the file's joints, from the world
  std::vector<bool> has_frame_;  // by joint
  double size_ = 0;
};

}  // namespace curveskel
