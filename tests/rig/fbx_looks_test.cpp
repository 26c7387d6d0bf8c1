// Laws of what FBX files show: pictures, shapes, metal, light, colours and sets are the same in
// glTF, in the FBX that a rig is written to, and in what that becomes again.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_materials.hpp>
#include <curveskel/rig_files.hpp>
#include "base/base64.hpp"
#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"
#include "tests/glb.hpp"
#include "tests/rig/fbx_subjects.hpp"

namespace curveskel::fbx_looks_laws {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using namespace fbx_subjects;

class FbxLooks : public FbxDressing {
 protected:
  /// As FBX, which is rigged again.
  [[nodiscard]] fs::path again(const fs::path& file) const {
    return folder_.write("again.fbx", dressed(file, RigFormat::fbx).bytes);
  }

  /// The same as glTF directly, and by way of FBX.
  [[nodiscard]] std::vector<Glb> both(const fs::path& file) const {
    return {glb_of(dressed(file).bytes), glb_of(dressed(again(file)).bytes)};
  }
};

FbxItem link(std::int64_t child, std::int64_t parent, const std::string& property = {}) {
  if (property.empty()) return {"C", {"OO", child, parent}};
  return {"C", {"OP", child, parent, property}};
}

FbxItem texture(std::int64_t number, const std::string& file,
                const std::vector<encodings::FbxProperty>& given = {}) {
  return {"Texture", {number, "Texture::t", ""}, {{"RelativeFilename", {file}}, properties(given)}};
}

/// Some numbers have a meaning there that they do not have elsewhere.
const std::string blender = "Blender (stable FBX IO)";

/// Face f has material f mod `count`.
FbxItem box_of_materials(int count) {
  FbxItem box = encodings::fbx_box();
  std::vector<int> numbers(6);
  for (int face = 0; face < 6; ++face) numbers[idx(face)] = face % count;
  box.children.push_back({"LayerElementMaterial",
                          {0},
                          {{"MappingInformationType", {"ByPolygon"}},
                           {"ReferenceInformationType", {"IndexToDirect"}},
                           {"Materials", {numbers}}}});
  return box;
}

FbxItem box_with(const std::string& layer, const std::string& values, const std::string& name,
                 const std::vector<double>& numbers, FbxItem box = encodings::fbx_box()) {
  box.children.push_back({layer,
                          {0},
                          {{"Name", {name}},
                           {"MappingInformationType", {"ByVertice"}},
                           {"ReferenceInformationType", {"Direct"}},
                           {values, {numbers}}}});
  return box;
}

/// Row v is (.1 v, .05 v).
FbxItem with_map(const std::string& name, FbxItem box = encodings::fbx_box()) {
  std::vector<double> numbers;
  for (int v = 0; v < 8; ++v) numbers.insert(numbers.end(), {0.1 * v, 0.05 * v});
  return box_with("LayerElementUV", "UV", name, numbers, std::move(box));
}

std::string picture_in(const Glb& glb, const Json& reference) {
  const Json& texture = glb.json["textures"][reference["index"].get<std::size_t>()];
  const Json& image = glb.json["images"][texture["source"].get<std::size_t>()];
  const Json& view = glb.json["bufferViews"][image["bufferView"].get<std::size_t>()];
  return glb.numbers.substr(view["byteOffset"], view["byteLength"]);
}

// Two folders with a picture of one name each: one of them was shown for both.
TEST_F(FbxLooks, PicturesOfOneNameStayApart) {
  FbxItems beside;
  std::vector<FbxItem> links;
  const std::vector<std::string> names{"a/skin.png", "b/skin.png", "c/SKIN.png"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    fs::create_directory(folder_.path() / names[k].substr(0, 1));
    (void)folder_.write(names[k], png + names[k]);
    beside.push_back(material(int(k), {}));
    beside.push_back(texture(30 + std::int64_t(k), names[k]));
    links.push_back(link(30 + std::int64_t(k), first_material + std::int64_t(k), "DiffuseColor"));
  }
  const fs::path file = written(scene(box_of_materials(3), encodings::fbx_model(2), beside, links));
  for (const Glb& glb : both(file)) {
    ASSERT_EQ(glb.json["materials"].size(), names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      const Json& look = glb.json["materials"][k]["pbrMetallicRoughness"];
      EXPECT_EQ(picture_in(glb, look["baseColorTexture"]), png + names[k]);
    }
  }
  // Programs know pictures by these, on some systems without regard to case.
  const FileBytes made{"again.fbx", dressed(file, RigFormat::fbx).bytes};
  const FbxRecord root = parse_fbx(made);
  std::set<std::string> files;
  for (const FbxRecord* video : FbxScene(made, root).all("Video")) {
    std::string name(video->child("RelativeFilename")->text(0));
    std::ranges::transform(name, name.begin(), [](char c) { return char(std::tolower(c)); });
    EXPECT_TRUE(name.ends_with(".png"));
    files.insert(name);
  }
  EXPECT_EQ(files.size(), names.size());
}

/// A channel that is on by `percent`, of the box turned.
FbxItems morphed(double percent) {
  const FbxItems beside{material(0, {}),
                        {"Deformer", {std::int64_t{40}, "Deformer::m", "BlendShape"}},
                        {"Deformer",
                         {std::int64_t{50}, "SubDeformer::smile", "BlendShapeChannel"},
                         {{"DeformPercent", {percent}}}},
                        {"Geometry",
                         {std::int64_t{60}, "Geometry::s", "Shape"},
                         {{"Indexes", {std::vector<int>{2, 7}}},
                          {"Vertices", {std::vector<double>{0.5, 0, 0, 0, 0, 2}}}}}};
  return scene(encodings::fbx_box(), encodings::fbx_model(2, {{"Lcl Rotation", {0.0, 0.0, 90.0}}}),
               beside, {link(40, 1), link(50, 40), link(60, 50)});
}

// A shape that was on became part of the mesh, and then came on top of it: 150 % of it.
TEST_F(FbxLooks, ShapesThatAreOnStaySliders) {
  const Positions base = read_polygons(written(morphed(0))).positions;
  for (const double percent : {50.0, -25.0, 100.0}) {
    const fs::path file = written(morphed(percent));
    const Positions shown = read_polygons(file).positions;
    EXPECT_GT((shown - base).norm(), 0.1);
    const fs::path made = folder_.write("made.glb", dressed(file).bytes);
    EXPECT_LT((read_polygons(made).positions.topRows(8) - 0.01 * shown).norm(), 1e-7);
    EXPECT_LT((read_polygons(again(file)).positions.topRows(8) - 0.01 * shown).norm(), 1e-7);
    for (const auto& [one, unit] : {std::pair(file, 1.0), std::pair(again(file), 0.01)}) {
      const Glb glb = glb_of(dressed(one).bytes);
      const Json& mesh = glb.json["meshes"][0];
      EXPECT_EQ(mesh["weights"], Json({percent / 100}));
      EXPECT_EQ(mesh["extras"]["targetNames"], Json({"smile"}));
      const auto stored = glb.values<float>(mesh["primitives"][0]["attributes"]["POSITION"]);
      for (Eigen::Index v = 0; v < 8; ++v) {
        for (Eigen::Index k = 0; k < 3; ++k) {
          EXPECT_NEAR(stored[idx(3 * v + k)], unit * base(v, k), 1e-6);
        }
      }
    }
  }
}

/// Blender leaves out what is as in the template, as full metal is.
TEST_F(FbxLooks, MaterialsHaveTheNumbersOfTheirTemplate) {
  const std::vector<encodings::FbxProperty> defaults{
      {"DiffuseColor", {0.5, 0.25, 0.75}}, {"EmissiveColor", {0.125, 0.0, 0.0}},
      {"ReflectionFactor", {1.0}},         {"Shininess", {25.0}},
      {"ShininessExponent", {64.0}},       {"Opacity", {1.0}}};
  const FbxItems materials{material(0, {}), material(1, {{"ReflectionFactor", {0.25}},
                                                         {"ShininessExponent", {4.0}},
                                                         {"DiffuseColor", {1.0, 1.0, 1.0}},
                                                         {"TransparencyFactor", {0.75}}})};
  FbxItems records = scene(box_of_materials(2), encodings::fbx_model(2), materials);
  records.push_back({"Definitions",
                     {},
                     {{"ObjectType",
                       {"Material"},
                       {{"PropertyTemplate", {"FbxSurfacePhong"}, {properties(defaults)}}}}}});
  for (const Glb& glb : both(written(records, FbxForm::binary, blender))) {
    ASSERT_EQ(glb.json["materials"].size(), 2U);
    const Json& first = glb.json["materials"][0];
    const Json& look = first["pbrMetallicRoughness"];
    EXPECT_EQ(look["baseColorFactor"], Json({0.5, 0.25, 0.75, 1.0}));
    EXPECT_EQ(look["metallicFactor"], 1);
    EXPECT_NEAR(look["roughnessFactor"].get<double>(), 0.5, 1e-12);
    EXPECT_EQ(first["emissiveFactor"], Json({0.125, 0, 0}));
    const Json& own = glb.json["materials"][1]["pbrMetallicRoughness"];
    EXPECT_EQ(own["baseColorFactor"], Json({1.0, 1.0, 1.0, 0.25}));
    EXPECT_EQ(own["metallicFactor"], 0.25);
    EXPECT_NEAR(own["roughnessFactor"].get<double>(), 0.8, 1e-12);
  }
}

// They were written as shares of light and read as sRGB: darker with each pass.
TEST_F(FbxLooks, ColoursOfVerticesStayWhatTheyAre) {
  std::vector<double> numbers;
  for (int v = 0; v < 8; ++v) numbers.insert(numbers.end(), {0.13 * v, 0.01 * v, 1 - 0.1 * v, 0.5});
  const FbxItem box = box_with("LayerElementColor", "Colors", "tint", numbers);
  const fs::path file = written(scene(box, encodings::fbx_model(2), {material(0, {})}));
  for (const Glb& glb : both(file)) {
    const Json& attributes = glb.json["meshes"][0]["primitives"][0]["attributes"];
    const auto rows = glb.values<float>(attributes["COLOR_0"]);
    ASSERT_EQ(rows.size(), 32U);
    for (std::size_t k = 0; k < 32; ++k) {
      const double given = numbers[k];
      const double light =
          given <= 0.04045 ? given / 12.92 : std::pow((given + 0.055) / 1.055, 2.4);
      EXPECT_NEAR(rows[k], k % 4 == 3 ? given : light, 1e-6);
    }
  }
}

TEST_F(FbxLooks, BrightLightKeepsItsHue) {
  const FbxItems materials{
      material(0, {{"EmissiveColor", {1.0, 0.5, 0.25}}, {"EmissiveFactor", {4.0}}}),
      material(1, {{"EmissiveColor", {1.0, 0.5, 0.25}}, {"EmissiveFactor", {0.5}}})};
  for (const Glb& glb :
       both(written(scene(box_of_materials(2), encodings::fbx_model(2), materials)))) {
    EXPECT_EQ(glb.json["extensionsUsed"], Json({"KHR_materials_emissive_strength"}));
    ASSERT_EQ(glb.json["materials"].size(), 2U);
    const Json& bright = glb.json["materials"][0];
    EXPECT_EQ(bright["emissiveFactor"], Json({1.0, 0.5, 0.25}));
    EXPECT_EQ(bright["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"], 4);
    EXPECT_EQ(glb.json["materials"][1]["emissiveFactor"], Json({0.5, 0.25, 0.125}));
    EXPECT_FALSE(glb.json["materials"][1].contains("extensions"));
  }
}

/// Blender's numbers are the inverse, and radians to the other side.
TEST_F(FbxLooks, TilesLieWhereTheFilePutsThem) {
  (void)folder_.write("skin.png", png);
  constexpr double turn = 0.4;
  for (const bool is_blenders : {true, false}) {
    const double angle = is_blenders ? -turn : turn * 180 / std::numbers::pi;
    const std::vector<double> scale =
        is_blenders ? std::vector{0.25, 0.5, 1.0} : std::vector{4.0, 2.0, 1.0};
    const FbxItems beside{material(0, {{"BumpFactor", {0.75}}}),
                          texture(30, "skin.png",
                                  {{"Translation", {0.1, 0.3, 0.0}},
                                   {"Rotation", {0.0, 0.0, angle}},
                                   {"Scaling", {scale[0], scale[1], scale[2]}}})};
    FbxItems records =
        scene(with_map("map"), encodings::fbx_model(2), beside,
              {link(30, first_material, "DiffuseColor"), link(30, first_material, "NormalMap")});
    const fs::path file = written(records, FbxForm::binary, is_blenders ? blender : "nobody");
    for (const fs::path& one : {file, again(file)}) {
      const auto look = read_materials(one);
      ASSERT_TRUE(look);
      for (const int drawn : look->triangles.reshaped()) {
        const int v = look->vertices[idx(drawn)] % 8;
        const double u = 4 * 0.1 * v;
        const double w = 2 * 0.05 * v;
        const auto& place = look->places_in_picture;
        EXPECT_NEAR(place(drawn, 0), std::cos(turn) * u - std::sin(turn) * w + 0.1, 1e-5);
        EXPECT_NEAR(1 - place(drawn, 1), std::sin(turn) * u + std::cos(turn) * w + 0.3, 1e-5);
      }
    }
    for (const Glb& glb : both(file)) {
      EXPECT_EQ(glb.json["extensionsUsed"], Json({"KHR_texture_transform"}));
      const Json& normals = glb.json["materials"][0]["normalTexture"];
      EXPECT_EQ(normals.value("scale", 1.0), is_blenders ? 0.75 : 1);
      EXPECT_TRUE(normals["extensions"].contains("KHR_texture_transform"));
    }
  }
}

/// The upper corners follow joint 18, which was bound at (0, 0, 3) and stands at (9, 4, 3); the
/// lower ones joint 8 above it, at (0, 0, 0) and (9, 0, 0).
TEST_F(FbxLooks, APosedFileIsDressedInThePoseThatOneAsksFor) {
  const auto cluster = [](std::int64_t number, const std::vector<int>& moved, double height) {
    const auto shifted = [](double z) {
      return std::vector<double>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, z, 1};
    };
    return FbxItem{"Deformer",
                   {number, "SubDeformer::c", "Cluster"},
                   {{"Indexes", {moved}},
                    {"Weights", {std::vector<double>(4, 1.0)}},
                    {"Transform", {shifted(-height)}},
                    {"TransformLink", {shifted(height)}}}};
  };
  const FbxItems beside{
      material(0, {}),
      encodings::fbx_model(8, {{"Lcl Translation", {9.0, 0.0, 0.0}}}, "LimbNode"),
      encodings::fbx_model(18, {{"Lcl Translation", {0.0, 4.0, 3.0}}}, "LimbNode"),
      {"Deformer", {std::int64_t{5}, "Deformer::skin", "Skin"}},
      cluster(6, {0, 1, 2, 3}, 0),
      cluster(7, {4, 5, 6, 7}, 3)};
  const fs::path file = written(scene(
      encodings::fbx_box(), encodings::fbx_model(2), beside,
      {link(8, 0), link(18, 8), link(5, 1), link(6, 5), link(7, 5), link(8, 6), link(18, 7)}));
  EXPECT_GT((read_polygons(file).positions - read_polygons(file, {}, {true}).positions).norm(), 1);
  for (const bool as_bound : {true, false}) {
    for (const RigFormat format : {RigFormat::glb, RigFormat::fbx}) {
      const fs::path made = folder_.write("made." + std::string(name_of(rig_formats, format)),
                                          dressed(file, format, as_bound).bytes);
      const Positions wanted = read_polygons(file, {}, {as_bound}).positions;
      const PolygonSoup seen = read_polygons(made);
      EXPECT_FALSE(seen.posed);
      EXPECT_LT((seen.positions.topRows(8) - 0.01 * wanted).norm(), 1e-7);
    }
  }
}

/// One has two maps and colours, and a picture on the second map; the other has none of these.
TEST_F(FbxLooks, EachMeshHasItsOwnSetsWithTheirNames) {
  (void)folder_.write("skin.png", png);
  FbxItem rich = with_map("second", with_map("first"));
  rich = box_with("LayerElementColor", "Colors", "tint", std::vector<double>(32, 0.5), rich);
  FbxItem poor = encodings::fbx_box();
  poor.values[0] = std::int64_t{3};
  const FbxItems beside{material(0, {}), std::move(poor), encodings::fbx_model(4),
                        texture(30, "skin.png", {{"UVSet", {"second"}}})};
  const fs::path file =
      written(scene(rich, encodings::fbx_model(2), beside,
                    {link(4, 0), link(3, 4), link(30, first_material, "DiffuseColor")}));
  const FileBytes made{"again.fbx", dressed(file, RigFormat::fbx).bytes};
  const FbxRecord root = parse_fbx(made);
  std::multiset<std::vector<std::string>> found;
  for (const FbxRecord* geometry : FbxScene(made, root).all("Geometry")) {
    std::vector<std::string> names;
    for (const FbxRecord& child : geometry->children) {
      const FbxRecord* name = child.child("Name");
      const bool is_set = child.name == "LayerElementUV" || child.name == "LayerElementColor";
      if (is_set && name != nullptr) names.emplace_back(name->text(0));
    }
    found.insert(names);
  }
  EXPECT_EQ(found, (std::multiset<std::vector<std::string>>{{}, {"tint", "first", "second"}}));
  for (const Glb& glb : both(file)) {
    EXPECT_EQ(glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"], 1);
  }
}

std::vector<std::string> texts_in(const FbxRecord& root, const FileBytes& file,
                                  const std::string& kind, const std::string& property) {
  std::vector<std::string> texts;
  for (const FbxRecord* object : FbxScene(file, root).all(kind)) {
    const FbxRecord* found = object->child(property);
    const std::size_t at = found == nullptr ? first_property_value : 0;
    if (found == nullptr) found = fbx_property(object, property);
    texts.emplace_back(found == nullptr ? "" : found->text(at));
  }
  return texts;
}

/// Of each mesh.
std::vector<std::set<std::string>> maps_in(const FbxRecord& root, const FileBytes& file) {
  std::vector<std::set<std::string>> maps;
  for (const FbxRecord* geometry : FbxScene(file, root).all("Geometry")) {
    maps.emplace_back();
    for (const FbxRecord& child : geometry->children) {
      const FbxRecord* name = child.name == "LayerElementUV" ? child.child("Name") : nullptr;
      if (name != nullptr) maps.back().emplace(name->text(0));
    }
  }
  return maps;
}

/// Two boxes show one picture, by maps of these names.
TEST_F(FbxLooks, ATextureNamesASetThatAllItsMeshesHave) {
  (void)folder_.write("skin.png", png);
  for (const std::string other : {"painted", "drawn"}) {
    FbxItem box = with_map(other);
    box.values[0] = std::int64_t{3};
    const FbxItems beside{material(0, {}), std::move(box), encodings::fbx_model(4),
                          texture(30, "skin.png")};
    const fs::path file = written(scene(with_map("painted"), encodings::fbx_model(2), beside,
                                        {link(4, 0), link(3, 4), link(first_material, 4),
                                         link(30, first_material, "DiffuseColor")}));
    const FileBytes made{"again.fbx", dressed(file, RigFormat::fbx).bytes};
    const FbxRecord root = parse_fbx(made);
    const std::string named = other == "painted" ? "painted" : "UVMap";
    EXPECT_EQ(texts_in(root, made, "Texture", "UVSet"), std::vector{named});
    EXPECT_EQ(maps_in(root, made), std::vector(2, std::set{named}));
  }
}

/// Pictures that are missing keep their names, which have a dot in the folder's.
TEST_F(FbxLooks, NamesAndSetsThatAreOddStayWhole) {
  (void)folder_.write("a.png", png + "a");
  (void)folder_.write("b.png", png + "b");
  FbxItem box = box_of_materials(2);
  box = with_map("painted", std::move(box));
  const FbxItems beside{material(0, {}), material(1, {}), texture(30, "a.png"),
                        texture(31, "b.png")};
  Glb glb = glb_of(dressed(written(scene(box, encodings::fbx_model(2), beside,
                                         {link(30, first_material, "DiffuseColor"),
                                          link(31, first_material + 1, "DiffuseColor")})))
                       .bytes);
  glb.json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64_of(glb.numbers);
  ASSERT_EQ(glb.json["images"].size(), 2U);
  glb.json["images"][0] = {{"uri", "pictures.v2/skin"}};
  glb.json["images"][1] = {{"uri", "pictures.v2/SKIN"}};
  for (const double set : {7.0, 1e300}) {  // there is but one
    glb.json["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
        {"KHR_texture_transform", {{"texCoord", set}}}};
    const fs::path file = folder_.write("odd.gltf", glb.json.dump());
    const FileBytes made{"odd.fbx", dressed(file, RigFormat::fbx).bytes};
    const FbxRecord root = parse_fbx(made);
    EXPECT_EQ(texts_in(root, made, "Video", "RelativeFilename"),
              (std::vector<std::string>{"pictures.v2/skin", "pictures.v2/SKIN 2"}));
    EXPECT_EQ(texts_in(root, made, "Texture", "UVSet"),
              (std::vector<std::string>{"painted", "UVMap"}));
  }
}

}  // namespace
}  // namespace curveskel::fbx_looks_laws
