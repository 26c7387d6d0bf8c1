// Limbs that animations of FBX and COLLADA files move, and the same limbs still.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "rig/animations/read_joint_animations.hpp"
#include "rig/fbx/fbx_time.hpp"
#include "tests/surface/scene_encodings.hpp"

namespace curveskel::animated_limbs {

using Eigen::Affine3d;
using Eigen::Vector3d;
using encodings::FbxForm;
using encodings::FbxItem;
using encodings::FbxItems;

// ---- FBX ----------------------------------------------------------------------------------------

inline FbxItem curve_item(std::int64_t number, const std::vector<double>& seconds,
                          const std::vector<double>& values, int flags = 4,
                          const std::vector<double>& slopes = {0, 0}) {
  std::vector<double> times;
  times.reserve(seconds.size());
  for (const double one : seconds) times.push_back(std::round(one * fbx_ticks_a_second));
  return {"AnimationCurve",
          {number, "AnimCurve::", ""},
          {{"KeyTime", {times}},
           {"KeyValueFloat", {values}},
           {"KeyAttrFlags", {std::vector<int>{flags}}},
           {"KeyAttrDataFloat", {std::vector<double>{slopes[0], slopes[1], 0, 0}}},
           {"KeyAttrRefCount", {std::vector<int>{static_cast<int>(values.size())}}}}};
}

using Numbers = std::array<Vector3d, 3>;  // shift, angles, scale
inline constexpr std::array property_names{"Lcl Translation", "Lcl Rotation", "Lcl Scaling"};

/// A turned model with two joints, of which the first turns in an order of its own about a pivot.
/// `moving`: their numbers at a moment; without a moment the file is still, else it has a curve for
/// each number with keys each tenth of a second for half a second.
class FbxLimb {
 public:
  using Moving = std::function<Numbers(int model, double seconds)>;

  explicit FbxLimb(Moving moving) : moving_(std::move(moving)) {}

  [[nodiscard]] std::string text(double seconds, bool with_curves, FbxForm form) const {
    FbxItems objects{encodings::fbx_box(), encodings::fbx_model(2)};
    encodings::FbxLinks links{{1, 2}, {2, 0}, {100, 0}, {101, 100}, {102, 101}};
    for (int model = 0; model < 3; ++model) objects.push_back(model_item(model, seconds));
    FbxItems scene = encodings::fbx_scene(objects, links);
    if (with_curves) add_curves(scene);
    return encodings::fbx(scene, form);
  }

 private:
  [[nodiscard]] FbxItem model_item(int model, double seconds) const {
    const Numbers numbers = moving_(model, seconds);
    std::vector<encodings::FbxProperty> properties;
    if (model == 1) {
      properties = {{"RotationActive", {1}},
                    {"RotationOrder", {4}},
                    {"PreRotation", {10.0, 20.0, 30.0}},
                    {"RotationPivot", {0.1, 0.2, 0.3}}};
    }
    for (std::size_t k = 0; k < 3; ++k) {
      properties.push_back({property_names[k], {numbers[k].x(), numbers[k].y(), numbers[k].z()}});
    }
    FbxItem item = encodings::fbx_model(100 + model, properties, model == 0 ? "Null" : "LimbNode");
    item.values[1] = "Model::joint " + std::to_string(model);
    return item;
  }

  void add_curves(FbxItems& scene) const {
    FbxItems& objects = scene[0].children;
    FbxItems& links = scene[1].children;
    objects.push_back({"AnimationStack", {std::int64_t{200}, "AnimStack::a walk", ""}});
    objects.push_back({"AnimationLayer", {std::int64_t{201}, "AnimLayer::base", ""}});
    links.push_back({"C", {"OO", std::int64_t{201}, std::int64_t{200}}});
    std::int64_t number = 300;
    for (int model = 0; model < 3; ++model) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t node = number++;
        objects.push_back({"AnimationCurveNode", {node, "AnimCurveNode::n", ""}});
        links.push_back({"C", {"OO", node, std::int64_t{201}}});
        links.push_back({"C", {"OP", node, std::int64_t{100 + model}, property_names[k]}});
        for (int axis = 0; axis < 3; ++axis) {
          std::vector<double> seconds;
          std::vector<double> values;
          for (int key = 0; key <= 5; ++key) {
            seconds.push_back(0.1 * key);
            values.push_back(moving_(model, 0.1 * key)[k][axis]);
          }
          objects.push_back(curve_item(number, seconds, values));
          links.push_back({"C", {"OP", number, node, std::string("d|") + "XYZ"[axis]}});
          ++number;
        }
      }
    }
  }

  Moving moving_;
};

/// Lines over time, so that what lies between keys is known, too.
inline Numbers lines(int model, double seconds) {
  const double t = seconds;
  return {Vector3d(1 + t, 2 * model - t, 0.5 * model),
          Vector3d(40 * t, 10 + 90 * t, -70 * t + model), Vector3d::Constant(1 + t)};
}

inline AnimatedJoints animations_in(const FileBytes& file) {
  return read_joint_animations(file, {});
}

inline void expect_alike(const JointFrames& found, const JointFrames& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_LT((found[k].matrix() - wanted[k].matrix()).norm(), 1e-6);
  }
}

// ---- COLLADA ------------------------------------------------------------------------------------

inline std::string source_of(const std::string& id, std::size_t width,
                             const std::vector<double>& numbers) {
  std::string text;
  for (const double one : numbers) text += encodings::fbx_number(one) + " ";
  return "<source id=\"" + id + "\"><float_array id=\"" + id + "-a\">" + text +
         "</float_array><technique_common><accessor source=\"#" + id + "-a\" count=\"" +
         std::to_string(numbers.size() / width) + "\" stride=\"" + std::to_string(width) +
         "\"/></technique_common></source>";
}

struct DaeTrack {
  std::string target;
  std::vector<double> seconds;
  std::vector<double> numbers;
  std::string between = "LINEAR";
  std::vector<double> arriving = {};  ///< times and values
  std::vector<double> leaving = {};
};

inline std::string animation_of(const std::string& id, const DaeTrack& track) {
  const std::size_t keys = track.seconds.size();
  std::string names;
  for (std::size_t k = 0; k < keys; ++k) names += track.between + " ";
  std::string text = "<animation id=\"" + id + "\">" + source_of(id + "-t", 1, track.seconds) +
                     source_of(id + "-v", track.numbers.size() / keys, track.numbers) +
                     "<source id=\"" + id + "-i\"><Name_array count=\"" + std::to_string(keys) +
                     "\">" + names + "</Name_array></source>";
  std::string inputs;
  const auto add_input = [&](const char* semantic, const std::string& suffix) {
    inputs += std::string("<input semantic=\"") + semantic + "\" source=\"#" + id + suffix + "\"/>";
  };
  add_input("INPUT", "-t");
  add_input("OUTPUT", "-v");
  add_input("INTERPOLATION", "-i");
  if (!track.arriving.empty()) {
    text += source_of(id + "-a-in", 2, track.arriving) + source_of(id + "-out", 2, track.leaving);
    add_input("IN_TANGENT", "-a-in");
    add_input("OUT_TANGENT", "-out");
  }
  return text + "<sampler id=\"" + id + "-s\">" + inputs + "</sampler><channel source=\"#" + id +
         "-s\" target=\"" + track.target + "\"/></animation>";
}

/// Two joints: one is shifted and turned about two axes, the other has a matrix.
struct DaeLimb {
  Vector3d shift{1, 2, 3};
  double first_angle = 10;
  double second_angle = -20;
  Affine3d matrix = Affine3d(Eigen::Translation3d(0, 1, 0));

  [[nodiscard]] std::string text(const std::string& libraries = {}) const {
    std::string numbers;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        numbers += encodings::fbx_number(matrix.matrix()(row, column)) + " ";
      }
    }
    const auto number = [](double value) { return encodings::fbx_number(value); };
    const std::string nodes = encodings::dae_box_node +
                              "<node id=\"a.1\" name=\"a\" type=\"JOINT\"><translate sid=\"at\">" +
                              number(shift.x()) + " " + number(shift.y()) + " " +
                              number(shift.z()) + "</translate><rotate sid=\"rz\">0 0 1 " +
                              number(first_angle) + "</rotate><rotate sid=\"rx\">1 0 0 " +
                              number(second_angle) +
                              "</rotate><node id=\"b\" type=\"JOINT\"><matrix sid=\"transform\">" +
                              numbers + "</matrix></node></node>\n";
    return encodings::dae(encodings::dae_geometry(encodings::dae_quads()), nodes, libraries);
  }
};

inline std::string animations_text(const std::vector<DaeTrack>& tracks) {
  std::string text = "<library_animations>";
  for (std::size_t k = 0; k < tracks.size(); ++k) {
    text += animation_of("track" + std::to_string(k), tracks[k]);
  }
  return text + "</library_animations>";
}

}  // namespace curveskel::animated_limbs
