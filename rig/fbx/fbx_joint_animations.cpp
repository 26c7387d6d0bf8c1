#include "rig/fbx/fbx_joint_animations.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/animations/moments.hpp"
#include "rig/fbx/fbx_joints.hpp"
#include "rig/fbx/fbx_stack.hpp"
#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"

namespace curveskel {
namespace {

/// A joint, or a model above one.
struct AnimatedModel {
  const FbxRecord* model = nullptr;
  int parent = -1;                 ///< comes before it
  std::vector<FbxMotion> motions;  ///< shift, angles, scale
};

class StackReader {
 public:
  StackReader(const FileBytes& file, const FbxScene& scene, const Monitor& monitor)
      : file_(file), scene_(scene), monitor_(monitor) {
    for (const FbxJoint& joint : fbx_joints(scene)) joints_.push_back(number_of(*joint.model));
  }

  [[nodiscard]] JointFrames rest() const {
    JointFrames frames;
    for (const int joint : joints_) frames.push_back(scene_.frame(*models_[idx(joint)].model));
    return frames;
  }

  /// Without moments where nothing moves.
  [[nodiscard]] JointAnimation read(const FbxRecord& stack, std::size_t clip) {
    JointAnimation made{clip, fbx_name(stack), {}, {}};
    const FbxStack moved(file_, scene_, stack);
    std::vector<double> keys;
    for (AnimatedModel& model : models_) {
      model.motions = motions_of(*model.model, moved);
      for (const FbxMotion& motion : model.motions) motion.add_seconds(keys);
    }
    made.seconds = moments_between(std::move(keys));
    for (const double seconds : made.seconds) {
      monitor_.report("write", 0);
      made.frames.push_back(frames_at(seconds));
    }
    return made;
  }

 private:
  /// Its own among the models, behind that of its parent.
  int number_of(const FbxRecord& model) {
    std::vector<const FbxRecord*> chain;  // of new ones, upwards
    const FbxRecord* next = &model;
    for (; next != nullptr && !numbers_.contains(next); next = scene_.parent(*next)) {
      chain.push_back(next);
    }
    int parent = next == nullptr ? -1 : numbers_.at(next);
    for (std::size_t k = chain.size(); k-- > 0;) {
      const auto number = static_cast<int>(models_.size());
      numbers_.emplace(chain[k], number);
      models_.push_back({chain[k], parent, {}});
      parent = number;
    }
    return numbers_.at(&model);
  }

  [[nodiscard]] std::vector<FbxMotion> motions_of(const FbxRecord& model,
                                                  const FbxStack& stack) const {
    using Kind = FbxAnimatedProperty::Kind;
    const FbxMove rest = scene_.move(model);
    const std::array<std::string_view, 3> axes{"d|X", "d|Y", "d|Z"};
    const std::int64_t order = scene_.rotation_order(model);
    return {stack.motion(model, {"Lcl Translation", axes}, rest.shift),
            stack.motion(model, {"Lcl Rotation", axes, Kind::angles, order}, rest.angles),
            stack.motion(model, {"Lcl Scaling", axes, Kind::factors}, rest.scale)};
  }

  [[nodiscard]] JointFrames frames_at(double seconds) const {
    std::vector<Eigen::Affine3d> of_model;
    for (const AnimatedModel& one : models_) {
      const FbxMove move{one.motions[0].at(seconds), one.motions[1].at(seconds),
                         one.motions[2].at(seconds)};
      const Eigen::Affine3d local = scene_.local(*one.model, move);
      of_model.push_back(one.parent < 0 ? local : of_model[idx(one.parent)] * local);
    }
    JointFrames frames;
    for (const int joint : joints_) frames.push_back(of_model[idx(joint)]);
    return frames;
  }

  const FileBytes& file_;
  const FbxScene& scene_;
  const Monitor& monitor_;
  std::vector<AnimatedModel> models_;
  std::unordered_map<const FbxRecord*, int> numbers_;
  std::vector<int> joints_;  // numbers of models
};

}  // namespace

AnimatedJoints read_fbx_joint_animations(const FileBytes& file, const Monitor& monitor) {
  const FbxRecord root = parse_fbx(file);
  const FbxScene scene(file, root);
  StackReader reader(file, scene, monitor);
  AnimatedJoints read{reader.rest(), {}};
  std::size_t clip = 0;
  for (const FbxRecord* stack : scene.all("AnimationStack")) {
    JointAnimation animation = reader.read(*stack, clip++);
    if (!animation.seconds.empty()) read.animations.push_back(std::move(animation));
  }
  return read;
}

}  // namespace curveskel
