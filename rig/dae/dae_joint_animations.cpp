#include "rig/dae/dae_joint_animations.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/animations/moments.hpp"
#include "rig/dae/dae_channel.hpp"
#include "rig/dae/dae_joints.hpp"
#include "surface/read/dae_scene.hpp"

namespace curveskel {
namespace {

using Channels = std::vector<DaeChannel>;

/// Of an <animation> and those in it.
void add_channels(const DaeDocument& document, const XmlElement& animation, Channels& channels) {
  for (const XmlElement& child : animation.children) {
    if (child.name == "animation") add_channels(document, child, channels);
    if (child.name != "channel") continue;
    std::optional<DaeChannel> read = DaeChannel::read(document, child);
    if (read) channels.push_back(std::move(*read));
  }
}

double seconds_in(const XmlElement& clip, std::string_view name, double otherwise) {
  const std::string_view text = clip.attribute(name);
  double seconds = otherwise;
  const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), seconds);
  return error == std::errc() && std::isfinite(seconds) ? seconds : otherwise;
}

std::vector<double> moments_of(const Channels& channels) {
  std::vector<double> keys;
  for (const DaeChannel& one : channels) {
    keys.insert(keys.end(), one.seconds().begin(), one.seconds().end());
  }
  const bool are_matrices = std::ranges::all_of(channels, &DaeChannel::is_matrix);
  return are_matrices ? sorted_moments(std::move(keys)) : moments_between(std::move(keys));
}

class DaeAnimationReader {
 public:
  DaeAnimationReader(const DaeDocument& document, const Monitor& monitor)
      : document_(document), monitor_(monitor) {
    quiet_.stop = monitor.stop;
    joints_ = dae_joints(dae_nodes(document, quiet_));
  }

  [[nodiscard]] AnimatedJoints read() const {
    AnimatedJoints made{frames({}), {}};
    std::size_t clips = 0;
    for (const XmlElement* library : document_.root().all("library_animation_clips")) {
      for (const XmlElement* clip : library->all("animation_clip")) add_clip(*clip, clips++, made);
    }
    if (!made.animations.empty()) return made;
    Channels channels;
    std::string name;
    for (const XmlElement* library : document_.root().all("library_animations")) {
      add_channels(document_, *library, channels);
      if (library->children.size() == 1) name = library->children.front().attribute("name");
    }
    std::vector<double> seconds = moments_of(channels);
    if (seconds.empty()) return made;
    made.animations.push_back({0, name, std::move(seconds), {}});
    move(made.animations.back(), channels, 0);
    return made;
  }

 private:
  void add_clip(const XmlElement& clip, std::size_t number, AnimatedJoints& made) const {
    Channels channels;
    for (const XmlElement* instance : clip.all("instance_animation")) {
      add_channels(document_, document_.referred(*instance, "url"), channels);
    }
    const std::vector<double> moments = moments_of(channels);
    if (moments.empty()) return;
    const double start = seconds_in(clip, "start", moments.front());
    const double end = std::max(start, seconds_in(clip, "end", moments.back()));
    std::vector<double> seconds{start};
    std::ranges::copy_if(moments, std::back_inserter(seconds),
                         [&](double moment) { return moment > start && moment < end; });
    if (end > start) seconds.push_back(end);
    const std::string_view id = clip.attribute("id");
    made.animations.push_back(
        {number, std::string(clip.attribute("name", id)), std::move(seconds), {}});
    move(made.animations.back(), channels, start);
  }

  /// Makes the frames of its moments, which count from `start` then.
  void move(JointAnimation& made, const Channels& channels, double start) const {
    for (double& moment : made.seconds) {
      monitor_.report("write", 0);
      MovedNumbers numbers;
      for (const DaeChannel& channel : channels) channel.move(moment, numbers);
      made.frames.push_back(frames(numbers));
      moment -= start;
    }
  }

  [[nodiscard]] JointFrames frames(const MovedNumbers& numbers) const {
    const std::vector<DaeNode> nodes = dae_nodes(document_, quiet_, numbers);
    JointFrames made;
    for (const DaeJoint& joint : joints_) made.push_back(nodes[idx(joint.node)].frame);
    return made;
  }

  const DaeDocument& document_;
  const Monitor& monitor_;
  Monitor quiet_;  // as nodes are placed at each moment
  std::vector<DaeJoint> joints_;
};

}  // namespace

AnimatedJoints read_dae_joint_animations(const FileBytes& file, const Monitor& monitor) {
  const XmlElement root = parse_dae(file);
  const DaeDocument document(file, root);
  return DaeAnimationReader(document, monitor).read();
}

}  // namespace curveskel
