// Laws of rigs for COLLADA files: faces have the materials of the file, and these their look.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <curveskel/read_materials.hpp>
#include <curveskel/rig_files.hpp>
#include "tests/glb.hpp"
#include "tests/rig/dae_subjects.hpp"

namespace curveskel::dae_materials_laws {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using namespace dae_subjects;

class DaeBindings : public DaeDressing {};

/// The box with one material, and what is said of it.
struct Looked {
  Json json;
  std::vector<std::string> notes;
};

/// Its first three faces have what their instance binds, the others are bound by id; the last are
/// of a material that is not there.
TEST_F(DaeBindings, FacesHaveTheMaterialToWhichTheyAreBound) {
  const auto part = [](int first, int end, const std::string& symbol) {
    std::string indices;
    for (int face = first; face < end; ++face) indices += indices_of(face, {0, 1, 2, 3});
    std::string counts;
    for (int face = first; face < end; ++face) counts += "4 ";
    return "<polylist material=\"" + symbol + "\" " + plain + "<vcount>" + counts + "</vcount><p>" +
           indices + "</p></polylist>";
  };
  Dae file;
  file.polygons = part(0, 3, "m") + part(3, 5, "blue-id") + part(5, 6, "nothing");
  file.binding = bound("m", "red-id");
  file.libraries = material("red", "<lambert><diffuse><color>1 0 0 1</color></diffuse></lambert>") +
                   material("blue", "<phong><diffuse><color>0 0 1 1</color></diffuse></phong>");
  const fs::path path = written(file);
  const auto look = read_materials(path);
  ASSERT_TRUE(look);
  ASSERT_EQ(look->materials.size(), 2U);
  EXPECT_EQ(look->materials[0].colour, (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_EQ(look->materials[1].colour, (std::array<float, 4>{0, 0, 1, 1}));
  std::array<int, 3> counts{};
  for (const int one : look->material) ++counts.at(idx(one + 1));
  EXPECT_EQ(counts, (std::array<int, 3>{2, 6, 4}));  // triangles without, red, blue
}

class DaeMaterials : public DaeDressing {
 protected:
  [[nodiscard]] Looked looked(const std::string& libraries, const std::string& inputs = {}) const {
    Dae file;
    file.sources = Dae::source("first", 2, rows_of(24, 2));
    file.polygons = polygons_of("polylist", "material=\"m\" >" + input("VERTEX", "corners", 0, 0) +
                                                input("TEXCOORD", "first", 1, 3) +
                                                input("TEXCOORD", "first", 1, 5));
    file.binding = bound("m", "skin-id", inputs);
    file.libraries = libraries;
    const EditedFile edited = dressed(written(file));
    return {glb_of(edited.bytes).json, edited.notes};
  }
};

TEST_F(DaeMaterials, NumbersAreTheEffects) {
  const Looked found =
      looked(material("skin",
                      "<phong><emission><color>0 .5 0 1</color></emission><diffuse><param "
                      "ref=\"tint\"/></diffuse><shininess><float>25</float></shininess></phong>",
                      "<newparam sid=\"tint\"><float3>.25 .5 .75</float3></newparam>",
                      "<extra><technique profile=\"GOOGLEEARTH\"><double_sided>1</double_sided>"
                      "</technique></extra>"));
  const Json& made = found.json["materials"][0];
  EXPECT_EQ(made["name"], "skin");
  EXPECT_EQ(made["pbrMetallicRoughness"]["baseColorFactor"], Json({0.25, 0.5, 0.75, 1.0}));
  EXPECT_EQ(made["pbrMetallicRoughness"]["roughnessFactor"], 0.5);
  EXPECT_EQ(made["pbrMetallicRoughness"]["metallicFactor"], 0);
  EXPECT_EQ(made["emissiveFactor"], Json({0, 0.5, 0}));
  EXPECT_EQ(made["doubleSided"], true);
  EXPECT_TRUE(found.notes.empty());
}

TEST_F(DaeMaterials, AConstantOneIsSeenByItsOwnLight) {
  const Looked found =
      looked(material("skin", "<constant><emission><color>1 .5 0 1</color></emission></constant>"));
  const Json& made = found.json["materials"][0];
  EXPECT_EQ(made["pbrMetallicRoughness"]["baseColorFactor"], Json({0, 0, 0, 1}));
  EXPECT_EQ(made["emissiveFactor"], Json({1, 0.5, 0}));
}

TEST_F(DaeMaterials, OpacityIsCountedAsTheFileSays) {
  struct Case {
    std::string said;
    double opacity;
  };
  const auto both = [](const std::string& mode, const std::string& colour, double share) {
    return "<transparent opaque=\"" + mode + "\"><color>" + colour +
           "</color></transparent><transparency><float>" + encodings::fbx_number(share) +
           "</float></transparency>";
  };
  const std::vector<Case> cases{
      {"", 1},
      {"<transparency><float>.25</float></transparency>", 0.25},
      {both("A_ONE", "1 1 1 .5", 0.5), 0.25},
      {both("A_ZERO", "1 1 1 .5", 0.5), 0.75},
      {both("RGB_ONE", ".5 .5 .5 1", 0.5), 0.25},
      {both("RGB_ZERO", ".5 .5 .5 1", 0.5), 0.75},
      {both("A_ONE", "1 1 1 1", 0), 1},  // nobody means a thing that is not there
      {both("RGB_ZERO", "1 1 1 1", 1), 1},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.said);
    const Looked found = looked(material("skin", "<lambert>" + one.said + "</lambert>"));
    const Json& made = found.json["materials"][0];
    EXPECT_EQ(made["pbrMetallicRoughness"]["baseColorFactor"][3], one.opacity);
    EXPECT_EQ(made.contains("alphaMode"), one.opacity < 1);
  }
}

std::string image(const std::string& inside) {
  return "<library_images><image id=\"img\">" + inside + "</image></library_images>";
}

const std::string sampler =
    "<newparam sid=\"surface\"><surface type=\"2D\"><init_from>img</init_from></surface></newparam>"
    "<newparam sid=\"sampler\"><sampler2D><source> surface </source></sampler2D></newparam>";

std::string textured(const std::string& texture) {
  return "<lambert><diffuse><texture texture=\"" + texture +
         "\" texcoord=\"UV\"/></diffuse></lambert>";
}

TEST_F(DaeMaterials, PicturesAreFoundHoweverTheyAreNamed) {
  (void)folder_.write("my skin.png", png);
  fs::create_directories(folder_.path() / "textures");
  (void)folder_.write("textures/deep.png", png);
  const std::string instanced =
      "<newparam sid=\"sampler\"><sampler2D><instance_image url=\"#img\"/></sampler2D></newparam>";
  struct Case {
    std::string name;
    std::string inside;
    std::string parameters;
    std::string texture;
  };
  const std::vector<Case> cases{
      {"sampler", "<init_from>my%20skin.png</init_from>", sampler, "sampler"},
      {"by its id", "<init_from>my skin.png</init_from>", "", "img"},
      {"1.5", "<init_from><ref>./my%20skin.png</ref></init_from>", instanced, "sampler"},
      {"elsewhere", "<init_from>file:///C:/Users/somebody/my%20skin.png</init_from>", sampler,
       "sampler"},
      {"backslashes", "<init_from>..\\art\\my skin.png</init_from>", sampler, "sampler"},
      {"textures", "<init_from>/home/somebody/deep.png</init_from>", sampler, "sampler"},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    const Looked found =
        looked(material("skin", textured(one.texture), one.parameters) + image(one.inside));
    EXPECT_TRUE(found.notes.empty());
    ASSERT_EQ(found.json["images"].size(), 1U);
    EXPECT_EQ(found.json["images"][0]["mimeType"], "image/png");
    const Json& look = found.json["materials"][0]["pbrMetallicRoughness"];
    EXPECT_EQ(look["baseColorTexture"]["index"], 0);
    EXPECT_FALSE(look["baseColorTexture"].contains("texCoord"));
  }
  const Looked missing = looked(material("skin", textured("sampler"), sampler) +
                                image("<init_from>lost.png</init_from>"));
  ASSERT_EQ(missing.notes.size(), 1U);
  EXPECT_NE(missing.notes[0].find("lost.png"), std::string::npos);
}

TEST_F(DaeMaterials, APictureHasTheSetToWhichItIsBound) {
  (void)folder_.write("skin.png", png);
  const std::string libraries =
      material("skin", textured("sampler"), sampler) + image("<init_from>skin.png</init_from>");
  const auto set = [&](const std::string& inputs) {
    const Looked found = looked(libraries, inputs);
    const Json& look = found.json["materials"][0]["pbrMetallicRoughness"];
    return look["baseColorTexture"].value("texCoord", 0);
  };
  const auto bind = [](const std::string& semantic, int number) {
    return "<bind_vertex_input semantic=\"" + semantic + "\" input_semantic=\"TEXCOORD\" " +
           "input_set=\"" + std::to_string(number) + "\"/>";
  };
  EXPECT_EQ(set(bind("UV", 3)), 0);
  EXPECT_EQ(set(bind("UV", 5)), 1);
  EXPECT_EQ(set(bind("other", 5)), 0);
  EXPECT_EQ(set(bind("UV", 4)), 0);  // there is no such set
}

TEST_F(DaeMaterials, MapsOfNormalsAreKeptAndThoseOfBumpsSaidToBeLeftOut) {
  (void)folder_.write("n.png", png);
  const auto bumped = [&](const std::string& type) {
    return looked(material("skin", "<lambert/><extra><technique profile=\"FCOLLADA\"><bump " +
                                       type +
                                       "><texture texture=\"img\"/></bump></technique></extra>") +
                  image("<init_from>n.png</init_from>"));
  };
  const Looked normals = bumped("bumptype=\"NORMALMAP\"");
  EXPECT_TRUE(normals.notes.empty());
  EXPECT_EQ(normals.json["materials"][0]["normalTexture"]["index"], 0);
  const Looked heights = bumped("");
  EXPECT_FALSE(heights.json["materials"][0].contains("normalTexture"));
  ASSERT_EQ(heights.notes.size(), 1U);
  EXPECT_NE(heights.notes[0].find("bump"), std::string::npos);
}

/// As Blender writes instances of a mesh that have other materials than the first.
TEST_F(DaeBindings, BindingsOfSymbolsThatAreNotThereCountInTheirOrder) {
  const auto bindings = [](const std::vector<std::string>& symbols) {
    std::string text = "<bind_material><technique_common>";
    for (std::size_t k = 0; k < symbols.size(); ++k) {
      text += "<instance_material symbol=\"" + symbols[k] + "\" target=\"#" +
              (k == 0 ? "wool-id" : "silk-id") + "\"/>";
    }
    return text + "</technique_common></bind_material>";
  };
  const auto names = [&](const std::vector<std::string>& symbols) {
    Dae file;
    for (const char* name : {"a", "b", "wool", "silk"}) {
      file.libraries += material(name, "<lambert/>");
    }
    for (const int half : {0, 1}) {
      std::string indices;
      for (int face = 3 * half; face < 3 * half + 3; ++face) {
        indices += indices_of(face, {0, 1, 2, 3});
      }
      file.polygons += "<polylist material=\"";
      file.polygons += half == 0 ? "a-id\"" : "b-id\"";
      file.polygons += plain;
      file.polygons += "<vcount>4 4 4</vcount><p>";
      file.polygons += indices;
      file.polygons += "</p></polylist>";
    }
    file.binding = bindings(symbols);
    const Glb glb = glb_of(dressed(written(file)).bytes);
    std::vector<std::string> found;
    for (const Json& primitive : glb.json["meshes"][0]["primitives"]) {
      found.push_back(glb.json["materials"][primitive["material"].get<std::size_t>()]["name"]);
    }
    return found;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names({"other", "another"}), (Names{"wool", "silk"}));
  EXPECT_EQ(names({"b-id", "a-id"}), (Names{"silk", "wool"}));
  EXPECT_EQ(names({"other", "b-id"}), (Names{"a", "silk"}));
  EXPECT_EQ(names({"other"}), (Names{"a", "b"}));
}

}  // namespace
}  // namespace curveskel::dae_materials_laws
