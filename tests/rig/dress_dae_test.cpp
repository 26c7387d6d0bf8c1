// Laws of rigs for COLLADA files: the look of the file is there in glTF, however the file gives it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_materials.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include "tests/glb.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/random_rigs.hpp"
#include "tests/surface/scene_encodings.hpp"

namespace curveskel::dress_dae_laws {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string png("\x89PNG\r\n\x1a\n no true picture", 24);
constexpr int faces = 6;

/// The parts of a file of which tests change some.
struct Dae {
  std::string sources;        ///< of the mesh, beside those of places
  std::string vertex_inputs;  ///< beside that of places
  std::string polygons;
  std::string binding;  ///< within the instance
  std::string node;     ///< beside the instance
  std::string libraries;
  std::string asset = "<unit meter=\"1\"/><up_axis>Y_UP</up_axis>";
  std::string instance = "instance_geometry url=\"#box\"";

  [[nodiscard]] std::string text() const {
    std::string points;
    for (const auto& p : encodings::corners) points += encodings::spaced(p) + " ";
    return "<COLLADA version=\"1.4.1\"><asset>" + asset +
           "</asset><library_geometries><geometry id=\"box\"><mesh>" + source("points", 3, points) +
           sources + "<vertices id=\"corners\"><input semantic=\"POSITION\" source=\"#points\"/>" +
           vertex_inputs + "</vertices>" + polygons + "</mesh></geometry></library_geometries>" +
           libraries + "<library_visual_scenes><visual_scene id=\"scene\"><node>" + node + "<" +
           instance + ">" + binding + "</" + instance.substr(0, instance.find(' ')) +
           "></node></visual_scene></library_visual_scenes><scene><instance_visual_scene "
           "url=\"#scene\"/></scene></COLLADA>";
  }

  static std::string source(const std::string& id, int width, const std::string& numbers) {
    const auto count = std::count(numbers.begin(), numbers.end(), ' ') / width;
    return "<source id=\"" + id + "\"><float_array id=\"" + id + "-a\">" + numbers +
           "</float_array><technique_common><accessor source=\"#" + id + "-a\" count=\"" +
           std::to_string(count) + "\" stride=\"" + std::to_string(width) +
           "\"/></technique_common></source>";
  }
};

std::string input(const std::string& semantic, const std::string& source, int offset, int set) {
  return "<input semantic=\"" + semantic + "\" source=\"#" + source + "\" offset=\"" +
         std::to_string(offset) + "\" set=\"" + std::to_string(set) + "\"/>";
}

/// The corners of a face, as pairs of a vertex and a row: row 4 face + corner.
std::string indices_of(int face, const std::vector<int>& order) {
  std::string text;
  for (const int corner : order) {
    text += std::to_string(encodings::quads[idx(face)][idx(corner)]) + " " +
            std::to_string(4 * face + corner) + " ";
  }
  return text;
}

/// The box in each way in which COLLADA gives polygons; `given` is the material and the inputs of
/// two indices a corner.
std::string polygons_of(const std::string& kind, const std::string& given) {
  std::string all;
  std::string runs;
  for (int face = 0; face < faces; ++face) {
    const bool is_strip = kind == "tristrips";
    const std::string corners =
        kind == "triangles"
            ? indices_of(face, {0, 1, 2, 0, 2, 3})
            : indices_of(face, is_strip ? std::vector{0, 1, 3, 2} : std::vector{0, 1, 2, 3});
    all += corners;
    runs += "<p>" + corners + "</p>";
  }
  const bool is_one = kind == "triangles" || kind == "polylist";
  return "<" + kind + " " + given + (kind == "polylist" ? "<vcount>4 4 4 4 4 4</vcount>" : "") +
         (is_one ? "<p>" + all + "</p>" : runs) + "</" + kind + ">";
}

constexpr std::array kinds{"polylist", "polygons", "triangles", "tristrips", "trifans"};

/// Row r is (.01 r, .02 r, ...).
std::string rows_of(int rows, int width) {
  std::string text;
  for (int row = 0; row < rows; ++row) {
    for (int k = 1; k <= width; ++k) text += encodings::fbx_number(0.01 * k * row) + " ";
  }
  return text;
}

class DressDae : public testing::Test {
 protected:
  [[nodiscard]] fs::path written(const Dae& file) const {
    return folder_.write("a thing.dae", file.text());
  }

  [[nodiscard]] EditedFile dressed(const fs::path& file) const {
    const Eigen::Index rows = read_polygons(file).positions.rows();
    const auto edited = format_rig_into(file, random_rig(rows, 5, "bone "),
                                        {RigFormat::glb, OldRig::replaced, "rig", "a test"});
    EXPECT_TRUE(edited);
    return edited.value_or(EditedFile{});
  }

  OwnFolder folder_;
};

/// Of vertex `at` of the file, rows of an attribute.
std::vector<std::vector<float>> rows_at(const Glb& glb, const std::string& attribute, int width,
                                        const Eigen::RowVector3d& at) {
  const Json& attributes = glb.json["meshes"][0]["primitives"][0]["attributes"];
  const auto places = glb.values<float>(attributes["POSITION"]);
  const auto values = glb.values<float>(attributes[attribute]);
  std::vector<std::vector<float>> rows;
  for (std::size_t v = 0; 3 * v < places.size(); ++v) {
    const Eigen::RowVector3f place = Eigen::Map<const Eigen::RowVector3f>(&places[3 * v]);
    if ((place - at.cast<float>()).norm() > 1e-6F) continue;
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(idx(width) * v);
    rows.emplace_back(first, first + width);
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// Each vertex is a corner of three faces.
std::vector<std::vector<float>> wanted_rows(int vertex, int width, float (*made)(int row, int k)) {
  std::vector<std::vector<float>> rows;
  for (int face = 0; face < faces; ++face) {
    for (int corner = 0; corner < 4; ++corner) {
      if (int(encodings::quads[idx(face)][idx(corner)]) != vertex) continue;
      std::vector<float>& row = rows.emplace_back(idx(width));
      for (int k = 0; k < width; ++k) row[idx(k)] = made(4 * face + corner, k);
    }
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// IEC 61966-2-1.
float linear(double srgb) {
  return float(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
}

void expect_near(const std::vector<std::vector<float>>& found,
                 const std::vector<std::vector<float>>& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t row = 0; row < found.size(); ++row) {
    for (std::size_t k = 0; k < found[row].size(); ++k) {
      EXPECT_NEAR(found[row][k], wanted[row][k], 1e-6F);
    }
  }
}

TEST_F(DressDae, CornersHaveTheirRowsHoweverPolygonsAreGiven) {
  for (const char* kind : kinds) {
    for (const bool mirrored : {false, true}) {
      SCOPED_TRACE(std::string(kind) + (mirrored ? " mirrored" : ""));
      Dae file;
      file.sources =
          Dae::source("first", 2, rows_of(24, 2)) + Dae::source("second", 3, rows_of(24, 3)) +
          Dae::source("shades", 3, rows_of(24, 3)) + Dae::source("tints", 4, rows_of(24, 4));
      // Sets are in the order of their numbers, not of the file.
      file.polygons = polygons_of(
          kind, ">" + input("TEXCOORD", "second", 1, 7) + input("VERTEX", "corners", 0, 0) +
                    input("TEXCOORD", "first", 1, 2) + input("COLOR", "tints", 1, 1) +
                    input("COLOR", "shades", 1, 0));
      if (mirrored) file.node = "<scale>-1 1 1</scale>";
      const fs::path path = written(file);
      const PolygonSoup soup = read_polygons(path);
      const Glb glb = glb_of(dressed(path).bytes);
      for (int v = 0; v < 8; ++v) {
        const auto found = [&](const std::string& name, int width) {
          return rows_at(glb, name, width, soup.positions.row(v));
        };
        for (const char* name : {"TEXCOORD_0", "TEXCOORD_1"}) {
          expect_near(found(name, 2), wanted_rows(v, 2, [](int row, int k) {
                        return k == 0 ? 0.01F * float(row) : 1 - 0.02F * float(row);
                      }));
        }
        expect_near(found("COLOR_0", 4), wanted_rows(v, 4, [](int row, int k) {
                      const double srgb = 0.01 * (k + 1) * row;
                      return k == 3 ? 1 : linear(srgb);
                    }));
        EXPECT_EQ(found("COLOR_1", 4).size(), 3U);
      }
    }
  }
}

TEST_F(DressDae, InputsOfVerticesAreThoseOfTheirCorners) {
  Dae file;
  file.sources = Dae::source("first", 2, rows_of(8, 2)) + Dae::source("up", 3, rows_of(8, 3));
  file.vertex_inputs =
      "<input semantic=\"TEXCOORD\" source=\"#first\"/><input semantic=\"NORMAL\" source=\"#up\"/>";
  file.polygons = polygons_of(
      "polylist", ">" + input("VERTEX", "corners", 0, 0) + input("UNKNOWN", "first", 1, 0));
  const fs::path path = written(file);
  const PolygonSoup soup = read_polygons(path);
  const Glb glb = glb_of(dressed(path).bytes);
  for (int v = 0; v < 8; ++v) {
    expect_near(rows_at(glb, "TEXCOORD_0", 2, soup.positions.row(v)),
                {{0.01F * float(v), 1 - 0.02F * float(v)}});
    if (v == 0) continue;  // its normal has no direction
    const float unit = 1 / std::sqrt(14.0F);
    expect_near(rows_at(glb, "NORMAL", 3, soup.positions.row(v)), {{unit, 2 * unit, 3 * unit}});
  }
}

/// Of a box whose corners have the normals of their faces, turned, stretched and mirrored.
TEST_F(DressDae, NormalsStayNormal) {
  std::string normals;
  for (int face = 0; face < faces; ++face) {
    const auto at = [&](int corner) {
      const auto& p = encodings::corners[idx(int(encodings::quads[idx(face)][idx(corner)]))];
      return Eigen::Vector3d(p[0], p[1], p[2]);
    };
    const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    for (int corner = 0; corner < 4; ++corner) {
      for (const double number : normal) normals += encodings::fbx_number(number) + " ";
    }
  }
  for (const char* scale : {"1 2 5", "-1 2 5"}) {
    Dae file;
    file.node = "<rotate>1 2 3 40</rotate><scale>" + std::string(scale) + "</scale>";
    file.sources = Dae::source("normals", 3, normals);
    file.polygons = polygons_of(
        "polylist", ">" + input("VERTEX", "corners", 0, 0) + input("NORMAL", "normals", 1, 0));
    const fs::path path = written(file);
    const PolygonSoup soup = read_polygons(path);
    const Glb glb = glb_of(dressed(path).bytes);
    for (std::size_t f = 0; f < idx(faces); ++f) {
      const auto at = [&](std::size_t k) -> Eigen::RowVector3d {
        return soup.positions.row(soup.corners[4 * f + k]);
      };
      const Eigen::RowVector3f wanted =
          (at(1) - at(0)).cross(at(2) - at(0)).normalized().cast<float>();
      for (std::size_t k = 0; k < 4; ++k) {
        const auto found = rows_at(glb, "NORMAL", 3, at(k));
        EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const std::vector<float>& row) {
          return (Eigen::RowVector3f(row[0], row[1], row[2]) - wanted).norm() < 1e-5F;
        }));
      }
    }
  }
}

/// A material called `name` whose technique is `shader`.
std::string material(const std::string& name, const std::string& shader,
                     const std::string& parameters = {}, const std::string& extra = {}) {
  return "<library_effects><effect id=\"" + name + "-fx\"><profile_COMMON>" + parameters +
         "<technique sid=\"common\">" + shader + "</technique></profile_COMMON>" + extra +
         "</effect></library_effects><library_materials><material id=\"" + name + "-id\" name=\"" +
         name + "\"><instance_effect url=\"#" + name + "-fx\"/></material></library_materials>";
}

std::string bound(const std::string& symbol, const std::string& target,
                  const std::string& inputs = {}) {
  return "<bind_material><technique_common><instance_material symbol=\"" + symbol +
         "\" target=\"#" + target + "\">" + inputs +
         "</instance_material></technique_common></bind_material>";
}

const std::string plain = ">" + input("VERTEX", "corners", 0, 0) + input("UNKNOWN", "points", 1, 0);

/// The box with one material, and what is said of it.
struct Looked {
  Json json;
  std::vector<std::string> notes;
};

/// Its first three faces have what their instance binds, the others are bound by id; the last are
/// of a material that is not there.
TEST_F(DressDae, FacesHaveTheMaterialToWhichTheyAreBound) {
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

class DaeMaterials : public DressDae {
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

TEST_F(DressDae, MorphsBecomeMorphTargets) {
  for (const bool relative : {false, true}) {
    std::string numbers;
    for (std::size_t v = 0; v < 8; ++v) {
      const auto& p = encodings::corners[v];
      const Eigen::Vector3d base =
          relative ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(p[0], p[1], p[2]);
      const Eigen::Vector3d move = v == 3 ? Eigen::Vector3d(0.5, 0, 0) : Eigen::Vector3d(0, 0, 0);
      for (const double number : Eigen::Vector3d(base + move)) {
        numbers += encodings::fbx_number(number) + " ";
      }
    }
    Dae file;
    file.polygons = polygons_of("polylist", plain);
    file.node = "<rotate>0 0 1 90</rotate>";
    file.instance = "instance_controller url=\"#morph\"";
    file.libraries =
        "<library_geometries><geometry id=\"smile-mesh\" name=\"smile\"><mesh>" +
        Dae::source("smile-points", 3, numbers) +
        "<vertices id=\"smile-corners\"><input semantic=\"POSITION\" source=\"#smile-points\"/>"
        "</vertices></mesh></geometry></library_geometries><library_controllers><controller "
        "id=\"morph\"><morph source=\"#box\" method=\"" +
        std::string(relative ? "RELATIVE" : "NORMALIZED") +
        "\"><source id=\"targets\"><IDREF_array count=\"1\">smile-mesh</IDREF_array></source>"
        "<source id=\"weights\"><float_array>0</float_array></source><targets><input "
        "semantic=\"MORPH_TARGET\" source=\"#targets\"/><input semantic=\"MORPH_WEIGHT\" "
        "source=\"#weights\"/></targets></morph></controller></library_controllers>";
    const Glb glb = glb_of(dressed(written(file)).bytes);
    const Json& mesh = glb.json["meshes"][0];
    EXPECT_EQ(mesh["extras"]["targetNames"], Json({"smile"}));
    const Json& target = mesh["primitives"][0]["targets"][0];
    const Json& sparse = glb.json["accessors"][target["POSITION"].get<std::size_t>()]["sparse"];
    EXPECT_EQ(glb.of_view<std::uint32_t>(sparse["indices"]["bufferView"]),
              std::vector<std::uint32_t>{3});
    const auto moved = glb.of_view<float>(sparse["values"]["bufferView"]);
    EXPECT_LT(
        (Eigen::Map<const Eigen::Vector3f>(moved.data()) - Eigen::Vector3f(0, 0.5F, 0)).norm(),
        1e-6F);
  }
}

/// In glTF the thing stands upright, in metres; its stored vertices stay as they are.
TEST_F(DressDae, TheSceneIsInMetresWithYUp) {
  struct Frame {
    std::string asset;
    double scale;
    std::array<double, 9> axes;
  };
  const std::vector<Frame> frames{
      {"<unit meter=\"0.01\"/><up_axis>Y_UP</up_axis>", 0.01, {1, 0, 0, 0, 1, 0, 0, 0, 1}},
      {"<unit meter=\"1\"/><up_axis>\n Z_UP </up_axis>", 1, {1, 0, 0, 0, 0, 1, 0, -1, 0}},
      {"<up_axis>X_UP</up_axis>", 1, {0, -1, 0, 1, 0, 0, 0, 0, 1}},
      {"<unit meter=\"nothing\"/><up_axis>Z_UP</up_axis>", 1, {1, 0, 0, 0, 0, 1, 0, -1, 0}},
  };
  const Rig rig = random_rig(8, 5, "bone ");
  for (const Frame& frame : frames) {
    SCOPED_TRACE(frame.asset);
    Dae file;
    file.polygons = polygons_of("polylist", plain);  // there is nothing else to keep
    file.asset = frame.asset;
    const fs::path path = written(file);
    const PolygonSoup given = read_polygons(path);
    const auto edited =
        format_rig_into(path, rig, {RigFormat::glb, OldRig::replaced, "rig", "a test"});
    ASSERT_TRUE(edited);
    Rig stated = rig;  // as `rig_polygons` makes it of the soup
    stated.to_y_up = given.to_gltf;
    EXPECT_EQ(
        format_rig_into(path, stated, {RigFormat::glb, OldRig::replaced, "rig", "a test"})->bytes,
        edited->bytes);
    const fs::path made = folder_.write("made.glb", edited->bytes);
    const Eigen::Matrix3d axes =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(frame.axes.data());
    const auto in_scene = [&](const Positions& places) -> Positions {
      return frame.scale * places * axes.transpose();
    };
    EXPECT_LT((given.to_gltf - frame.scale * axes).norm(), 1e-15);
    EXPECT_LT((read_polygons(made).positions - in_scene(given.positions)).norm(),
              1e-5 * frame.scale);
    EXPECT_LT((read_rig(made, {})->joints - in_scene(rig.joints)).norm(), 1e-5 * frame.scale);
  }
}

TEST_F(DressDae, NothingWhereThereIsNothingToKeep) {
  Dae file;
  file.polygons = polygons_of("polylist", plain);
  EXPECT_FALSE(format_rig_into(written(file), random_rig(8, 3, "bone ")));
}

TEST_F(DressDae, RowsThatAreNotThereAreNone) {
  Dae file;
  file.sources = Dae::source("few", 2, rows_of(2, 2));
  file.polygons =
      polygons_of("polylist", ">" + input("VERTEX", "corners", 0, 0) +
                                  input("TEXCOORD", "few", 1, 0) + input("NORMAL", "few", 1, 0));
  EXPECT_EQ(read_polygons(written(file)).offsets.size(), 7U);
  const Glb glb = glb_of(dressed(written(file)).bytes);
  const Json& attributes = glb.json["meshes"][0]["primitives"][0]["attributes"];
  for (const float number : glb.values<float>(attributes["TEXCOORD_0"])) {
    EXPECT_TRUE(number == 0 || number == 1 || number == 0.01F || number == 1 - 0.02F);
  }
}

/// The joint below a node that is none hangs from the joint above it.
TEST_F(DressDae, ItsJointsCanBeGiven) {
  Dae file;
  file.polygons = polygons_of("polylist", plain);
  file.node =
      "<translate>1 0 0</translate><node type=\"JOINT\" name=\"hips\" id=\"a\"><translate>0 2 0"
      "</translate><node><rotate>0 0 1 90</rotate><node type=\"JOINT\" id=\"neck\"><translate>3 0 0"
      "</translate></node></node></node>";
  const Rig rig = read_joints(written(file), {});
  EXPECT_EQ(rig.names, (std::vector<std::string>{"hips", "neck"}));
  EXPECT_EQ(rig.parents, Eigen::Vector2i(-1, 0));
  EXPECT_LT((rig.joints.row(0) - Eigen::RowVector3d(1, 2, 0)).norm(), 1e-12);
  EXPECT_LT((rig.joints.row(1) - Eigen::RowVector3d(1, 5, 0)).norm(), 1e-12);
  file.node.clear();
  EXPECT_THROW((void)read_joints(written(file), {}), Error);
}

}  // namespace
}  // namespace curveskel::dress_dae_laws
