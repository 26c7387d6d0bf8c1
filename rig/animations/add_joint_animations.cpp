#include "rig/animations/add_joint_animations.hpp"

#include <algorithm>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/joints/bone_axes.hpp"
#include "surface/read/bound_joints.hpp"

namespace curveskel {
namespace {

using Eigen::Affine3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

}  // namespace

JointFrames bound_frames(const Rig& rig) {
  const std::vector<Quaterniond> axes = bone_axes(rig);
  JointFrames frames;
  for (std::size_t joint = 0; joint < axes.size(); ++joint) {
    const Vector3d place = rig.joints.row(static_cast<Eigen::Index>(joint)).transpose();
    frames.push_back(Eigen::Translation3d(place) * axes[joint]);
  }
  return frames;
}

JointMover::JointMover(GltfJoints joints, const JointFrames& rest)
    : joints_(std::move(joints)), bound_(bound_frames(joints_.rig)) {
  for (const Affine3d& frame : rest) {
    const bool is_frame = is_invertible(frame);
    has_frame_.push_back(is_frame);
    back_.push_back(is_frame ? Affine3d(frame.inverse()) : Affine3d::Identity());
  }
  const Eigen::RowVector3d low = joints_.rig.joints.colwise().minCoeff();
  const Eigen::RowVector3d high = joints_.rig.joints.colwise().maxCoeff();
  size_ = std::max((high - low).norm(), std::max(low.norm(), high.norm()));
}

void JointMover::add(GltfClip& clip, const JointAnimation& animation) const {
  std::vector<double> seconds;
  std::vector<Moves> moves(bound_.size());  // by joint
  for (const std::size_t k : clip.distinct(animation.seconds)) {
    seconds.push_back(animation.seconds[k]);
    take(animation.frames[k], moves);
  }
  const std::size_t times = clip.add_times(seconds);
  for (std::size_t joint = 0; joint < moves.size(); ++joint) {
    add_joint(clip, joint, moves[joint], times);
  }
}

void JointMover::take(const JointFrames& frames, std::vector<Moves>& moves) const {
  JointFrames moved;  // in the world of the document
  const Affine3d from_gltf = joints_.to_gltf.inverse();
  for (std::size_t joint = 0; joint < bound_.size(); ++joint) {
    const int parent = joints_.rig.parents[static_cast<Eigen::Index>(joint)];
    Affine3d now = joints_.to_gltf * frames[joint] * back_[joint] * from_gltf * bound_[joint];
    if (!has_frame_[joint]) {
      now = parent < 0 ? bound_[joint]
                       : moved[idx(parent)] * bound_[idx(parent)].inverse() * bound_[joint];
    }
    moved.push_back(now);
    const bool hangs = parent >= 0 && is_invertible(moved[idx(parent)]);
    NodeMove move = node_move(hangs ? moved[idx(parent)].inverse() * now : now);
    if (!moves[joint].empty() && move.turn.dot(moves[joint].back().turn) < 0) {
      move.turn.coeffs() *= -1;
    }
    moves[joint].push_back(move);
  }
}

void JointMover::add_joint(GltfClip& clip, std::size_t joint, const Moves& moves,
                           std::size_t times) const {
  const int parent = joints_.rig.parents[static_cast<Eigen::Index>(joint)];
  const NodeMove rest =
      node_move(parent < 0 ? bound_[joint] : bound_[idx(parent)].inverse() * bound_[joint]);
  GltfRows shift{"translation", "VEC3", {}};
  GltfRows turn{"rotation", "VEC4", {}};
  GltfRows scale{"scale", "VEC3", {}};
  for (const NodeMove& move : moves) {
    shift.rows.emplace_back(move.shift);
    turn.rows.emplace_back(move.turn.coeffs());
    scale.rows.emplace_back(move.scale);
  }
  const bool is_turned_back = !moves.empty() && moves.front().turn.dot(rest.turn) < 0;
  const Eigen::Vector4d turned = (is_turned_back ? -1 : 1) * rest.turn.coeffs();
  const std::size_t node = joints_.first + joint;
  if (!shift.stays_at(rest.shift, size_)) clip.add_channel(node, shift, times);
  if (!turn.stays_at(turned, 1)) clip.add_channel(node, turn, times);
  if (!scale.stays_at(rest.scale, 1)) clip.add_channel(node, scale, times);
}

}  // namespace curveskel
