// Laws of meshes without a skin that hang from joints of FBX and COLLADA files: where these joints
// are kept, each follows its own.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
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
