// Laws of animations in FBX: joints stand at each moment as glTF says.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/write_file.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/rigged_bar.hpp"

namespace curveskel::fbx_animation_laws {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double frame_seconds = 1.0 / 30;

struct Keys {
  std::vector<float> seconds;
  std::vector<float> numbers;
};

/// The bar with joints that an animation moves; node k + 1 is joint k.
class MovingBar {
 public:
  MovingBar() : json_(nlohmann::json::parse(gltf_of({}, &numbers_))) {}

  void add(int joint, const char* path, const char* between, const Keys& keys) {
    const std::size_t rows = keys.seconds.size();
    const char* shape = std::string(path) == "rotation" ? "VEC4" : "VEC3";
    const std::size_t width = std::string(path) == "rotation" ? 4 : 3;
    nlohmann::json& animation = json_["animations"][0];
    animation["name"] = "a walk";
    animation["samplers"].push_back(
        {{"input", add_floats(keys.seconds, "SCALAR", rows)},
         {"output", add_floats(keys.numbers, shape, keys.numbers.size() / width)},
         {"interpolation", between}});
    animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1},
                                     {"target", {{"node", joint + 1}, {"path", path}}}});
  }

  void place_by_matrix(int joint) {
    nlohmann::json& node = json_["nodes"][idx(joint + 1)];
    node.erase("translation");
    node.erase("rotation");
    node["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1};
  }

  [[nodiscard]] EditedFile as_fbx() {
    json_["buffers"][0] = {
        {"byteLength", numbers_.size()},
        {"uri", "data:application/octet-stream;base64," + encodings::base64(numbers_)}};
    const std::filesystem::path given = folder_.path() / "bar.gltf";
    write_file(given, json_.dump());
    return format_rig_into(given, *read_rig(given), {RigFormat::fbx, OldRig::kept, "rig", "test"})
        .value();
  }

 private:
  int add_floats(const std::vector<float>& values, const char* shape, std::size_t rows) {
    std::string bytes;
    for (const float value : values) rigged_bar::append(bytes, value);
    return rigged_bar::add_rows(json_, numbers_, bytes, 5126, shape, rows);
  }

  OwnFolder folder_;
  std::string numbers_;
  nlohmann::json json_;
};

struct Curves {
  std::vector<double> seconds;
  std::vector<Vector3d> values;
};

/// Of a joint's property; without keys where it has none.
Curves curves_of(const FileBytes& file, const FbxScene& scene, const std::string& joint,
                 std::string_view property) {
  Curves found;
  for (const FbxRecord* model : scene.all("Model")) {
    if (fbx_name(*model) != joint) continue;
    const FbxRecord* node = scene.at_property(*model, property, "AnimationCurveNode");
    if (node == nullptr) continue;
    int axis = 0;
    for (const char* name : {"d|X", "d|Y", "d|Z"}) {
      const FbxRecord* curve = scene.at_property(*node, name, "AnimationCurve");
      EXPECT_NE(curve, nullptr);
      if (curve == nullptr) return {};
      const std::vector<double> times = fbx_numbers(file, *curve->child("KeyTime"));
      const std::vector<double> values = fbx_numbers(file, *curve->child("KeyValueFloat"));
      EXPECT_EQ(times.size(), values.size());
      found.seconds.resize(times.size());
      found.values.resize(times.size());
      for (std::size_t k = 0; k < times.size(); ++k) {
        found.seconds[k] = times[k] / 46186158000.0;
        found.values[k][axis] = values[k];
      }
      ++axis;
    }
  }
  return found;
}

Curves curves_of(MovingBar& bar, const std::string& joint, std::string_view property) {
  const FileBytes file{"bar.fbx", bar.as_fbx().bytes};
  const FbxRecord root = parse_fbx(file);
  return curves_of(file, FbxScene(file, root), joint, property);
}

Quaterniond turn_of(const Vector3d& degrees) {
  const Vector3d angles = degrees * (std::numbers::pi / 180);
  return Eigen::AngleAxisd(angles.z(), Vector3d::UnitZ()) *
         Eigen::AngleAxisd(angles.y(), Vector3d::UnitY()) *
         Eigen::AngleAxisd(angles.x(), Vector3d::UnitX());
}

TEST(FbxAnimations, JointsTurnAsInGltf) {
  const Vector3d axis = Vector3d(1, 2, 2) / 3;
  const std::vector<double> angles{0, 2, -1, -1.02};
  Keys keys{{0.25F, 0.75F, 1.5F, 1.51F}, {}};
  std::vector<Quaterniond> turns;
  for (const double angle : angles) {
    turns.emplace_back(Eigen::AngleAxisd(angle, axis));
    for (const double x : turns.back().coeffs()) keys.numbers.push_back(static_cast<float>(x));
  }
  MovingBar bar;
  bar.add(1, "rotation", "LINEAR", keys);
  const FileBytes file{"bar.fbx", bar.as_fbx().bytes};
  const FbxRecord root = parse_fbx(file);
  const FbxScene scene(file, root);
  ASSERT_EQ(scene.all("AnimationStack").size(), 1U);
  EXPECT_EQ(fbx_name(*scene.all("AnimationStack").front()), "a walk");
  const Curves curves = curves_of(file, scene, "joint 1", "Lcl Rotation");
  ASSERT_GT(curves.seconds.size(), angles.size());
  const auto wanted = [&](double seconds) {
    std::size_t k = 0;
    while (k + 2 < keys.seconds.size() && seconds > static_cast<double>(keys.seconds[k + 1])) ++k;
    const auto from = static_cast<double>(keys.seconds[k]);
    const auto to = static_cast<double>(keys.seconds[k + 1]);
    return turns[k].slerp((seconds - from) / (to - from), turns[k + 1]);
  };
  for (std::size_t k = 0; k < curves.seconds.size(); ++k) {
    EXPECT_LT(turn_of(curves.values[k]).angularDistance(wanted(curves.seconds[k])), 1e-5);
    if (k == 0) continue;
    EXPECT_LT(curves.seconds[k] - curves.seconds[k - 1], 1.01 * frame_seconds);
    const Vector3d between = 0.5 * (curves.values[k - 1] + curves.values[k]);
    const double seconds = 0.5 * (curves.seconds[k - 1] + curves.seconds[k]);
    EXPECT_LT(turn_of(between).angularDistance(wanted(seconds)), 0.01) << seconds;
  }
}

TEST(FbxAnimations, AStepStaysOne) {
  MovingBar bar;
  bar.add(2, "translation", "STEP", {{0, 1}, {1, 2, 3, 4, 5, 6}});
  const Curves curves = curves_of(bar, "joint 2", "Lcl Translation");
  ASSERT_FALSE(curves.seconds.empty());
  for (std::size_t k = 0; k < curves.seconds.size(); ++k) {
    const Vector3d wanted = curves.seconds[k] < 1 - 1e-6 ? Vector3d(1, 2, 3) : Vector3d(4, 5, 6);
    EXPECT_LT((curves.values[k] - wanted).norm(), 1e-5) << curves.seconds[k];
  }
  EXPECT_GT(curves.seconds[curves.seconds.size() - 2], 1 - 2e-4);
}

TEST(FbxAnimations, CurvesBendBySlopesAsInGltf) {
  MovingBar bar;
  bar.add(0, "scale", "CUBICSPLINE",
          {{0, 2}, {0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0, 0, 1, 2, 1, 0, 0, 0}});
  const Curves curves = curves_of(bar, "joint 0", "Lcl Scaling");
  ASSERT_FALSE(curves.seconds.empty());
  for (std::size_t k = 0; k < curves.seconds.size(); ++k) {
    const double t = curves.seconds[k] / 2;
    const Vector3d wanted(1 + 2 * t * (1 - t) * (1 - t), 1 + t * t * (3 - 2 * t), 1);
    EXPECT_LT((curves.values[k] - wanted).norm(), 1e-5) << curves.seconds[k];
  }
}

TEST(FbxAnimations, WithoutThemThereAreNoCurves) {
  MovingBar bar;
  const FileBytes still{"bar.fbx", bar.as_fbx().bytes};
  const FbxRecord root = parse_fbx(still);
  EXPECT_TRUE(FbxScene(still, root).all("AnimationStack").empty());
  bar.add(1, "scale", "LINEAR", {{0, 1}, {1, 1, 1, 1, 1, 1}});
  const FileBytes rested{"bar.fbx", bar.as_fbx().bytes};
  const FbxRecord other = parse_fbx(rested);
  EXPECT_TRUE(FbxScene(rested, other).all("AnimationCurve").empty());
}

/// A file that says milliseconds where seconds are meant, or years.
TEST(FbxAnimations, KeysFarApartGetNoMoreThanAThousandBetweenThem) {
  MovingBar bar;
  bar.add(1, "scale", "LINEAR", {{0, 1e30F}, {1, 1, 1, 2, 2, 2}});
  const Curves curves = curves_of(bar, "joint 1", "Lcl Scaling");
  EXPECT_EQ(curves.seconds.size(), 1001U);
}

TEST(FbxAnimations, ANodePlacedByAMatrixStaysWhereItIs) {
  MovingBar bar;
  bar.place_by_matrix(3);
  bar.add(3, "scale", "LINEAR", {{0, 1}, {1, 1, 1, 2, 2, 2}});
  EXPECT_TRUE(curves_of(bar, "joint 3", "Lcl Scaling").seconds.empty());
  EXPECT_TRUE(curves_of(bar, "joint 3", "Lcl Translation").seconds.empty());
}

TEST(FbxAnimations, BrokenOnesAreRefusedByName) {
  MovingBar backwards;
  backwards.add(1, "scale", "LINEAR", {{1, 0}, {1, 1, 1, 1, 1, 1}});
  EXPECT_THROW((void)backwards.as_fbx(), Error);
  MovingBar short_of_rows;
  short_of_rows.add(1, "scale", "LINEAR", {{0, 1}, {1, 1, 1}});
  EXPECT_THROW((void)short_of_rows.as_fbx(), Error);
}

}  // namespace
}  // namespace curveskel::fbx_animation_laws
