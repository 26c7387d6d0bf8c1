// Laws of rigs in the input's own glTF file: nothing that was there is lost, and the rig is the one
// that the bare file has.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include "tests/glb.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/edit_subjects.hpp"
#include "tests/rig/rig_subjects.hpp"
#include "tests/surface/gltf_by_the_rule.hpp"

namespace curveskel::edit_gltf_laws {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// One case with a rig drawn by lot put into it.
struct Edited {
  EditSubject subject;
  PolygonSoup soup;
  Rig rig;
  fs::path path;
  Glb glb;
  int joints_replaced;
};

class EditGltf : public testing::Test {
 protected:
  [[nodiscard]] Edited edit(const EditCase& one, int joints = 9) const {
    EditSubject subject(folder_.path(), one);
    PolygonSoup soup = read_polygons(subject.path(), {}, {true});
    Rig rig = random_rig(soup.positions.rows(), joints, "bone ");
    const EditedFile edited = *format_rig_into(
        subject.path(), rig, {RigFormat::glb, OldRig::replaced, "holder rig", "a test"});
    const fs::path path = folder_.write("edited.glb", edited.bytes);
    return {std::move(subject),   std::move(soup),       std::move(rig), path,
            glb_of(edited.bytes), edited.joints_replaced};
  }

  /// The same before a rig is made and after.
  [[nodiscard]] std::string refusal(const fs::path& file) const {
    const auto message_of = [](const auto& act) -> std::string {
      try {
        act();
      } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input);
        return error.what();
      }
      return "";
    };
    const auto rows = read_polygons(file, {}, {true}).positions.rows();
    std::string late =
        message_of([&] { (void)format_rig_into(file, random_rig(rows, 3, "bone ")); });
    EXPECT_EQ(message_of([&] { require_editable(file, OldRig::replaced); }), late);
    return late;
  }

  OwnFolder folder_;
};

/// Law by law over all cases.
template <typename Law>
void for_all_cases(const Law& law) {
  for (const EditCase& one : edit_cases()) {
    SCOPED_TRACE(one.name);
    law(one);
  }
}

void expect_prefix(const Json& before, const Json& after) {
  ASSERT_LE(before.size(), after.size());
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_EQ(before[k], after[k]) << k;
}

TEST_F(EditGltf, EveryByteOfTheBuffersStaysWhereItWas) {
  for_all_cases([&](const EditCase& one) {
    const Edited edited = edit(one);
    const auto& buffers = edited.subject.buffers();
    EXPECT_EQ(edited.glb.numbers.substr(0, buffers[0].size()), buffers[0]);
    for (const std::string& buffer : buffers) {
      EXPECT_NE(edited.glb.numbers.find(buffer), std::string::npos);
    }
    EXPECT_EQ(edited.glb.json["buffers"].size(), 1U);
    EXPECT_EQ(edited.glb.json["buffers"][0]["byteLength"], edited.glb.numbers.size());
    const Json& views = edited.subject.json()["bufferViews"];
    for (std::size_t k = 0; k < views.size(); ++k) {
      const auto content = [](const Json& view, const std::string& numbers) {
        return numbers.substr(view.value("byteOffset", std::size_t{0}), view["byteLength"]);
      };
      const Json& after = edited.glb.json["bufferViews"][k];
      EXPECT_EQ(content(after, edited.glb.numbers),
                content(views[k], buffers[views[k]["buffer"].get<std::size_t>()]));
      EXPECT_EQ(after.value("byteStride", 0), views[k].value("byteStride", 0));
    }
  });
}

/// Of the members that an edit touches what stays; the others whole.
TEST_F(EditGltf, EveryMemberOfTheJsonStays) {
  for_all_cases([&](const EditCase& one) {
    const Edited edited = edit(one);
    const Json& before = edited.subject.json();
    const Json& after = edited.glb.json;
    const std::set<std::string> touched{"nodes",      "meshes",  "scenes",    "skins",
                                        "animations", "buffers", "accessors", "bufferViews",
                                        "asset",      "images"};
    for (const auto& [name, member] : before.items()) {
      if (touched.contains(name)) continue;
      EXPECT_EQ(after.value(name, Json()), member) << name;
    }
    expect_prefix(before["accessors"], after["accessors"]);
    if (!one.text) expect_prefix(before["bufferViews"], after["bufferViews"]);
    if (before.contains("images") && !one.text) {
      EXPECT_EQ(before["images"], after["images"]);
    }
    EXPECT_EQ(after["asset"]["generator"], "by hand");
    EXPECT_EQ(after["scenes"].size(), before["scenes"].size());
    for (std::size_t mesh = 0; mesh < before["meshes"].size(); ++mesh) {
      Json old_mesh = before["meshes"][mesh];
      Json new_mesh = after["meshes"][mesh];
      for (Json* both : {&old_mesh, &new_mesh}) {
        for (Json& primitive : (*both)["primitives"]) {
          for (const char* name : {"JOINTS_0", "JOINTS_1", "WEIGHTS_0", "WEIGHTS_1"}) {
            primitive["attributes"].erase(name);
          }
        }
      }
      EXPECT_EQ(old_mesh, new_mesh);
    }
  });
}

/// Nodes keep what they have, in their order; those of an old rig are gone, and the sword's holder
/// is not.
TEST_F(EditGltf, NodesThatAreNoJointsStay) {
  for_all_cases([&](const EditCase& one) {
    const Edited edited = edit(one);
    const Json& before = edited.subject.json()["nodes"];
    const Json& after = edited.glb.json["nodes"];
    std::size_t place = 0;
    for (const Json& node : before) {
      const std::string name = node["name"];
      const bool above_sword = name == "old armature" || name == "old 0" || name == "old 1";
      if (name.starts_with("old") && !above_sword) continue;
      for (const auto& [key, value] : node.items()) {
        if (key == "children" || key == "skin" || key == "mesh") continue;
        EXPECT_EQ(after[place].value(key, Json()), value) << name;
      }
      EXPECT_EQ(after[place].contains("mesh"), node.contains("mesh")) << name;
      ++place;
    }
    EXPECT_EQ(after.size(), place + 1 + idx(edited.rig.joints.rows()));
    std::set<std::string> names;
    for (const Json& node : after) EXPECT_TRUE(names.insert(node["name"]).second) << node["name"];
    EXPECT_EQ(edited.joints_replaced > 0, one.old_rig > 0);
    if (one.old_rig == 0) return;
    ASSERT_EQ(edited.glb.json["animations"].size(), 1U);  // "both", without its first channel
    ASSERT_EQ(edited.glb.json["animations"][0]["channels"].size(), 1U);
    const std::size_t moved = edited.glb.json["animations"][0]["channels"][0]["target"]["node"];
    EXPECT_EQ(after[moved]["name"], before[0]["name"]);
  });
}

TEST_F(EditGltf, ReadsBackWithTheSameVerticesAndTheRig) {
  for_all_cases([&](const EditCase& one) {
    for (const int joints : {1, 9, 300}) {
      const Edited edited = edit(one, joints);
      const PolygonSoup found = read_polygons(edited.path, {});
      const double size = bounding_box_diagonal(edited.soup.positions);
      ASSERT_EQ(found.positions.rows(), edited.soup.positions.rows());
      EXPECT_LT((found.positions - edited.soup.positions).rowwise().norm().maxCoeff(), 1e-6 * size);
      EXPECT_EQ(found.corners, edited.soup.corners);
      const Surface given{edited.soup.positions, triangulate(edited.soup)};
      const fs::path bare =
          folder_.write("bare.glb", format_rig(given, edited.rig, RigFormat::glb, "", "a test"));
      const auto expected = read_rig(bare, {});  // in the order in which readers find joints
      const auto rig = read_rig(edited.path, {});
      ASSERT_TRUE(rig && expected);
      ASSERT_EQ(rig->joints.rows(), joints);
      EXPECT_LT((rig->joints - expected->joints).norm(), 1e-9);
      EXPECT_EQ(rig->parents, expected->parents);
      EXPECT_EQ(rig->names, expected->names);
      EXPECT_LT(largest_difference(rig->weights, expected->weights), 1e-6F);
    }
  });
}

/// By the standard's rule, written down a second time; also for points and lines, whose places the
/// reader leaves out.
TEST_F(EditGltf, RestsWhereTheInputRested) {
  for_all_cases([&](const EditCase& one) {
    if (one.sparse || one.old_turn != 0) return;
    const Edited edited = edit(one);
    const auto before = GltfByTheRule(edited.subject.path()).vertices();
    const auto after = GltfByTheRule(edited.path).vertices();
    ASSERT_EQ(before.size(), after.size());
    const double size = bounding_box_diagonal(edited.soup.positions);
    for (std::size_t v = 0; v < before.size(); ++v) {
      EXPECT_LT((before[v].placed - after[v].placed).norm(), 2e-6 * size) << v;
    }
  });
}

/// Turns each joint of a file a little, the same for the same names.
void turn_joints(Json& json) {
  for (Json& node : json["nodes"]) {
    const std::string name = node.value("name", "");
    if (!name.starts_with("bone ")) continue;
    const double angle = 0.1 + 0.05 * static_cast<double>(name.size() + name.back() % 7);
    const Json& old = node["rotation"];
    const Eigen::Quaterniond turned = Eigen::Quaterniond(old[3], old[0], old[1], old[2]) *
                                      Eigen::AngleAxisd(angle, Eigen::Vector3d(1, -2, 2) / 3);
    node["rotation"] = {turned.x(), turned.y(), turned.z(), turned.w()};
  }
}

TEST_F(EditGltf, PosesAsTheBareFileDoes) {
  for_all_cases([&](const EditCase& one) {
    Edited edited = edit(one);
    const Surface given{edited.soup.positions, triangulate(edited.soup)};
    Glb bare = glb_of(format_rig(given, edited.rig, RigFormat::glb, "", "a test"));
    turn_joints(bare.json);
    turn_joints(edited.glb.json);
    const Positions by_bare =
        read_polygons(folder_.write("bare.glb", bytes_of(bare)), {}).positions;
    const Positions by_edited =
        read_polygons(folder_.write("posed.glb", bytes_of(edited.glb)), {}).positions;
    const double size = bounding_box_diagonal(by_bare);
    EXPECT_GT((by_bare - edited.soup.positions).rowwise().norm().maxCoeff(), 0.05 * size);
    EXPECT_LT((by_bare - by_edited).rowwise().norm().maxCoeff(), 1e-5 * size);
  });
}

TEST_F(EditGltf, EveryPrimitiveOfASkinnedMeshHasRows) {
  for_all_cases([&](const EditCase& one) {
    const Glb glb = edit(one).glb;
    std::map<std::size_t, int> users;
    for (const Json& node : glb.json["nodes"]) {
      if (!node.contains("mesh")) continue;
      const std::size_t mesh = node["mesh"];
      EXPECT_EQ(node.contains("skin"), node["name"] != "elsewhere");
      ++users[mesh];
      for (const Json& primitive : glb.json["meshes"][mesh]["primitives"]) {
        const Json& attributes = primitive["attributes"];
        ASSERT_EQ(attributes.contains("JOINTS_0"), node.contains("skin"));
        EXPECT_FALSE(attributes.contains("JOINTS_1"));
        if (!node.contains("skin")) continue;
        const auto count = [&](const char* name) {
          return glb.json["accessors"][attributes[name].get<std::size_t>()]["count"];
        };
        EXPECT_EQ(count("JOINTS_0"), count("POSITION"));
        EXPECT_EQ(count("WEIGHTS_0"), count("POSITION"));
      }
    }
    for (const auto& [mesh, times] : users) EXPECT_EQ(times, 1) << mesh;
  });
}

/// All that the standard wants of nodes, skins, accessors and views.
void expect_valid(const Glb& glb) {
  const Json& json = glb.json;
  const std::map<std::string, std::size_t> widths{
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  for (const Json& view : json["bufferViews"]) {
    EXPECT_EQ(view["buffer"], 0);
    EXPECT_LE(view.value("byteOffset", std::size_t{0}) + view["byteLength"].get<std::size_t>(),
              glb.numbers.size());
  }
  for (const Json& accessor : json["accessors"]) {
    const Json& view = json["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
    const int component = accessor["componentType"];
    const std::size_t size = component <= 5121 ? 1 : component <= 5123 ? 2 : 4;
    const std::size_t offset = accessor.value("byteOffset", std::size_t{0});
    EXPECT_EQ((view.value("byteOffset", std::size_t{0}) + offset) % size, 0U);
    const std::size_t row = size * widths.at(accessor["type"]);
    const std::size_t rows = accessor["count"];
    EXPECT_LE(offset + (rows - 1) * view.value("byteStride", row) + row, view["byteLength"]);
  }
  std::set<int> children;
  for (const Json& node : json["nodes"]) {
    if (node.contains("children")) {
      EXPECT_FALSE(node["children"].empty());
    }
    for (const int child : node.value("children", Json::array())) {
      EXPECT_LT(child, static_cast<int>(json["nodes"].size()));
      EXPECT_TRUE(children.insert(child).second) << child;
    }
    if (node.contains("skin")) {
      EXPECT_LT(node["skin"], json["skins"].size());
    }
  }
  for (const Json& scene : json["scenes"]) {
    for (const int root : scene["nodes"]) EXPECT_FALSE(children.contains(root)) << root;
  }
  for (const Json& skin : json["skins"]) {
    const std::set<int> joints(skin["joints"].begin(), skin["joints"].end());
    EXPECT_EQ(joints.size(), skin["joints"].size());
    const Json& matrices = json["accessors"].at(skin["inverseBindMatrices"].get<std::size_t>());
    EXPECT_EQ(matrices["count"], joints.size());
    EXPECT_LT(*joints.rbegin(), static_cast<int>(json["nodes"].size()));
  }
}

TEST_F(EditGltf, IsValid) {
  for_all_cases([&](const EditCase& one) { expect_valid(edit(one).glb); });
}

/// The file's own joints, with weights drawn by lot.
TEST_F(EditGltf, KeepsARigThatIsThere) {
  for_all_cases([&](const EditCase& one) {
    if (one.old_rig == 0) return;
    const EditSubject subject(folder_.path(), one);
    const PolygonSoup soup = read_polygons(subject.path(), {});
    Rig rig = *read_rig(subject.path(), {});
    rig.weights = random_rig(soup.positions.rows(), one.old_rig, "").weights;
    const std::string bytes =
        format_rig_into(subject.path(), rig, {RigFormat::glb, OldRig::kept, "", "a test"})->bytes;
    const Glb glb = glb_of(bytes);
    expect_valid(glb);
    for (const char* member : {"skins", "animations", "scenes", "materials"}) {
      EXPECT_EQ(glb.json.value(member, Json()), subject.json().value(member, Json())) << member;
    }
    EXPECT_EQ(glb.json["nodes"], subject.json()["nodes"]);
    const auto& numbers = subject.buffers()[0];
    EXPECT_EQ(glb.numbers.substr(0, numbers.size()), numbers);
    const fs::path path = folder_.write("kept.glb", bytes);
    const Rig found = *read_rig(path, {});
    EXPECT_EQ(found.names, rig.names);
    EXPECT_EQ(found.joints, rig.joints);
    const Eigen::Index moved = torus_surface().positions.rows();  // the others have no skin
    EXPECT_LT(largest_difference(found.weights.topRows(moved), rig.weights.topRows(moved)), 1e-6F);
    EXPECT_EQ(found.weights.bottomRows(found.weights.rows() - moved).nonZeros(), 0);
  });
}

TEST_F(EditGltf, TakesInFilesBesideIt) {
  const Edited edited = edit(edit_cases()[9]);
  const Json& image = edited.glb.json["images"][0];
  EXPECT_FALSE(image.contains("uri"));
  EXPECT_EQ(image["mimeType"], "image/png");
  const Json& view = edited.glb.json["bufferViews"][image["bufferView"].get<std::size_t>()];
  EXPECT_EQ(edited.glb.numbers.substr(view["byteOffset"], view["byteLength"]),
            std::string("\x89PNG\r\n\x1a\n not a true picture", 27));
}

TEST_F(EditGltf, KeepsChunksThatNobodyKnows) {
  const EditSubject subject(folder_.path(), {.name = "chunks"});
  Glb glb{subject.json(), subject.buffers()[0]};
  glb.numbers.resize((glb.numbers.size() + 3) / 4 * 4);
  const std::string chunk("\4\0\0\0MINEabcd", 12);
  std::string bytes = bytes_of(glb) + chunk;
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(&bytes.at(8), &size, sizeof size);
  const fs::path file = folder_.write("chunks.glb", bytes);
  const auto rows = read_polygons(file).positions.rows();
  const auto edited = format_rig_into(file, random_rig(rows, 3, "bone "));
  ASSERT_TRUE(edited);
  EXPECT_TRUE(edited->bytes.ends_with(chunk));
  std::uint32_t said = 0;
  std::memcpy(&said, &edited->bytes.at(8), sizeof said);
  EXPECT_EQ(said, edited->bytes.size());
}

TEST_F(EditGltf, SaysWhichPictureIsMissing) {
  const EditSubject subject(folder_.path(), edit_cases()[9]);
  fs::remove(folder_.path() / "a picture.png");
  const auto rows = read_polygons(subject.path()).positions.rows();
  const EditedFile edited = *format_rig_into(subject.path(), random_rig(rows, 3, "bone "),
                                             {RigFormat::glb, OldRig::replaced, "", ""});
  ASSERT_EQ(edited.notes.size(), 1U);
  EXPECT_NE(edited.notes[0].find("a%20picture.png"), std::string::npos);
  EXPECT_EQ(glb_of(edited.bytes).json["images"][0]["uri"], "a%20picture.png");
}

/// Joints keep their names, by which programs find them.
TEST_F(EditGltf, SaysWhichJointsHaveTheNamesOfNodes) {
  const EditSubject subject(folder_.path(), edit_cases().front());
  const auto rows = read_polygons(subject.path(), {}, {true}).positions.rows();
  const std::string name = subject.json()["nodes"][0]["name"];
  for (const bool is_shared : {false, true}) {
    Rig rig = random_rig(rows, 3, "bone ");
    if (is_shared) rig.names[1] = name;
    const EditedFile edited =
        *format_rig_into(subject.path(), rig, {RigFormat::glb, OldRig::replaced, "", ""});
    ASSERT_EQ(edited.notes.size(), is_shared ? 1U : 0U);
    if (!is_shared) continue;
    EXPECT_NE(edited.notes[0].find(name), std::string::npos) << edited.notes[0];
    const Json json = glb_of(edited.bytes).json;
    const std::size_t joint = json["skins"].back()["joints"][1];
    EXPECT_EQ(json["nodes"][joint]["name"], name);
  }
}

TEST_F(EditGltf, TextHoldsWhatTheBinaryFileHolds) {
  for_all_cases([&](const EditCase& one) {
    const Edited edited = edit(one);
    Json text =
        Json::parse(format_rig_into(edited.subject.path(), edited.rig,
                                    {RigFormat::gltf, OldRig::replaced, "holder rig", "a test"})
                        ->bytes);
    EXPECT_EQ(text["buffers"][0]["uri"],
              "data:application/octet-stream;base64," + encodings::base64(edited.glb.numbers));
    text["buffers"][0].erase("uri");
    EXPECT_EQ(text, edited.glb.json);
  });
}

TEST_F(EditGltf, RefusesByNameWhatItWouldBreak) {
  const auto with = [&](const EditCase& one, const Json& patch) {
    const EditSubject subject(folder_.path(), one);
    Json json = subject.json();
    json.merge_patch(patch);
    std::string numbers = subject.buffers()[0];
    numbers.resize((numbers.size() + 3) / 4 * 4);
    return refusal(folder_.write("patched.glb", bytes_of({json, numbers})));
  };
  const EditCase plain{.name = "plain"};
  const EditCase rigged{.name = "rigged", .old_rig = 3};
  const std::string instancing = "EXT_mesh_gpu_instancing";
  EXPECT_NE(with(plain, {{"extensionsUsed", {instancing}}}).find(instancing), std::string::npos);
  const Json vrm{{"extensions", {{"VRM", {{"humanoid", {{"humanBones", {{{"node", 3}}}}}}}}}}};
  EXPECT_EQ(with(plain, vrm), "");  // no node gets another number
  const std::string refused = with(rigged, vrm);
  EXPECT_NE(refused.find("VRM"), std::string::npos);
  EXPECT_NE(refused.find("--keep-rig"), std::string::npos);
  EXPECT_EQ(with(rigged, {{"extensions", {{"MINE", {{"lights", {1, 2}}}}}}}), "");
}

TEST_F(EditGltf, AFileWithoutNodesGetsSome) {
  const EditSubject subject(folder_.path(), {.name = "no nodes"});
  Json json = subject.json();
  json.erase("nodes");
  json.erase("scenes");
  json.erase("scene");
  std::string numbers = subject.buffers()[0];
  numbers.resize((numbers.size() + 3) / 4 * 4);
  const fs::path file = folder_.write("without.glb", bytes_of({json, numbers}));
  const PolygonSoup soup = read_polygons(file);
  const Rig rig = random_rig(soup.positions.rows(), 4, "bone ");
  const fs::path path = folder_.write(
      "with.glb",
      format_rig_into(file, rig, {RigFormat::glb, OldRig::replaced, "rig", "a test"})->bytes);
  EXPECT_LT((read_polygons(path).positions - soup.positions).norm(), 1e-5);
  EXPECT_EQ(read_rig(path, {})->names, rig.names);
}

}  // namespace
}  // namespace curveskel::edit_gltf_laws
