#include "rig/fbx/fbx_shape_animations.hpp"

#include <algorithm>
#include <utility>

#include "rig/animations/moments.hpp"
#include "rig/fbx/fbx_stack.hpp"
#include "surface/read/fbx_channels.hpp"
#include "surface/read/fbx_meshes.hpp"

namespace curveskel {
namespace {

/// The sliders of one mesh.
class MovedSliders {
 public:
  MovedSliders(const std::vector<FbxChannel>& channels, const FbxStack& stack)
      : channels_(channels) {
    const FbxAnimatedProperty percent{"DeformPercent", {"d|DeformPercent"}};
    for (const FbxChannel& channel : channels) {
      motions_.push_back(stack.motion(*channel.record, percent, {channel.percent, 0, 0}));
    }
  }

  /// Without moments where nothing moves.
  [[nodiscard]] ShapeTrack track(std::size_t part, const Monitor& monitor) const {
    ShapeTrack made{part, moments(), {}};
    for (const double seconds : made.seconds) {
      monitor.report("write", 0);
      std::vector<double>& weights = made.weights.emplace_back();
      for (std::size_t k = 0; k < channels_.size(); ++k) {
        const std::vector<double> shares = channels_[k].shares(motions_[k].at(seconds).x());
        weights.insert(weights.end(), shares.begin(), shares.end());
      }
    }
    return made;
  }

 private:
  [[nodiscard]] std::vector<double> moments() const {
    std::vector<double> keys;
    bool are_lines = true;
    for (std::size_t k = 0; k < channels_.size(); ++k) {
      const bool leads_straight = channels_[k].stops.size() == 1;
      are_lines = are_lines && !motions_[k].bends() && (leads_straight || motions_[k].empty());
      motions_[k].add_seconds(keys);
    }
    return are_lines ? sorted_moments(std::move(keys)) : moments_between(std::move(keys));
  }

  const std::vector<FbxChannel>& channels_;
  std::vector<FbxMotion> motions_;  // by channel
};

}  // namespace

std::vector<ShapeAnimation> read_fbx_shape_animations(const FileBytes& file,
                                                      const Monitor& monitor) {
  const FbxRecord root = parse_fbx(file);
  const FbxScene scene(file, root);
  std::vector<std::vector<FbxChannel>> channels_of_part;
  for_each_fbx_geometry(scene, [&](const FbxRecord& /*model*/, const FbxRecord& geometry) {
    channels_of_part.push_back(fbx_channels(file, scene, geometry));
  });
  std::vector<ShapeAnimation> read;
  std::size_t clip = 0;
  for (const FbxRecord* record : scene.all("AnimationStack")) {
    ShapeAnimation animation{clip++, fbx_name(*record), {}};
    const FbxStack stack(file, scene, *record);
    for (std::size_t part = 0; part < channels_of_part.size(); ++part) {
      ShapeTrack track = MovedSliders(channels_of_part[part], stack).track(part, monitor);
      if (!track.seconds.empty()) animation.tracks.push_back(std::move(track));
    }
    if (!animation.tracks.empty()) read.push_back(std::move(animation));
  }
  return read;
}

}  // namespace curveskel
