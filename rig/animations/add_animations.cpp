#include "rig/animations/add_animations.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

/// Of one clip, either may be missing.
struct AnimatedClip {
  const JointAnimation* joints = nullptr;
  const ShapeAnimation* shapes = nullptr;

  [[nodiscard]] double start() const {
    double first = 0;
    if (joints != nullptr) first = std::min(first, joints->seconds.front());
    if (shapes == nullptr) return first;
    for (const ShapeTrack& track : shapes->tracks) first = std::min(first, track.seconds.front());
    return first;
  }

  [[nodiscard]] const std::string& name() const { return joints ? joints->name : shapes->name; }
};

void add_shapes(GltfClip& clip, const ShapeTrack& track, const GltfDocument& document,
                std::size_t node) {
  const std::size_t mesh = document.json["nodes"][node]["mesh"];
  const std::vector<double> given =
      document.json["meshes"][mesh].value("weights", track.weights[0]);
  const Eigen::VectorXd rest =
      Eigen::VectorXd::Map(given.data(), static_cast<Eigen::Index>(given.size()));
  GltfRows weights{"weights", "SCALAR", {}};
  std::vector<double> seconds;
  for (const std::size_t k : clip.distinct(track.seconds)) {
    seconds.push_back(track.seconds[k]);
    weights.rows.emplace_back(Eigen::VectorXd::Map(track.weights[k].data(), rest.size()));
  }
  if (!weights.stays_at(rest, 1)) clip.add_channel(node, weights, clip.add_times(seconds));
}

}  // namespace

void add_animations(GltfDocument& document, const AnimatedJoints& joints, const GltfJoints& made,
                    const std::vector<ShapeAnimation>& shapes,
                    const std::vector<int>& node_of_part) {
  std::map<std::size_t, AnimatedClip> clips;
  for (const JointAnimation& one : joints.animations) clips[one.clip].joints = &one;
  for (const ShapeAnimation& one : shapes) clips[one.clip].shapes = &one;
  const JointMover mover(made, joints.rest);
  for (const auto& [number, animated] : clips) {
    GltfClip clip(document, animated.start());
    if (animated.joints != nullptr) mover.add(clip, *animated.joints);
    const std::vector<ShapeTrack> none;
    for (const ShapeTrack& track : animated.shapes ? animated.shapes->tracks : none) {
      const int node = node_of_part[track.part];
      if (node >= 0) add_shapes(clip, track, document, idx(node));
    }
    clip.write(animated.name());
  }
}

}  // namespace curveskel
