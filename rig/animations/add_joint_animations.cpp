#include "rig/animations/add_joint_animations.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "base/utf8.hpp"
#include "rig/animations/node_move.hpp"
#include "rig/gltf/number_bytes.hpp"
#include "rig/joints/bone_axes.hpp"
#include "surface/read/bound_joints.hpp"

namespace curveskel {
namespace {

using Eigen::Affine3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// In the world of the document.
JointFrames frames_of(const Rig& rig) {
  const std::vector<Quaterniond> axes = bone_axes(rig);
  JointFrames frames;
  for (std::size_t joint = 0; joint < axes.size(); ++joint) {
    const Vector3d place = rig.joints.row(static_cast<Eigen::Index>(joint)).transpose();
    frames.push_back(Eigen::Translation3d(place) * axes[joint]);
  }
  return frames;
}

/// One row of numbers over time.
struct JointTrack {
  const char* path;
  const char* type;
  std::vector<Eigen::VectorXd> rows;

  [[nodiscard]] bool stays_at(const Eigen::VectorXd& rest, double size) const {
    constexpr double rounding = 1e-6;
    return std::ranges::all_of(rows, [&](const Eigen::VectorXd& row) {
      return (row - rest).cwiseAbs().maxCoeff() <= rounding * size;
    });
  }
};

class AnimationAdder {
 public:
  AnimationAdder(GltfDocument& document, const JointFrames& rest, const Rig& rig, std::size_t first,
                 const Affine3d& to_gltf)
      : document_(document), rig_(rig), first_(first), to_gltf_(to_gltf), bound_(frames_of(rig)) {
    for (const Affine3d& frame : rest) {
      const bool is_frame = is_invertible(frame);
      has_frame_.push_back(is_frame);
      back_.push_back(is_frame ? Affine3d(frame.inverse()) : Affine3d::Identity());
    }
    const Eigen::RowVector3d low = rig.joints.colwise().minCoeff();
    const Eigen::RowVector3d high = rig.joints.colwise().maxCoeff();
    size_ = std::max((high - low).norm(), std::max(low.norm(), high.norm()));
  }

  void add(const JointAnimation& animation) {
    samplers_ = OrderedJson::array();
    channels_ = OrderedJson::array();
    const double start = std::min(animation.seconds.front(), 0.0);
    std::vector<float> times;  // glTF's, some of which may round to one
    std::vector<std::vector<NodeMove>> moves(bound_.size());  // by joint
    for (std::size_t k = 0; k < animation.seconds.size(); ++k) {
      const auto time = static_cast<float>(animation.seconds[k] - start);
      if (k > 0 && !(time > times.back())) continue;
      times.push_back(time);
      take(animation.frames[k], moves);
    }
    const std::size_t accessor = add_times(times);
    for (std::size_t joint = 0; joint < moves.size(); ++joint) {
      add_joint(joint, moves[joint], accessor);
    }
    if (channels_.empty()) return;
    OrderedJson& all = array_in(document_.json, "animations");
    const std::string number = std::to_string(all.size() + 1);
    all.push_back(
        {{"name", as_utf8(animation.name.empty() ? "animation " + number : animation.name)},
         {"samplers", std::move(samplers_)},
         {"channels", std::move(channels_)}});
  }

 private:
  void take(const JointFrames& frames, std::vector<std::vector<NodeMove>>& moves) const {
    JointFrames moved;  // in the world of the document
    const Affine3d from_gltf = to_gltf_.inverse();
    for (std::size_t joint = 0; joint < bound_.size(); ++joint) {
      const int parent = rig_.parents[static_cast<Eigen::Index>(joint)];
      Affine3d now = to_gltf_ * frames[joint] * back_[joint] * from_gltf * bound_[joint];
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

  void add_joint(std::size_t joint, const std::vector<NodeMove>& moves, std::size_t times) {
    const int parent = rig_.parents[static_cast<Eigen::Index>(joint)];
    const NodeMove rest =
        node_move(parent < 0 ? bound_[joint] : bound_[idx(parent)].inverse() * bound_[joint]);
    JointTrack shift{"translation", "VEC3", {}};
    JointTrack turn{"rotation", "VEC4", {}};
    JointTrack scale{"scale", "VEC3", {}};
    for (const NodeMove& move : moves) {
      shift.rows.emplace_back(move.shift);
      turn.rows.emplace_back(move.turn.coeffs());
      scale.rows.emplace_back(move.scale);
    }
    const bool is_turned_back = !moves.empty() && moves.front().turn.dot(rest.turn) < 0;
    const Eigen::Vector4d turned = (is_turned_back ? -1 : 1) * rest.turn.coeffs();
    add_track(joint, shift, rest.shift, size_, times);
    add_track(joint, turn, turned, 1, times);
    add_track(joint, scale, rest.scale, 1, times);
  }

  void add_track(std::size_t joint, const JointTrack& track, const Eigen::VectorXd& rest,
                 double size, std::size_t times) {
    if (track.stays_at(rest, size)) return;
    std::string rows;
    for (const Eigen::VectorXd& row : track.rows) {
      for (const double number : row) put_number(rows, static_cast<float>(number));
    }
    const std::size_t numbers =
        add_accessor(document_, rows, track.type, gltf_float, track.rows.size());
    channels_.push_back({{"sampler", samplers_.size()},
                         {"target", {{"node", first_ + joint}, {"path", track.path}}}});
    samplers_.push_back({{"input", times}, {"output", numbers}});
  }

  std::size_t add_times(const std::vector<float>& times) {
    std::string rows;
    for (const float time : times) put_number(rows, time);
    const std::size_t accessor = add_accessor(document_, rows, "SCALAR", gltf_float, times.size());
    OrderedJson& written = document_.json["accessors"][accessor];
    written["min"] = {times.front()};
    written["max"] = {times.back()};
    return accessor;
  }

  GltfDocument& document_;
  const Rig& rig_;
  std::size_t first_;
  Affine3d to_gltf_;
  JointFrames bound_;
  JointFrames back_;  // of the file's joints, from the world
  std::vector<bool> has_frame_;
  double size_ = 0;
  OrderedJson samplers_;
  OrderedJson channels_;
};

}  // namespace

void add_joint_animations(GltfDocument& document, const AnimatedJoints& animated, const Rig& rig,
                          std::size_t first, const Eigen::Affine3d& to_gltf) {
  AnimationAdder adder(document, animated.rest, rig, first, to_gltf);
  for (const JointAnimation& animation : animated.animations) adder.add(animation);
}

}  // namespace curveskel
