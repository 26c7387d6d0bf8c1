// Laws of animations that FBX and COLLADA files have: at each moment joints stand where those of a
// still file with the numbers of that moment stand, and they move so in glTF.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include "rig/animations/read_joint_animations.hpp"
#include "rig/fbx/fbx_curve.hpp"
#include "tests/glb.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/animated_limbs.hpp"

namespace curveskel::joint_animation_laws {
namespace {

using namespace animated_limbs;

// ---- Curves -------------------------------------------------------------------------------------

FbxCurve curve_of(const FbxItem& item) {
  const FileBytes file{"a.fbx", encodings::fbx({item}, FbxForm::text)};
  const FbxRecord root = parse_fbx(file);
  return {file, *root.child("AnimationCurve")};
}

TEST(JointAnimations, CurvesOfFbxGoFromKeyToKeyAsTheirFlagsSay) {
  const std::vector<double> seconds{0, 1, 3};
  const std::vector<double> values{5, 7, -1};
  const FbxCurve line = curve_of(curve_item(1, seconds, values, 0x4));
  const FbxCurve step = curve_of(curve_item(1, seconds, values, 0x2));
  const FbxCurve next = curve_of(curve_item(1, seconds, values, 0x102));
  const FbxCurve cubic = curve_of(curve_item(1, seconds, values, 0x408, {2, -1}));
  for (const FbxCurve* one : {&line, &step, &next, &cubic}) {
    EXPECT_EQ(one->at(-1), 5);
    EXPECT_EQ(one->at(9), -1);
    for (std::size_t k = 0; k < seconds.size(); ++k)
      EXPECT_NEAR(one->at(seconds[k]), values[k], 1e-9);
  }
  EXPECT_NEAR(line.at(0.25), 5.5, 1e-9);
  EXPECT_NEAR(line.at(2), 3, 1e-9);
  EXPECT_EQ(step.at(0.99), 5);
  EXPECT_EQ(next.at(0.01), 7);
  // From 7 at slope 2 to -1 at slope -1 in 2 s.
  const double t = 0.25;
  const double hermite = (2 * t * t * t - 3 * t * t + 1) * 7 + (t * t * t - 2 * t * t + t) * 2 * 2 +
                         (3 * t * t - 2 * t * t * t) * -1 + (t * t * t - t * t) * 2 * -1;
  EXPECT_NEAR(cubic.at(1.5), hermite, 1e-9);
}

TEST(JointAnimations, SlopesLeftToTheProgramStayBetweenTheKeys) {
  const std::vector<double> seconds{0, 1, 1.1, 4, 5, 9};
  const std::vector<double> values{0, 1, 8, 9, 3, 3};
  const FbxCurve curve = curve_of(curve_item(1, seconds, values, 0x108));
  for (std::size_t k = 0; k + 1 < seconds.size(); ++k) {
    const auto [low, high] = std::minmax(values[k], values[k + 1]);
    for (double share = 0; share <= 1; share += 0.05) {
      const double value = curve.at((1 - share) * seconds[k] + share * seconds[k + 1]);
      EXPECT_GE(value, low - 1e-9);
      EXPECT_LE(value, high + 1e-9);
    }
  }
}

TEST(JointAnimations, BrokenCurvesAreRefusedByName) {
  EXPECT_THROW(curve_of(curve_item(1, {1, 0}, {1, 2})), Error);
  EXPECT_THROW(curve_of(curve_item(1, {0, 1}, {1, 2, 3})), Error);
}

// ---- FBX ----------------------------------------------------------------------------------------

TEST(JointAnimations, OfFbxStandAsTheNumbersOfTheMomentSay) {
  const FbxLimb limb(lines);
  for (const FbxForm form : {FbxForm::text, FbxForm::binary, FbxForm::binary_wide_and_zipped}) {
    const AnimatedJoints found = animations_in({"a.fbx", limb.text(0.3, true, form)});
    expect_alike(found.rest, animations_in({"b.fbx", limb.text(0.3, false, form)}).rest);
    ASSERT_EQ(found.animations.size(), 1U);
    const JointAnimation& walk = found.animations.front();
    EXPECT_EQ(walk.name, "a walk");
    ASSERT_GE(walk.seconds.size(), 16U) << "30 a second";
    ASSERT_EQ(walk.frames.size(), walk.seconds.size());
    EXPECT_NEAR(walk.seconds.back(), 0.5, 1e-9);
    for (std::size_t k = 0; k < walk.seconds.size(); ++k) {
      const std::string still = limb.text(walk.seconds[k], false, form);
      expect_alike(walk.frames[k], animations_in({"c.fbx", still}).rest);
    }
  }
}

// ---- COLLADA ------------------------------------------------------------------------------------

std::vector<double> rows_of(const Affine3d& matrix) {
  const Eigen::Matrix4d turned = matrix.matrix().transpose();
  return {turned.data(), turned.data() + 16};
}

/// Of the tracks the one animation without a name.
JointAnimation moved(const std::vector<DaeTrack>& tracks) {
  const AnimatedJoints found = animations_in({"a.dae", DaeLimb{}.text(animations_text(tracks))});
  expect_alike(found.rest, animations_in({"b.dae", DaeLimb{}.text()}).rest);
  EXPECT_EQ(found.animations.size(), 1U);
  return found.animations.empty() ? JointAnimation{} : found.animations.front();
}

void expect_at_each_moment(const JointAnimation& found,
                           const std::function<DaeLimb(double)>& still) {
  ASSERT_FALSE(found.seconds.empty());
  for (std::size_t k = 0; k < found.seconds.size(); ++k) {
    expect_alike(found.frames[k], animations_in({"c.dae", still(found.seconds[k]).text()}).rest);
  }
}

TEST(JointAnimations, OfColladaStandAsTheNumbersOfTheMomentSay) {
  const JointAnimation found = moved({{"a.1/rz.ANGLE", {0, 1}, {0, 90}},
                                      {"a.1/at", {0, 0.5}, {1, 2, 3, 4, 4, 4}},
                                      {"a.1/rx(3)", {0.25, 1}, {5, 6}, "STEP"}});
  EXPECT_GE(found.seconds.size(), 31U) << "30 a second";
  expect_at_each_moment(found, [](double t) {
    DaeLimb limb;
    limb.first_angle = 90 * t;
    const double share = std::min(1.0, 2 * t);
    limb.shift = (1 - share) * Vector3d(1, 2, 3) + share * Vector3d(4, 4, 4);
    limb.second_angle = t < 1 - 1e-9 ? 5 : 6;
    return limb;
  });
}

TEST(JointAnimations, OfColladaBendByControlPoints) {
  // Control points at thirds of the time make a cubic of that time.
  const JointAnimation bezier =
      moved({{"a.1/rz.ANGLE", {0, 3}, {0, 90}, "BEZIER", {-1, 0, 2, 60}, {1, 60, 4, 0}}});
  const JointAnimation hermite =
      moved({{"a.1/rz.ANGLE", {0, 3}, {0, 90}, "HERMITE", {0, 0, 3, 90}, {3, 180, 0, 0}}});
  const auto still = [](double seconds) {
    const double t = seconds / 3;
    DaeLimb limb;
    limb.first_angle = 3 * t * (1 - t) * (1 - t) * 60 + 3 * t * t * (1 - t) * 60 + t * t * t * 90;
    return limb;
  };
  expect_at_each_moment(bezier, still);
  expect_at_each_moment(hermite, still);
}

TEST(JointAnimations, MatricesOfColladaHaveNoMomentsBetweenTheirKeys) {
  const Affine3d from = Eigen::Translation3d(1, 0, 0) * Eigen::AngleAxisd(1, Vector3d::UnitX());
  const Affine3d to = Eigen::Translation3d(3, 4, 0) * Eigen::AngleAxisd(2, Vector3d::UnitX());
  std::vector<double> numbers = rows_of(from);
  const std::vector<double> last = rows_of(to);
  numbers.insert(numbers.end(), last.begin(), last.end());
  const JointAnimation found = moved({{"b/transform", {0, 2}, numbers}});
  EXPECT_EQ(found.seconds, (std::vector<double>{0, 2}));
  expect_at_each_moment(found, [&](double t) {
    DaeLimb limb;
    limb.matrix = t < 1 ? from : to;
    return limb;
  });
  // Beside a turn, whose moments it has, it turns and does not shrink.
  const JointAnimation both =
      moved({{"b/transform", {0, 2}, numbers}, {"a.1/rz.ANGLE", {0, 2}, {10, 10}}});
  expect_at_each_moment(both, [](double t) {
    DaeLimb limb;
    limb.matrix =
        Eigen::Translation3d(1 + t, 2 * t, 0) * Eigen::AngleAxisd(1 + t / 2, Vector3d::UnitX());
    return limb;
  });
}

TEST(JointAnimations, ClipsOfColladaBeginWithTheirStart) {
  const std::string clips =
      "<library_animation_clips><animation_clip id=\"c\" name=\"bow\" start=\"0.5\" end=\"1.5\">"
      "<instance_animation url=\"#track0\"/></animation_clip><animation_clip id=\"d\">"
      "<instance_animation url=\"#track1\"/></animation_clip></library_animation_clips>";
  const std::string library =
      animations_text({{"a.1/rz.ANGLE", {0, 2}, {0, 90}}, {"a.1/rx.ANGLE", {0, 1}, {0, 30}}});
  const AnimatedJoints found = animations_in({"a.dae", DaeLimb{}.text(library + clips)});
  ASSERT_EQ(found.animations.size(), 2U);
  EXPECT_EQ(found.animations[0].name, "bow");
  EXPECT_EQ(found.animations[1].name, "d");
  EXPECT_NEAR(found.animations[0].seconds.back(), 1, 1e-9);
  expect_at_each_moment(found.animations[0], [](double t) {
    DaeLimb limb;
    limb.first_angle = 45 * (t + 0.5);
    return limb;
  });
}

TEST(JointAnimations, OfColladaThatMoveNoNodeAreLeftOut) {
  const std::string library = animations_text({{"lamp/intensity", {0, 1}, {0, 1}},
                                               {"a.1/nothing", {0, 1}, {0, 1}},
                                               {"a.1/rz.WIDTH", {0, 1}, {0, 1}}});
  EXPECT_TRUE(animations_in({"a.dae", DaeLimb{}.text(library)}).animations.empty());
}

TEST(JointAnimations, BrokenOnesOfColladaAreRefusedByName) {
  for (const DaeTrack& track :
       {DaeTrack{"a.1/rz.ANGLE", {1, 0}, {0, 1}}, DaeTrack{"a.1/at", {0, 1}, {0, 1, 2, 3}}}) {
    const FileBytes file{"a.dae", DaeLimb{}.text(animations_text({track}))};
    EXPECT_THROW((void)read_joint_animations(file, {}), Error);
  }
}

// ---- glTF ---------------------------------------------------------------------------------------

/// A node's numbers in an animation, the key being given; those at rest where it has none.
Affine3d node_at(const Glb& glb, std::size_t node, std::optional<std::size_t> key) {
  const nlohmann::json& given = glb.json["nodes"][node];
  std::array<std::vector<double>, 3> numbers{
      given.value("translation", std::vector<double>{0, 0, 0}),
      given.value("rotation", std::vector<double>{0, 0, 0, 1}),
      given.value("scale", std::vector<double>{1, 1, 1})};
  const std::array<std::string, 3> paths{"translation", "rotation", "scale"};
  for (std::size_t k = 0; k < 3 && key; ++k) {
    const nlohmann::json& animation = glb.json["animations"][0];
    for (const nlohmann::json& channel : animation["channels"]) {
      if (channel["target"]["node"] != node || channel["target"]["path"] != paths[k]) continue;
      const nlohmann::json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
      const auto rows = glb.values<float>(sampler["output"].get<std::size_t>());
      const std::size_t width = numbers[k].size();
      std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(*key * width), width,
                  numbers[k].begin());
    }
  }
  return Eigen::Translation3d(Vector3d(numbers[0].data())) *
         Eigen::Quaterniond(Eigen::Vector4d(numbers[1].data())) *
         Eigen::Scaling(Vector3d(numbers[2].data()));
}

/// Of the skin's joints in the world.
JointFrames frames_in(const Glb& glb, std::optional<std::size_t> key) {
  const nlohmann::json& nodes = glb.json["nodes"];
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (const nlohmann::json& child : nodes[k].value("children", nlohmann::json::array())) {
      parents[child.get<std::size_t>()] = static_cast<int>(k);
    }
  }
  JointFrames frames;
  for (const nlohmann::json& joint : glb.json["skins"][0]["joints"]) {
    Affine3d frame = Affine3d::Identity();
    for (auto node = joint.get<int>(); node >= 0; node = parents[idx(node)]) {
      frame = node_at(glb, idx(node), key) * frame;
    }
    frames.push_back(frame);
  }
  return frames;
}

Rig rig_for(const std::filesystem::path& file) {
  Rig rig = read_joints(file);
  const Eigen::Index vertices = read_polygons(file).positions.rows();
  rig.weights = SkinWeights(vertices, rig.joints.rows());
  for (Eigen::Index v = 0; v < vertices; ++v) rig.weights.insert(v, v % rig.joints.rows()) = 1;
  rig.weights.makeCompressed();
  return rig;
}

void expect_moves_in_gltf(const std::string& name, const std::string& bytes,
                          const Eigen::Matrix3d& to_gltf) {
  const OwnFolder folder;
  const std::filesystem::path file = folder.write(name, bytes);
  const auto edited =
      format_rig_into(file, rig_for(file), {RigFormat::glb, OldRig::kept, "rig", "a test"});
  ASSERT_TRUE(edited);
  const Glb glb = glb_of(edited->bytes);
  ASSERT_EQ(glb.json["animations"].size(), 1U);
  const AnimatedJoints wanted = animations_in({name, bytes});
  const JointAnimation& animation = wanted.animations.front();
  Affine3d place = Affine3d::Identity();
  place.linear() = to_gltf;
  const JointFrames rest = frames_in(glb, std::nullopt);
  for (std::size_t key = 0; key < animation.seconds.size(); ++key) {
    const JointFrames found = frames_in(glb, key);
    for (std::size_t joint = 0; joint < found.size(); ++joint) {
      const Affine3d moved = animation.frames[key][joint] * wanted.rest[joint].inverse();
      const Eigen::Matrix4d expected = (place * moved * place.inverse()).matrix();
      EXPECT_LT(((found[joint] * rest[joint].inverse()).matrix() - expected).norm(), 1e-4);
    }
  }
  const auto without =
      format_rig_into(file, rig_for(file), {RigFormat::glb, OldRig::replaced, "rig", "a test"});
  EXPECT_FALSE(without && glb_of(without->bytes).json.contains("animations"));
}

TEST(JointAnimations, JointsMoveInGltfAsInTheFile) {
  Eigen::Matrix3d z_up;
  z_up << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  expect_moves_in_gltf("limb.fbx", FbxLimb(lines).text(0.3, true, FbxForm::binary),
                       0.01 * Eigen::Matrix3d::Identity());
  const std::string library =
      animations_text({{"a.1/rz.ANGLE", {0, 1}, {0, 170}}, {"a.1/at.Y", {0, 1}, {0, 5}}});
  expect_moves_in_gltf("limb.dae", DaeLimb{}.text(library), 0.0254 * z_up);
}

/// glTF has no time before 0.
TEST(JointAnimations, TimesBeforeZeroMoveTheWholeAnimation) {
  const OwnFolder folder;
  const std::string library = animations_text({{"a.1/rz.ANGLE", {-1, 1}, {0, 90}}});
  const std::filesystem::path file = folder.write("limb.dae", DaeLimb{}.text(library));
  const auto edited =
      format_rig_into(file, rig_for(file), {RigFormat::glb, OldRig::kept, "rig", "a test"});
  const Glb glb = glb_of(edited.value().bytes);
  const std::size_t input = glb.json["animations"][0]["samplers"][0]["input"];
  EXPECT_EQ(glb.json["accessors"][input]["min"][0], 0);
  EXPECT_EQ(glb.json["accessors"][input]["max"][0], 2);
  EXPECT_EQ(glb.json["animations"][0]["name"], "animation 1");
}

}  // namespace
}  // namespace curveskel::joint_animation_laws
