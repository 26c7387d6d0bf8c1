#include "rig/gltf/gltf_animations.hpp"

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "surface/read/gltf_numbers.hpp"

namespace curveskel {
namespace {

using Between = GltfTrack::Between;
using Eigen::VectorXd;

constexpr const char* export_again = "export the file again, or remove its animations";

VectorXd between_turns(const VectorXd& from, const VectorXd& to, double share) {
  const Eigen::Quaterniond first(Eigen::Vector4d(from.normalized()));
  const Eigen::Quaterniond last(Eigen::Vector4d(to.normalized()));
  return first.slerp(share, last).coeffs();
}

std::vector<double> times_of(const FileBytes& file, const tinygltf::Model& model, int accessor) {
  const GltfNumbers numbers = gltf_numbers(file, model, accessor, 1, "times of an animation");
  std::vector<double> times(numbers.rows());
  for (std::size_t key = 0; key < times.size(); ++key) {
    times[key] = numbers.at(key, 0);
    if (std::isfinite(times[key]) && (key == 0 || times[key] > times[key - 1])) continue;
    file.fail("times of an animation that do not ascend", "seconds, each after the one before",
              export_again);
  }
  return times;
}

/// `width` numbers a row, which lie in `components` a row in the file.
Eigen::MatrixXd rows_of(const FileBytes& file, const GltfNumbers& numbers, int components,
                        std::size_t rows, std::size_t width) {
  const std::size_t wanted = rows * width;
  const std::size_t found = numbers.rows() * idx(components);
  if (found != wanted) {
    file.fail("an animation with " + std::to_string(found) + " numbers",
              std::to_string(wanted) + ", as its keys say", export_again);
  }
  Eigen::MatrixXd table(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(width));
  for (std::size_t k = 0; k < wanted; ++k) {
    table(static_cast<Eigen::Index>(k / width), static_cast<Eigen::Index>(k % width)) =
        numbers.at(k / idx(components), k % idx(components));
  }
  if (!table.allFinite()) {
    file.fail("an animation with a number that is none", "finite numbers", export_again);
  }
  return table;
}

Between between_keys(const std::string& name) {
  if (name == "STEP") return Between::step;
  return name == "CUBICSPLINE" ? Between::cubic : Between::line;
}

std::size_t shapes_of(const tinygltf::Model& model, const tinygltf::Node& node) {
  if (node.mesh < 0 || idx(node.mesh) >= model.meshes.size()) return 0;
  std::size_t shapes = 0;
  for (const tinygltf::Primitive& primitive : model.meshes[idx(node.mesh)].primitives) {
    shapes = std::max(shapes, primitive.targets.size());
  }
  return shapes;
}

/// Of the path in glTF; nothing of another one.
GltfTrack* track_of(GltfMotion& motion, const std::string& path) {
  if (path == "translation") return &motion.shift;
  if (path == "rotation") return &motion.turn;
  if (path == "scale") return &motion.scale;
  return path == "weights" ? &motion.sliders : nullptr;
}

void add_channel(const FileBytes& file, const tinygltf::Model& model,
                 const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel,
                 GltfAnimation& made) {
  if (channel.target_node < 0) return;
  const tinygltf::Node& node = gltf_element(file, model.nodes, channel.target_node, "node");
  const bool turns = channel.target_path == "rotation";
  const bool slides = channel.target_path == "weights";
  const int components = turns ? 4 : slides ? 1 : 3;
  const std::size_t width = slides ? shapes_of(model, node) : idx(components);
  GltfTrack* track = track_of(made.motions[channel.target_node], channel.target_path);
  if (track == nullptr || width == 0) return;
  const tinygltf::AnimationSampler& sampler =
      gltf_element(file, animation.samplers, channel.sampler, "sampler");
  std::vector<double> times = times_of(file, model, sampler.input);
  if (times.empty()) return;
  const Between between = between_keys(sampler.interpolation);
  const GltfNumbers numbers =
      gltf_numbers(file, model, sampler.output, components, "numbers of an animation");
  const std::size_t rows = times.size() * (between == Between::cubic ? 3 : 1);
  Eigen::MatrixXd table = rows_of(file, numbers, components, rows, width);
  *track = GltfTrack(std::move(times), std::move(table), between, turns);
}

}  // namespace

GltfTrack::GltfTrack(std::vector<double> times, Eigen::MatrixXd rows, Between between,
                     bool is_rotation)
    : times_(std::move(times)),
      rows_(std::move(rows)),
      between_(between),
      is_rotation_(is_rotation) {}

VectorXd GltfTrack::key(std::size_t number) const {
  const std::size_t row = between_ == Between::cubic ? 3 * number + 1 : number;
  return rows_.row(static_cast<Eigen::Index>(row)).transpose();
}

VectorXd GltfTrack::at(double seconds) const {
  const auto above = std::upper_bound(times_.begin(), times_.end(), seconds);
  if (above == times_.begin()) return key(0);
  const auto next = static_cast<std::size_t>(above - times_.begin());
  if (next == times_.size() || between_ == Between::step) return key(next - 1);
  const double length = times_[next] - times_[next - 1];
  const double t = (seconds - times_[next - 1]) / length;
  const VectorXd from = key(next - 1);
  const VectorXd to = key(next);
  if (between_ == Between::line) {
    return is_rotation_ ? between_turns(from, to, t) : VectorXd((1 - t) * from + t * to);
  }
  const auto row = static_cast<Eigen::Index>(3 * next);
  const VectorXd leaving = length * rows_.row(row - 1).transpose();
  const VectorXd arriving = length * rows_.row(row).transpose();
  const double tt = t * t;
  const double ttt = tt * t;
  const VectorXd value = (2 * ttt - 3 * tt + 1) * from + (ttt - 2 * tt + t) * leaving +
                         (3 * tt - 2 * ttt) * to + (ttt - tt) * arriving;
  return is_rotation_ ? value.normalized() : value;
}

std::vector<GltfAnimation> read_gltf_animations(const FileBytes& file,
                                                const tinygltf::Model& model) {
  std::vector<GltfAnimation> all;
  for (const tinygltf::Animation& animation : model.animations) {
    GltfAnimation made;
    made.name = animation.name;
    if (made.name.empty()) made.name = "animation " + std::to_string(all.size() + 1);
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      add_channel(file, model, animation, channel, made);
    }
    if (!made.motions.empty()) all.push_back(std::move(made));
  }
  return all;
}

}  // namespace curveskel
