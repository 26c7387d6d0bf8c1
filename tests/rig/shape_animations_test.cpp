// Laws of shapes over time, of FBX into glTF: each is on as the file's curves say, in one animation
// with the joints; and of the layers in which FBX animations lie.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/write_file.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include "rig/fbx/fbx_shape_animations.hpp"
#include "surface/read/fbx_channels.hpp"
#include "tests/glb.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/animated_face.hpp"
#include "tests/rig/rigged_bar.hpp"

namespace curveskel::shape_animation_laws {
namespace {

using namespace animated_face;
using Eigen::Vector3d;

std::vector<ShapeAnimation> shapes_in(const Face& face, FbxForm form = FbxForm::binary) {
  return read_fbx_shape_animations({"face.fbx", face.text(form)}, {});
}

// ---- The file -----------------------------------------------------------------------------------

TEST(ShapeAnimations, AreOnAsTheCurvesSayAndElseAsAtRest) {
  const Face face{{{"open", 10}, {"still", 40}, {"wide", 0}},
                  {{{{slid(2, {0, 1}, {0, 50}), slid(0, {0.5, 2}, {-20, 130})}}},
                   {{{slid(1, {0.25}, {5})}}},
                   {{{jaw("Lcl Rotation", {0, 1}, {{0, 9}, {0, 9}, {0, 9}})}}}}};
  for (const FbxForm form : {FbxForm::text, FbxForm::binary, FbxForm::binary_wide_and_zipped}) {
    const std::vector<ShapeAnimation> found = shapes_in(face, form);
    ASSERT_EQ(found.size(), 2U) << "the third moves no shape";
    EXPECT_EQ(found[1].clip, 1U);
    ASSERT_EQ(found[0].tracks.size(), 1U);
    const ShapeTrack& track = found[0].tracks.front();
    ASSERT_EQ(track.seconds.size(), 4U) << "lines have no moments between their keys";
    for (std::size_t k = 0; k < track.seconds.size(); ++k) {
      const double t = track.seconds[k];
      const double open = -0.2 + std::clamp((t - 0.5) / 1.5, 0.0, 1.0) * 1.5;
      ASSERT_EQ(track.weights[k].size(), 3U);
      EXPECT_NEAR(track.weights[k][0], open, 1e-8);
      EXPECT_NEAR(track.weights[k][1], 0.4, 1e-12);
      EXPECT_NEAR(track.weights[k][2], 0.5 * std::min(t, 1.0), 1e-8);
    }
    EXPECT_EQ(found[1].tracks.front().weights, (std::vector<std::vector<double>>{{0.1, 0.05, 0}}));
  }
}

TEST(ShapeAnimations, CurvesThatBendHaveMomentsBetweenTheirKeys) {
  const Face face{{{"open"}}, {{{{slid(0, {0, 1}, {0, 100}, 0x8)}}}}};
  EXPECT_GE(shapes_in(face).at(0).tracks.at(0).seconds.size(), 31U);
}

TEST(ShapeAnimations, BrokenCurvesAreRefusedByName) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const Moved& broken :
       {slid(0, {0, 1}, {0, 1, 2}), slid(0, {1, 0}, {0, 1}), slid(0, {0, 1}, {0, none})}) {
    EXPECT_THROW((void)shapes_in({{{"open"}}, {{{{broken}}}}}), Error);
  }
}

TEST(ShapeAnimations, OfWhatIsNotThereAreLeftOut) {
  EXPECT_TRUE(shapes_in({{{"open"}}, {{{{slid(7, {0, 1}, {0, 1})}}}}}).empty());
  EXPECT_TRUE(shapes_in({{}, {{{{slid(0, {0, 1}, {0, 1})}}}}}).empty());
  EXPECT_TRUE(shapes_in({{{"open"}}, {{{{slid(0, {}, {})}}}}}).empty());
  Moved other = slid(0, {0, 1}, {0, 1});
  other.property = "Something";
  EXPECT_TRUE(shapes_in({{{"open"}}, {{{{other}}}}}).empty());
}

// ---- Shapes between -----------------------------------------------------------------------------

TEST(ShapeAnimations, AtItsPercentAShapeIsThereAloneAndInBetweenShapesBlend) {
  const FbxChannel channel{nullptr, 0, {{nullptr, 20}, {nullptr, 50}, {nullptr, 100}}};
  using Shares = std::vector<double>;
  EXPECT_EQ(channel.shares(0), (Shares{0, 0, 0}));
  EXPECT_EQ(channel.shares(10), (Shares{0.5, 0, 0}));
  EXPECT_EQ(channel.shares(20), (Shares{1, 0, 0}));
  EXPECT_EQ(channel.shares(50), (Shares{0, 1, 0}));
  EXPECT_EQ(channel.shares(75), (Shares{0, 0.5, 0.5}));
  EXPECT_EQ(channel.shares(100), (Shares{0, 0, 1}));
  EXPECT_EQ(channel.shares(150), (Shares{0, 0, 1.5}));
  EXPECT_EQ(channel.shares(-20), (Shares{-1, 0, 0}));
}

/// The first stop moves the vertex by 1, the second by 2, the third by 3.
TEST(ShapeAnimations, TheSurfaceGoesThroughTheShapesOfAChannel) {
  const OwnFolder folder;
  const auto vertex_at = [&](double percent, const std::vector<double>& full) {
    const Face face{{{"smile", percent, full}}, {}};
    return read_polygons(folder.write("face.fbx", face.text())).positions(0, 0);
  };
  const double base = vertex_at(0, {100});
  EXPECT_NEAR(vertex_at(25, {25, 75, 100}) - base, 1, 1e-9);
  EXPECT_NEAR(vertex_at(50, {25, 75, 100}) - base, 1.5, 1e-9);
  EXPECT_NEAR(vertex_at(100, {25, 75, 100}) - base, 3, 1e-9);
  EXPECT_NEAR(vertex_at(50, {75, 25, 100}) - base, 1.5, 1e-9) << "without an order the last counts";
}

// ---- glTF ---------------------------------------------------------------------------------------

Rig face_rig(const std::filesystem::path& file) {
  Rig rig = read_joints(file);
  const Eigen::Index vertices = read_polygons(file).positions.rows();
  rig.weights = SkinWeights(vertices, rig.joints.rows());
  for (Eigen::Index v = 0; v < vertices; ++v) rig.weights.insert(v, 0) = 1;
  rig.weights.makeCompressed();
  return rig;
}

/// Of the channel that moves weights; -1 = none.
int weights_channel(const nlohmann::json& animation) {
  const nlohmann::json& channels = animation["channels"];
  for (std::size_t k = 0; k < channels.size(); ++k) {
    if (channels[k]["target"]["path"] == "weights") return static_cast<int>(k);
  }
  return -1;
}

struct GltfWeights {
  std::vector<float> seconds;
  std::vector<float> weights;  ///< of each second, of each target
};

GltfWeights weights_in(const Glb& glb, std::size_t animation) {
  const nlohmann::json& moving = glb.json["animations"].at(animation);
  const int channel = weights_channel(moving);
  if (channel < 0) return {};
  const std::size_t number = moving["channels"][idx(channel)]["sampler"];
  const nlohmann::json& sampler = moving["samplers"][number];
  return {glb.values<float>(sampler["input"]), glb.values<float>(sampler["output"])};
}

TEST(ShapeAnimations, GoIntoGltfWithTheJointsOfTheirStackAndWithoutThem) {
  const OwnFolder folder;
  const Face face{{{"open", 10}, {"smile", 0, {50, 100}}},
                  {{{{slid(0, {-0.5, 1}, {0, 100}), slid(1, {-0.5, 1}, {0, 100}),
                      jaw("Lcl Rotation", {0, 1}, {{0, 9}, {0, 9}, {0, 9}})}}},
                   {{{jaw("Lcl Rotation", {0, 2}, {{0, 9}, {0, 9}, {0, 9}})}}},
                   {{{slid(0, {0, 1}, {10, 10})}}}}};
  const std::filesystem::path file = folder.write("face.fbx", face.text());
  for (const OldRig old : {OldRig::kept, OldRig::replaced}) {
    const auto edited =
        format_rig_into(file, face_rig(file), {RigFormat::glb, old, "rig", "a test"});
    const Glb glb = glb_of(edited.value().bytes);
    const nlohmann::json& animations = glb.json["animations"];
    ASSERT_EQ(animations.size(), old == OldRig::kept ? 2U : 1U) << "nothing moves in the third";
    EXPECT_EQ(animations[0]["name"], "take 1000");
    EXPECT_EQ(animations[0]["channels"].size(), old == OldRig::kept ? 2U : 1U);
    const nlohmann::json& names = glb.json["meshes"][0]["extras"]["targetNames"];
    EXPECT_EQ(names, nlohmann::json({"open", "smile stop 0", "smile"}));
    const nlohmann::json& channel = animations[0]["channels"][idx(weights_channel(animations[0]))];
    EXPECT_TRUE(glb.json["nodes"][channel["target"]["node"].get<std::size_t>()].contains("mesh"));
    const GltfWeights found = weights_in(glb, 0);
    ASSERT_EQ(found.weights.size(), 3 * found.seconds.size());
    EXPECT_EQ(found.seconds.front(), 0);
    for (std::size_t k = 0; k < found.seconds.size(); ++k) {
      const float t = found.seconds[k] / 1.5F;
      EXPECT_NEAR(found.weights[3 * k], t, 1e-5);
      EXPECT_NEAR(found.weights[3 * k + 1], t < 0.5F ? 2 * t : 2 - 2 * t, 1e-5);
      EXPECT_NEAR(found.weights[3 * k + 2], t < 0.5F ? 0 : 2 * t - 1, 1e-5);
    }
    EXPECT_EQ(edited->channels_removed, old == OldRig::kept ? 0 : 2);
  }
}

/// The bar with three targets that an animation moves, as glTF.
std::string moving_targets(const GltfWeights& keys) {
  std::string numbers;
  nlohmann::json json = nlohmann::json::parse(gltf_of({}, &numbers));
  nlohmann::json& mesh = json["meshes"][0];
  mesh["weights"] = {0, 0.25, 0};
  const auto add = [&](const std::vector<float>& values, const char* shape, std::size_t rows) {
    std::string bytes;
    for (const float value : values) rigged_bar::append(bytes, value);
    return rigged_bar::add_rows(json, numbers, bytes, 5126, shape, rows);
  };
  for (int target = 0; target < 3; ++target) {
    std::vector<float> moves(60, 0);
    moves[static_cast<std::size_t>(target)] = 0.5F;
    mesh["primitives"][0]["targets"].push_back({{"POSITION", add(moves, "VEC3", 20)}});
  }
  const int input = add(keys.seconds, "SCALAR", keys.seconds.size());
  const int output = add(keys.weights, "SCALAR", keys.weights.size());
  json["animations"] = {
      {{"name", "talk"},
       {"samplers", {{{"input", input}, {"output", output}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  json["buffers"][0] = {
      {"byteLength", numbers.size()},
      {"uri", "data:application/octet-stream;base64," + encodings::base64(numbers)}};
  return json.dump();
}

TEST(ShapeAnimations, ThroughFbxTheyAreAsBefore) {
  const OwnFolder folder;
  const GltfWeights keys{{0, 0.5F, 0.75F, 2},
                         {0, 0.25F, 0, 1, 0.25F, -0.5F, 0.2F, 0.25F, 0.3F, 0, 0.25F, 1.25F}};
  const std::filesystem::path given = folder.path() / "bar.gltf";
  write_file(given, moving_targets(keys));
  const auto as_fbx = format_rig_into(given, read_rig(given).value(),
                                      {RigFormat::fbx, OldRig::kept, "rig", "test"});
  const std::filesystem::path fbx = folder.write("bar.fbx", as_fbx.value().bytes);
  const auto again =
      format_rig_into(fbx, face_rig(fbx), {RigFormat::glb, OldRig::kept, "rig", "test"});
  const Glb glb = glb_of(again.value().bytes);
  ASSERT_EQ(glb.json["animations"].size(), 1U);
  EXPECT_EQ(glb.json["animations"][0]["name"], "talk");
  const GltfWeights found = weights_in(glb, 0);
  ASSERT_EQ(found.weights.size(), 3 * found.seconds.size());
  std::size_t met = 0;
  for (std::size_t k = 0; k < found.seconds.size(); ++k) {
    const auto key = std::ranges::find_if(
        keys.seconds, [&](float one) { return std::abs(one - found.seconds[k]) < 1e-5F; });
    if (key == keys.seconds.end()) continue;
    ++met;
    const auto row = 3 * static_cast<std::size_t>(key - keys.seconds.begin());
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(found.weights[3 * k + j], keys.weights[row + j], 1e-4);
    }
  }
  EXPECT_EQ(met, keys.seconds.size());
}

// ---- Layers -------------------------------------------------------------------------------------

/// Of a slider whose lowest layer goes from 0 to 40 in a second, at half of it.
double under(const std::vector<encodings::FbxProperty>& properties, double above) {
  const Face face{{{"open", 10}},
                  {{{{slid(0, {0, 0.5, 1}, {0, 20, 40})}},
                    {{slid(0, {0, 0.5, 1}, {above, above, above})}, properties}}}};
  return 100 * shapes_in(face).at(0).tracks.at(0).weights.at(1).at(0);
}

TEST(AnimationLayers, AddToThoseBelowOrReplaceThemAsTheySay) {
  EXPECT_NEAR(under({}, 8), 28, 1e-6);
  EXPECT_NEAR(under({{"Weight", {25.0}}}, 8), 22, 1e-6);
  EXPECT_NEAR(under({{"BlendMode", {1}}, {"Weight", {25.0}}}, 8), 8, 1e-6);
  EXPECT_NEAR(under({{"BlendMode", {2}}, {"Weight", {25.0}}}, 8), 17, 1e-6);
  EXPECT_NEAR(under({{"Mute", {1}}}, 8), 20, 1e-6);
  EXPECT_NEAR(under({{"Solo", {1}}}, 8), 18, 1e-6) << "upon the rest";
}

JointFrames frames_of(const Face& face, double seconds) {
  const AnimatedJoints found = animated_limbs::animations_in({"face.fbx", face.text()});
  const JointAnimation& moved = found.animations.at(0);
  const auto near = [&](double one) { return std::abs(one - seconds) < 1e-9; };
  const auto at = std::ranges::find_if(moved.seconds, near);
  EXPECT_NE(at, moved.seconds.end());
  return moved.frames.at(static_cast<std::size_t>(at - moved.seconds.begin()));
}

JointFrames still(const std::vector<encodings::FbxProperty>& properties) {
  return animated_limbs::animations_in({"face.fbx", Face{{}, {}, properties}.text()}).rest;
}

std::vector<std::vector<double>> held(const Vector3d& values) {
  return {{values.x(), values.x()}, {values.y(), values.y()}, {values.z(), values.z()}};
}

/// Angles of 90 degrees about one axis after the other, so that the order tells.
TEST(AnimationLayers, TurnsFollowOneAnotherOrTheirAnglesAreSummed) {
  const std::vector<encodings::FbxProperty> order{{"RotationActive", {1}}, {"RotationOrder", {4}}};
  const auto with = [&](const Vector3d& angles) {
    std::vector<encodings::FbxProperty> all = order;
    all.push_back({"Lcl Rotation", {angles.x(), angles.y(), angles.z()}});
    return all;
  };
  const Vector3d below(10, 70, -30);
  const Vector3d above(40, -20, 60);
  const auto layered = [&](const std::vector<encodings::FbxProperty>& rules) {
    return frames_of({{},
                      {{{{jaw("Lcl Rotation", {0, 1}, held(below))}},
                        {{jaw("Lcl Rotation", {0, 1}, held(above))}, rules}}},
                      order},
                     1);
  };
  const Eigen::Affine3d product = still(with(below))[0] * still(with(above))[0];
  animated_limbs::expect_alike(layered({}), {product});
  animated_limbs::expect_alike(layered({{"RotationAccumulationMode", {1}}}),
                               still(with(below + above)));
  animated_limbs::expect_alike(layered({{"BlendMode", {1}}}), still(with(above)));
  animated_limbs::expect_alike(layered({{"BlendMode", {2}}}), still(with(above)));
  animated_limbs::expect_alike(layered({{"Weight", {0.0}}}), still(with(below)));
}

TEST(AnimationLayers, FactorsAreMultipliedOrSummed) {
  const auto layered = [&](const std::vector<encodings::FbxProperty>& rules) {
    return frames_of({{},
                      {{{{jaw("Lcl Scaling", {0, 1}, held({2, 3, -4}))}},
                        {{jaw("Lcl Scaling", {0, 1}, held({4, 9, 0.25}))}, rules}}}},
                     1);
  };
  const auto scaled = [&](double x, double y, double z) {
    return still({{"Lcl Scaling", {x, y, z}}});
  };
  animated_limbs::expect_alike(layered({}), scaled(8, 27, -1));
  animated_limbs::expect_alike(layered({{"Weight", {50.0}}}), scaled(4, 9, -2));
  animated_limbs::expect_alike(layered({{"ScaleAccumulationMode", {1}}}), scaled(6, 12, -3.75));
}

/// As it is where a base is left at rest, and corrections lie above it.
TEST(AnimationLayers, UponAnEmptyOneTheyAddToTheRest) {
  const Face face{{},
                  {{{}, {{jaw("Lcl Translation", {0, 1}, held({1, 2, 3}))}}}},
                  {{"Lcl Translation", {10.0, 20.0, 30.0}}}};
  animated_limbs::expect_alike(frames_of(face, 1),
                               still({{"Lcl Translation", {11.0, 22.0, 33.0}}}));
}

}  // namespace
}  // namespace curveskel::shape_animation_laws
