// Laws of meshes without a skin that hang from joints of FBX and COLLADA files: where these joints
// are kept, each follows its own.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include "tests/glb.hpp"
#include "tests/own_folder.hpp"
#include "tests/surface/scene_encodings.hpp"

namespace curveskel::hanging_part_laws {
namespace {

/// Of each mesh the joints by name, with the weights that they have in all vertices.
using JointsOfMesh = std::vector<std::vector<std::pair<std::string, float>>>;

JointsOfMesh joints_in(const Glb& glb) {
  JointsOfMesh all;
  const nlohmann::json& nodes = glb.json["nodes"];
  for (const nlohmann::json& node : nodes) {
    if (!node.contains("mesh")) continue;
    const nlohmann::json& mesh = glb.json["meshes"][node["mesh"].get<std::size_t>()];
    const nlohmann::json& attributes = mesh["primitives"][0]["attributes"];
    const nlohmann::json& joints = glb.json["skins"][node["skin"].get<std::size_t>()]["joints"];
    const std::size_t which = attributes["JOINTS_0"];
    const auto weights = glb.values<float>(attributes["WEIGHTS_0"]);
    std::vector<std::size_t> numbers;
    if (glb.json["accessors"][which]["componentType"] == 5121) {
      for (const auto one : glb.values<std::uint8_t>(which)) numbers.push_back(one);
    } else {
      for (const auto one : glb.values<std::uint16_t>(which)) numbers.push_back(one);
    }
    auto& made = all.emplace_back();
    for (std::size_t k = 0; k < weights.size(); ++k) {
      if (weights[k] == 0) continue;
      made.emplace_back(nodes[joints[numbers[k]].get<std::size_t>()]["name"], weights[k]);
    }
  }
  return all;
}

/// With half of each vertex for either of the file's two joints.
JointsOfMesh joints_of(const std::filesystem::path& file, OldRig old) {
  Rig rig = read_joints(file);
  EXPECT_EQ(rig.joints.rows(), 2);
  const Eigen::Index vertices = read_polygons(file).positions.rows();
  rig.weights = SkinWeights(vertices, 2);
  for (Eigen::Index v = 0; v < vertices; ++v) {
    rig.weights.insert(v, 0) = 0.5;
    rig.weights.insert(v, 1) = 0.5;
  }
  rig.weights.makeCompressed();
  const auto edited = format_rig_into(file, rig, {RigFormat::glb, old, "rig", "a test"});
  return joints_in(glb_of(edited.value().bytes));
}

void expect_blend(const std::vector<std::pair<std::string, float>>& found) {
  ASSERT_FALSE(found.empty());
  for (const auto& [name, weight] : found) EXPECT_FLOAT_EQ(weight, 0.5F);
}

void expect_follows(const std::vector<std::pair<std::string, float>>& found,
                    const std::string& joint) {
  ASSERT_FALSE(found.empty());
  for (const auto& [name, weight] : found) {
    EXPECT_EQ(name, joint);
    EXPECT_EQ(weight, 1);
  }
}

/// Meshes: with a skin below joint b; below joint a; below a null below joint b; beside joints.
void expect_each_follows_its_own(const std::filesystem::path& file) {
  const JointsOfMesh kept = joints_of(file, OldRig::kept);
  ASSERT_EQ(kept.size(), 4U);
  expect_blend(kept[0]);
  expect_follows(kept[1], "a");
  expect_follows(kept[2], "b");
  expect_blend(kept[3]);
  for (const auto& mesh : joints_of(file, OldRig::replaced)) expect_blend(mesh);
}

/// From the node to the scene.
Eigen::Affine3d frame_in(const nlohmann::json& nodes, std::size_t number) {
  const nlohmann::json& node = nodes[number];
  const auto shift = node.value("translation", std::vector<double>{0, 0, 0});
  const auto turn = node.value("rotation", std::vector<double>{0, 0, 0, 1});
  const auto scale = node.value("scale", std::vector<double>{1, 1, 1});
  Eigen::Affine3d own = Eigen::Translation3d(Eigen::Vector3d(shift.data())) *
                        Eigen::Quaterniond(Eigen::Vector4d(turn.data())) *
                        Eigen::Scaling(Eigen::Vector3d(scale.data()));
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (const nlohmann::json& child : nodes[k].value("children", nlohmann::json::array())) {
      if (child == number) return frame_in(nodes, k) * own;
    }
  }
  return own;
}

/// A null below the joint, turned and shifted; the file's unit is the centimetre, so is FBX's.
TEST(HangingParts, PlacesThatHangFromJointsStayThere) {
  encodings::FbxItem joint = encodings::fbx_model(
      20, {{"Lcl Translation", {1.0, 2.0, 3.0}}, {"Lcl Rotation", {30.0, 40.0, 50.0}}}, "LimbNode");
  encodings::FbxItem place = encodings::fbx_model(
      21, {{"Lcl Translation", {5.0, 0.0, -4.0}}, {"Lcl Rotation", {0.0, -20.0, 70.0}}}, "Null");
  place.values[1] = "Model::socket";
  encodings::FbxItem beside = encodings::fbx_model(22, {}, "Null");
  beside.values[1] = "Model::beside";
  const encodings::FbxItems scene =
      encodings::fbx_scene({encodings::fbx_box(), encodings::fbx_model(10), joint, place, beside},
                           {{1, 10}, {10, 0}, {20, 0}, {21, 20}, {22, 0}});
  const OwnFolder folder;
  const auto file = folder.write("socket.fbx", encodings::fbx(scene, encodings::FbxForm::binary));
  Rig rig = read_joints(file);
  rig.weights = SkinWeights(8, 1);
  for (Eigen::Index v = 0; v < 8; ++v) rig.weights.insert(v, 0) = 1;
  rig.weights.makeCompressed();
  const auto turn = [](double x, double y, double z) {
    const double degree = std::numbers::pi / 180;
    return Eigen::AngleAxisd(z * degree, Eigen::Vector3d::UnitZ()) *
           Eigen::AngleAxisd(y * degree, Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(x * degree, Eigen::Vector3d::UnitX());
  };
  const Eigen::Affine3d wanted = Eigen::Scaling(0.01) * Eigen::Translation3d(1, 2, 3) *
                                 turn(30, 40, 50) * Eigen::Translation3d(5, 0, -4) *
                                 turn(0, -20, 70);
  for (const OldRig old : {OldRig::kept, OldRig::replaced}) {
    const auto edited = format_rig_into(file, rig, {RigFormat::glb, old, "rig", "a test"});
    const nlohmann::json nodes = glb_of(edited.value().bytes).json["nodes"];
    std::size_t met = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      EXPECT_NE(nodes[k]["name"], "beside");
      if (nodes[k]["name"] != "socket") continue;
      ++met;
      EXPECT_LT((frame_in(nodes, k).matrix() - wanted.matrix()).norm(), 1e-6);
    }
    EXPECT_EQ(met, old == OldRig::kept ? 1U : 0U);
  }
}

TEST(HangingParts, OfFbxFollowTheirJoint) {
  const auto joint = [](std::int64_t number, const std::string& name) {
    encodings::FbxItem item = encodings::fbx_model(number, {}, "LimbNode");
    item.values[1] = "Model::" + name;
    return item;
  };
  const std::vector<double> identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const encodings::FbxItems scene =
      encodings::fbx_scene({encodings::fbx_box(),
                            encodings::fbx_model(10),
                            encodings::fbx_model(11),
                            encodings::fbx_model(12),
                            encodings::fbx_model(13),
                            encodings::fbx_model(14, {}, "Null"),
                            joint(20, "a"),
                            joint(21, "b"),
                            {"Geometry",
                             {std::int64_t{2}, "Geometry::skinned", "Mesh"},
                             {{"Vertices", {std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}}},
                              {"PolygonVertexIndex", {std::vector<int>{0, 1, -3}}}}},
                            {"Deformer", {std::int64_t{30}, "Deformer::s", "Skin"}},
                            {"Deformer",
                             {std::int64_t{31}, "SubDeformer::c", "Cluster"},
                             {{"Indexes", {std::vector<int>{0, 1, 2}}},
                              {"Weights", {std::vector<double>{1, 1, 1}}},
                              {"Transform", {identity}},
                              {"TransformLink", {identity}}}}},
                           {{20, 0},
                            {21, 20},
                            {10, 21},
                            {11, 20},
                            {14, 21},
                            {12, 14},
                            {13, 0},
                            {2, 10},
                            {1, 11},
                            {1, 12},
                            {1, 13},
                            {30, 2},
                            {31, 30},
                            {20, 31}});
  const OwnFolder folder;
  expect_each_follows_its_own(
      folder.write("parts.fbx", encodings::fbx(scene, encodings::FbxForm::binary)));
}

TEST(HangingParts, OfColladaFollowTheirJoint) {
  const std::string box = "<instance_geometry url=\"#box\"/>";
  const std::string joints = "<source id=\"j\"><Name_array count=\"1\">a</Name_array></source>";
  const std::string matrices =
      "<source id=\"m\"><float_array count=\"16\">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 "
      "1</float_array></source>";
  const std::string shares = "<source id=\"w\"><float_array count=\"1\">1</float_array></source>";
  const std::string skin =
      "<library_controllers><controller id=\"skin\"><skin source=\"#box\">" + joints + matrices +
      shares +
      "<joints><input semantic=\"JOINT\" source=\"#j\"/><input semantic=\"INV_BIND_MATRIX\" "
      "source=\"#m\"/></joints><vertex_weights count=\"8\"><input semantic=\"JOINT\" "
      "source=\"#j\" offset=\"0\"/><input semantic=\"WEIGHT\" source=\"#w\" "
      "offset=\"1\"/><vcount>1 1 1 1 1 1 1 1</vcount><v>0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0</v>"
      "</vertex_weights></skin></controller></library_controllers>";
  // Meshes come in the order of their nodes, depth first.
  const std::string nodes =
      "<node id=\"a\" name=\"a\" sid=\"a\" type=\"JOINT\"><node id=\"b\" name=\"b\" sid=\"b\" "
      "type=\"JOINT\"><node><instance_controller url=\"#skin\"/></node></node><node>" +
      box + "</node></node><node id=\"c\"/><node>" + box + "</node>";
  const OwnFolder folder;
  const auto file = folder.write(
      "parts.dae", encodings::dae(encodings::dae_geometry(encodings::dae_quads()), nodes, skin));
  const JointsOfMesh kept = joints_of(file, OldRig::kept);
  ASSERT_EQ(kept.size(), 3U);
  expect_blend(kept[0]);
  expect_follows(kept[1], "a");
  expect_blend(kept[2]);
  for (const auto& mesh : joints_of(file, OldRig::replaced)) expect_blend(mesh);
}

}  // namespace
}  // namespace curveskel::hanging_part_laws
