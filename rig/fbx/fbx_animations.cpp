#include "rig/fbx/fbx_animations.hpp"

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/animations/track_moments.hpp"
#include "rig/fbx/fbx_time.hpp"
#include "rig/fbx/local_move.hpp"
#include "rig/gltf/gltf_animations.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

std::int64_t ticks(double seconds) {
  constexpr double longest = 1e8;  // seconds; twice as many go into the number
  return std::llround(fbx_ticks_a_second * std::clamp(seconds, -longest, longest));
}

/// The first and the last second.
struct TimeSpan {
  double first = std::numeric_limits<double>::infinity();
  double last = -first;

  void take(const std::vector<double>& times) {
    if (times.empty()) return;
    first = std::min(first, times.front());
    last = std::max(last, times.back());
  }
};

template <int Count>
std::array<double, Count> numbers_or(const std::vector<double>& given,
                                     std::array<double, Count> usual) {
  if (given.size() == Count) std::copy(given.begin(), given.end(), usual.begin());
  return usual;
}

/// A node's frame in that of its parent.
FbxMove move_at(const tinygltf::Node& node, const GltfMotion& motion, double seconds) {
  const auto shift = numbers_or<3>(node.translation, {0, 0, 0});
  const auto turn = numbers_or<4>(node.rotation, {0, 0, 0, 1});
  const auto scale = numbers_or<3>(node.scale, {1, 1, 1});
  Vector3d at(shift.data());
  Eigen::Vector4d around(turn.data());
  Vector3d factors(scale.data());
  if (!motion.shift.empty()) at = motion.shift.at(seconds);
  if (!motion.turn.empty()) around = motion.turn.at(seconds);
  if (!motion.scale.empty()) factors = motion.scale.at(seconds);
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.translate(at);
  if (around.norm() > 0) frame.rotate(Eigen::Quaterniond(around).normalized());
  frame.scale(factors);
  return local_move(frame);
}

/// One property over time, by axis.
struct FbxCurves {
  std::vector<std::int64_t> times;
  std::vector<std::vector<double>> values;

  void add(double seconds, const std::vector<double>& row) {
    times.push_back(ticks(seconds));
    values.resize(row.size());
    for (std::size_t axis = 0; axis < row.size(); ++axis) values[axis].push_back(row[axis]);
  }

  [[nodiscard]] bool stays_at(const std::vector<double>& rest) const {
    constexpr double rounding = 1e-6;
    for (std::size_t axis = 0; axis < values.size(); ++axis) {
      for (const double value : values[axis]) {
        if (std::abs(value - rest[axis]) > rounding * (1 + std::abs(rest[axis]))) return false;
      }
    }
    return true;
  }
};

std::vector<double> row_of(const Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// Curves of one property of an object.
struct FbxProperty {
  std::int64_t object;
  const char* name;
  const char* short_name;
  std::vector<const char*> axes;
};

class AnimationWriter {
 public:
  AnimationWriter(FbxDocument& document, const tinygltf::Model& model, const FbxNodes& nodes)
      : document_(document), model_(model), nodes_(nodes) {}

  void add(const GltfAnimation& animation) {
    TimeSpan span;
    for (const auto& [node, motion] : animation.motions) {
      if (!is_there(node)) continue;
      for (const GltfTrack* track : {&motion.shift, &motion.turn, &motion.scale, &motion.sliders}) {
        span.take(track->times());
      }
    }
    if (span.first > span.last) return;
    add_stack(animation.name, span);
    for (const auto& [node, motion] : animation.motions) {
      add_moves(node, motion);
      add_sliders(node, motion.sliders);
    }
  }

 private:
  [[nodiscard]] bool is_there(int node) const {
    return nodes_.models.contains(node) || nodes_.sliders.contains(node);
  }

  void add_stack(const std::string& name, const TimeSpan& span) {
    const std::int64_t stack =
        document_.add("AnimationStack", name, "AnimStack", "", [span](FbxRecords& records) {
          records.begin("Properties70");
          const auto time = [&](const char* property, double seconds) {
            records.property(property, "KTime", "Time", "", ticks(seconds));
          };
          time("LocalStart", span.first);
          time("LocalStop", span.last);
          time("ReferenceStart", span.first);
          time("ReferenceStop", span.last);
          records.end();
        });
    layer_ = document_.add("AnimationLayer", name, "AnimLayer", "", [](FbxRecords&) {});
    document_.connect(layer_, stack);
  }

  void add_moves(int node, const GltfMotion& motion) {
    const auto model = nodes_.models.find(node);
    const std::vector<double> times = track_moments({&motion.shift, &motion.turn, &motion.scale});
    if (model == nodes_.models.end() || times.empty()) return;
    const tinygltf::Node& given = model_.nodes[idx(node)];
    if (!given.matrix.empty()) return;  // which the standard forbids, as nothing could be moved
    const FbxMove rest = move_at(given, {}, 0);
    std::array<FbxCurves, 3> curves;
    Vector3d before = rest.angles;
    for (const double seconds : times) {
      const FbxMove move = move_at(given, motion, seconds);
      before = nearest_angles(move.angles, before);
      curves[0].add(seconds, row_of(move.shift));
      curves[1].add(seconds, row_of(before));
      curves[2].add(seconds, row_of(move.scale));
    }
    const std::vector<const char*> axes{"d|X", "d|Y", "d|Z"};
    add_curves({model->second, "Lcl Translation", "T", axes}, curves[0], row_of(rest.shift));
    add_curves({model->second, "Lcl Rotation", "R", axes}, curves[1], row_of(rest.angles));
    add_curves({model->second, "Lcl Scaling", "S", axes}, curves[2], row_of(rest.scale));
  }

  void add_sliders(int node, const GltfTrack& track) {
    const auto sliders = nodes_.sliders.find(node);
    if (sliders == nodes_.sliders.end() || track.empty()) return;
    const std::vector<double>& rest = model_.meshes[idx(model_.nodes[idx(node)].mesh)].weights;
    constexpr double percent = 100;
    const std::vector<double> times = track_moments({&track});
    for (std::size_t shape = 0; shape < sliders->second.size(); ++shape) {
      FbxCurves curves;
      for (const double seconds : times) {
        const Eigen::VectorXd shares = track.at(seconds);
        if (shape >= idx(shares.size())) return;
        curves.add(seconds, {percent * shares[static_cast<Eigen::Index>(shape)]});
      }
      add_curves({sliders->second[shape], "DeformPercent", "DeformPercent", {"d|DeformPercent"}},
                 curves, {shape < rest.size() ? percent * rest[shape] : 0});
    }
  }

  void add_curves(const FbxProperty& property, const FbxCurves& curves,
                  const std::vector<double>& rest) {
    if (curves.stays_at(rest)) return;
    const auto axes = property.axes;
    const std::int64_t all =
        document_.add("AnimationCurveNode", property.short_name, "AnimCurveNode", "",
                      [axes, rest](FbxRecords& records) {
                        records.begin("Properties70");
                        for (std::size_t k = 0; k < axes.size(); ++k) {
                          records.property(axes[k], "Number", "", "A", rest[k]);
                        }
                        records.end();
                      });
    document_.connect(all, layer_);
    document_.connect(all, property.object, property.name);
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      document_.connect(add_curve(curves.times, curves.values[axis]), all, axes[axis]);
    }
  }

  std::int64_t add_curve(const std::vector<std::int64_t>& times,
                         const std::vector<double>& values) {
    return document_.add("AnimationCurve", "", "AnimCurve", "", [=](FbxRecords& records) {
      constexpr std::int32_t lines = 4;
      const auto keys = static_cast<std::int32_t>(times.size());
      records.record("Default", values.front());
      records.record("KeyVer", 4008);
      records.record("KeyTime", times);
      records.record("KeyValueFloat", std::vector<float>(values.begin(), values.end()));
      records.record("KeyAttrFlags", std::vector<std::int32_t>{lines});
      records.record("KeyAttrDataFloat", std::vector<float>(4, 0));
      records.record("KeyAttrRefCount", std::vector<std::int32_t>{keys});
    });
  }

  FbxDocument& document_;
  const tinygltf::Model& model_;
  const FbxNodes& nodes_;
  std::int64_t layer_ = 0;
};

}  // namespace

void add_fbx_animations(FbxDocument& document, const FileBytes& file, const tinygltf::Model& model,
                        const FbxNodes& nodes, const Monitor& monitor) {
  AnimationWriter writer(document, model, nodes);
  for (const GltfAnimation& animation : read_gltf_animations(file, model)) {
    throw_if_stopped(monitor.stop);
    writer.add(animation);
  }
}

}  // namespace curveskel
