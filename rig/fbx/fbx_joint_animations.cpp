#include "rig/fbx/fbx_joint_animations.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/animations/moments.hpp"
#include "rig/fbx/fbx_curve.hpp"
#include "rig/fbx/fbx_joints.hpp"
#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// A number's curve, or the number.
struct AnimatedNumber {
  std::optional<FbxCurve> curve;
  double rest = 0;

  [[nodiscard]] double at(double seconds) const { return curve ? curve->at(seconds) : rest; }
};

using AnimatedVector = std::array<AnimatedNumber, 3>;

Vector3d vector_at(const AnimatedVector& numbers, double seconds) {
  return {numbers[0].at(seconds), numbers[1].at(seconds), numbers[2].at(seconds)};
}

/// A joint, or a model above one.
struct AnimatedModel {
  const FbxRecord* model = nullptr;
  int parent = -1;  ///< comes before it
  AnimatedVector shift;
  AnimatedVector angles;
  AnimatedVector scale;
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
  [[nodiscard]] JointAnimation read(const FbxRecord& stack, std::vector<std::string>& notes) {
    JointAnimation made{fbx_name(stack), {}, {}};
    const auto layers = scene_.below(stack, "AnimationLayer");
    std::vector<double> keys;
    for (AnimatedModel& model : models_) {
      const FbxMove rest = scene_.move(*model.model);
      model.shift = numbers_of(*model.model, "Lcl Translation", rest.shift, layers, keys);
      model.angles = numbers_of(*model.model, "Lcl Rotation", rest.angles, layers, keys);
      model.scale = numbers_of(*model.model, "Lcl Scaling", rest.scale, layers, keys);
    }
    made.seconds = moments_between(std::move(keys));
    for (const double seconds : made.seconds) {
      monitor_.report("write", 0);
      made.frames.push_back(frames_at(seconds));
    }
    if (layers.size() > 1 && !made.seconds.empty()) {
      notes.push_back("the animation " + in_quotes(made.name) + " has " +
                      std::to_string(layers.size()) +
                      " layers, of which the first that moves a number counts; bake it into one "
                      "layer to have them all");
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
      models_.push_back({chain[k], parent, {}, {}, {}});
      parent = number;
    }
    return numbers_.at(&model);
  }

  /// The property's curves in the first layer that moves it; `keys` gets theirs.
  [[nodiscard]] AnimatedVector numbers_of(const FbxRecord& model, std::string_view property,
                                          const Vector3d& rest,
                                          const std::vector<const FbxRecord*>& layers,
                                          std::vector<double>& keys) const {
    AnimatedVector numbers;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      numbers[axis].rest = rest[static_cast<Eigen::Index>(axis)];
    }
    const FbxRecord* moved = moved_by(model, property, layers);
    if (moved == nullptr) return numbers;
    constexpr std::array<std::string_view, 3> axes{"d|X", "d|Y", "d|Z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (const FbxRecord* given = fbx_property(moved, axes[axis])) {
        numbers[axis].rest = given->number(first_property_value, numbers[axis].rest);
      }
      const FbxRecord* curve = scene_.at_property(*moved, axes[axis], "AnimationCurve");
      if (curve == nullptr) continue;
      FbxCurve read(file_, *curve);
      if (read.empty()) continue;
      const std::vector<double> own = read.seconds();
      keys.insert(keys.end(), own.begin(), own.end());
      numbers[axis].curve = std::move(read);
    }
    return numbers;
  }

  [[nodiscard]] const FbxRecord* moved_by(const FbxRecord& model, std::string_view property,
                                          const std::vector<const FbxRecord*>& layers) const {
    const auto candidates = scene_.all_at_property(model, property, "AnimationCurveNode");
    if (candidates.empty()) return nullptr;
    for (const FbxRecord* layer : layers) {
      const auto in_layer = scene_.below(*layer, "AnimationCurveNode");
      for (const FbxRecord* one : candidates) {
        if (std::find(in_layer.begin(), in_layer.end(), one) != in_layer.end()) return one;
      }
    }
    return nullptr;
  }

  [[nodiscard]] JointFrames frames_at(double seconds) const {
    std::vector<Eigen::Affine3d> of_model;
    for (const AnimatedModel& one : models_) {
      const FbxMove move{vector_at(one.shift, seconds), vector_at(one.angles, seconds),
                         vector_at(one.scale, seconds)};
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

AnimatedJoints read_fbx_joint_animations(const FileBytes& file, std::vector<std::string>& notes,
                                         const Monitor& monitor) {
  const FbxRecord root = parse_fbx(file);
  const FbxScene scene(file, root);
  StackReader reader(file, scene, monitor);
  AnimatedJoints read{reader.rest(), {}};
  for (const FbxRecord* stack : scene.all("AnimationStack")) {
    JointAnimation animation = reader.read(*stack, notes);
    if (!animation.seconds.empty()) read.animations.push_back(std::move(animation));
  }
  return read;
}

}  // namespace curveskel
