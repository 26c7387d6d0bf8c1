// Laws of rigs for FBX files: texture coordinates and colours are there in glTF, however the file
// gives them.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_materials.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include "tests/glb.hpp"
#include "tests/rig/fbx_mappings.hpp"
#include "tests/rig/fbx_subjects.hpp"
#include "tests/surface/scene_encodings.hpp"

namespace curveskel::dress_fbx_maps_laws {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using namespace fbx_mappings;

class DressFbxMaps : public FbxDressing {};

TEST_F(DressFbxMaps, TextureCoordinatesAreTheFilesHoweverTheyAreGiven) {
  for (const FbxForm form : all_forms) {
    for (const Mapping& mapping : mappings) {
      for (const int kind : {0, 1, 2}) {
        SCOPED_TRACE(mapping.name + " " + std::to_string(kind));
        const Textures textures{mapping, kind == 1};
        const double side = kind == 2 ? -1 : 1;  // mirrored: corners are in the other order
        FbxItem box = encodings::fbx_box();
        box.children.push_back(textures.layer());
        const fs::path file =
            written(scene(box, encodings::fbx_model(2, {{"Lcl Scaling", {side, 1.0, 1.0}}}),
                          {material(0, {})}),
                    form);
        const auto look = read_materials(file);
        ASSERT_TRUE(look);
        ASSERT_EQ(look->triangles.rows(), 12);
        for (Eigen::Index t = 0; t < 12; ++t) {
          const int face = face_of(*look, t);
          ASSERT_GE(face, 0);
          for (const int drawn : look->triangles.row(t)) {
            int corner = 0;
            while (int(vertex_at(face, corner)) != look->vertices[idx(drawn)]) ++corner;
            const auto row = static_cast<float>(textures.row(face, corner));
            EXPECT_NEAR(look->places_in_picture(drawn, 0), 0.01F * row, 1e-6F);
            EXPECT_NEAR(look->places_in_picture(drawn, 1), 1 - 0.02F * row, 1e-6F);
          }
        }
      }
    }
  }
}

FbxItem colours(const Mapping& mapping) {
  std::vector<double> values;
  for (int row = 0; row < mapping.rows; ++row) {
    values.insert(values.end(), {0.01 * row, 0.5, 1, 0.02 * row});
  }
  return {"LayerElementColor",
          {0},
          {{"MappingInformationType", {mapping.name}},
           {"ReferenceInformationType", {"Direct"}},
           {"Colors", {values}}}};
}

/// The opacity tells the rows of the first set; the second has one row for all.
TEST_F(DressFbxMaps, ColoursAreTheFilesHoweverTheyAreGiven) {
  for (const FbxForm form : all_forms) {
    for (const Mapping& mapping : mappings) {
      SCOPED_TRACE(mapping.name);
      FbxItem box = encodings::fbx_box();
      box.children.push_back(colours(mapping));
      box.children.push_back(colours(mappings[3]));
      const fs::path file = written(scene(box, encodings::fbx_model(2), {material(0, {})}), form);
      const auto look = read_materials(file);
      ASSERT_TRUE(look);
      for (Eigen::Index t = 0; t < 12; ++t) {
        const int face = face_of(*look, t);
        for (const int drawn : look->triangles.row(t)) {
          int corner = 0;
          while (int(vertex_at(face, corner)) != look->vertices[idx(drawn)]) ++corner;
          const double row = mapping.place(face, corner);
          EXPECT_NEAR(look->colours(drawn, 1), 0.21404, 1e-5);  // of .5, IEC 61966-2-1
          EXPECT_EQ(look->colours(drawn, 2), 1);
          EXPECT_NEAR(look->colours(drawn, 3), 0.02 * row, 1e-6);
        }
      }
      const Glb glb = glb_of(dressed(file).bytes);
      const auto second =
          glb.values<float>(glb.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_1"]);
      ASSERT_FALSE(second.empty());
      for (std::size_t k = 3; k < second.size(); k += 4) EXPECT_EQ(second[k], 0);
    }
  }
}

/// Colours beside pictures are masks, mostly: they must not darken what is drawn. Written as FBX,
/// they come first again.
TEST_F(DressFbxMaps, ColoursAreNoFactorsOnPictures) {
  (void)folder_.write("skin.png", png);
  FbxItem box = encodings::fbx_box();
  box.children.push_back(colours(mappings[1]));
  const FbxItems beside{
      material(0, {}),
      {"Texture", {std::int64_t{30}, "Texture::t", ""}, {{"RelativeFilename", {"skin.png"}}}}};
  const std::vector<FbxItem> links{
      {"C", {"OP", std::int64_t{30}, first_material, std::string("DiffuseColor")}}};
  fs::path file = written(scene(box, encodings::fbx_model(2), beside, links), FbxForm::binary);
  for (int round = 0; round < 2; ++round) {
    const Glb glb = glb_of(dressed(file).bytes);
    const Json& attributes = glb.json["meshes"][0]["primitives"][0]["attributes"];
    EXPECT_FALSE(attributes.contains("COLOR_2"));
    for (const float number : glb.values<float>(attributes["COLOR_0"])) EXPECT_EQ(number, 1);
    const auto own = glb.values<float>(attributes["COLOR_1"]);
    for (std::size_t k = 3; k < 32; k += 4) EXPECT_NEAR(own[k], 0.005 * double(k - 3), 1e-6);
    file = folder_.write("again.fbx", dressed(file, RigFormat::fbx).bytes);
  }
}

TEST_F(DressFbxMaps, AllSetsOfTextureCoordinatesAreKeptAndEachPictureHasItsOwn) {
  (void)folder_.write("skin.png", png);
  for (const auto& [name, wanted] : {std::pair<std::string, int>{"second", 1}, {"none", 0}}) {
    FbxItem box = encodings::fbx_box();
    for (const std::size_t set : {0U, 1U}) {
      FbxItem layer = Textures{mappings[set], false}.layer();
      layer.children.push_back({"Name", {std::string(set == 0 ? "first" : "second")}});
      box.children.push_back(layer);
    }
    const FbxItem texture{"Texture",
                          {std::int64_t{30}, "Texture::t", ""},
                          {{"RelativeFilename", {"skin.png"}}, properties({{"UVSet", {name}}})}};
    const std::vector<FbxItem> links{
        {"C", {"OP", std::int64_t{30}, first_material, "DiffuseColor"}}};
    const FbxItems records = scene(box, encodings::fbx_model(2), {material(0, {}), texture}, links);
    const Glb glb = glb_of(dressed(written(records, FbxForm::binary)).bytes);
    const Json& look = glb.json["materials"][0]["pbrMetallicRoughness"];
    EXPECT_EQ(look["baseColorTexture"].value("texCoord", 0), wanted);
    const Json& attributes = glb.json["meshes"][0]["primitives"][0]["attributes"];
    const auto largest = [&](const char* set) {
      const auto numbers = glb.values<float>(attributes[set]);
      float most = 0;
      for (std::size_t k = 0; k < numbers.size(); k += 2) most = std::max(most, numbers[k]);
      return most;
    };
    EXPECT_NEAR(largest("TEXCOORD_0"), 0.23, 1e-6);  // of 24 corners,
    EXPECT_NEAR(largest("TEXCOORD_1"), 0.07, 1e-6);  // and of 8 vertices
  }
}

}  // namespace
}  // namespace curveskel::dress_fbx_maps_laws
