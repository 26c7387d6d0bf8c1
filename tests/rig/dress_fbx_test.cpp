// Laws of rigs for FBX files: the look of the file is there in glTF, however the file gives it.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_materials.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include "base/base64.hpp"
#include "tests/glb.hpp"
#include "tests/rig/fbx_mappings.hpp"
#include "tests/rig/fbx_subjects.hpp"
#include "tests/rig/random_rigs.hpp"
#include "tests/surface/scene_encodings.hpp"

namespace curveskel::dress_fbx_laws {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using namespace fbx_mappings;

class DressFbx : public FbxDressing {};

TEST_F(DressFbx, FacesHaveTheMaterialThatTheLayerGivesThem) {
  for (const FbxForm form : all_forms) {
    FbxItem box = encodings::fbx_box();
    box.children.push_back({"LayerElementMaterial",
                            {0},
                            {{"MappingInformationType", {"ByPolygon"}},
                             {"ReferenceInformationType", {"IndexToDirect"}},
                             {"Materials", {std::vector<int>{2, 0, 1, 1, 7, 2}}}}});
    const FbxItems three{material(0, {{"DiffuseColor", {1.0, 0.0, 0.0}}}),
                         material(1, {{"DiffuseColor", {0.0, 1.0, 0.0}}}),
                         material(2, {{"DiffuseColor", {0.0, 0.0, 1.0}}})};
    const auto look = read_materials(written(scene(box, encodings::fbx_model(2), three), form));
    ASSERT_TRUE(look);
    const std::array<int, faces> wanted{2, 0, 1, 1, -1, 2};  // there is no material 7
    for (Eigen::Index t = 0; t < look->triangles.rows(); ++t) {
      EXPECT_EQ(look->material[idx(t)], wanted.at(idx(face_of(*look, t))));
    }
    for (int m = 0; m < 3; ++m) EXPECT_EQ(look->materials[idx(m)].colour[idx(m)], 1);
  }
}

// Hair, belt and body came out as one mesh, and their names were lost.
TEST_F(DressFbx, EachMeshStaysOneOfItsOwn) {
  const FbxItems beside{material(0, {}), encodings::fbx_model(20)};
  const auto link = [](std::int64_t child, std::int64_t parent) {
    return FbxItem{"C", {"OO", child, parent}};
  };
  for (const FbxForm form : all_forms) {
    FbxItem box = encodings::fbx_box();
    box.children.push_back(Textures{mappings[0], false}.layer());
    const fs::path file =
        written(scene(box, encodings::fbx_model(2), beside, {link(20, 0), link(1, 20)}), form);
    const PolygonSoup soup = read_polygons(file);
    ASSERT_EQ(soup.positions.rows(), 16);
    const Glb glb = glb_of(dressed(file).bytes);
    ASSERT_EQ(glb.json["meshes"].size(), 2U);
    std::set<Json> places;
    for (std::size_t k = 0; k < 2; ++k) {
      const Json& node = glb.json["nodes"][k];
      EXPECT_EQ(node["mesh"], k);
      EXPECT_TRUE(node.contains("skin"));
      EXPECT_EQ(node["name"], glb.json["meshes"][k]["name"]);
      const Json& primitive = glb.json["meshes"][k]["primitives"][0];
      for (const char* name : {"POSITION", "JOINTS_0", "WEIGHTS_0"}) {
        places.insert(primitive["attributes"][name]);
        EXPECT_EQ(glb.json["accessors"][primitive["attributes"][name].get<std::size_t>()]["count"],
                  24);
      }
    }
    EXPECT_EQ(places.size(), 6U) << "each has its own numbers";
    const PolygonSoup again = read_polygons(folder_.write("again.glb", dressed(file).bytes));
    const auto extent = [](const Positions& of) {
      return (of.colwise().maxCoeff() - of.colwise().minCoeff()).eval();
    };
    EXPECT_LT((0.01 * extent(soup.positions) - extent(again.positions)).norm(), 1e-6);
  }
}

TEST_F(DressFbx, NormalsStayNormal) {
  FbxItem box = encodings::fbx_box();
  std::vector<double> normals;
  for (int face = 0; face < faces; ++face) {
    const auto at = [&](int corner) {
      const auto& p = encodings::corners[vertex_at(face, corner)];
      return Eigen::Vector3d(p[0], p[1], p[2]);
    };
    const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    for (int corner = 0; corner < 4; ++corner) {
      normals.insert(normals.end(), normal.begin(), normal.end());
    }
  }
  box.children.push_back({"LayerElementNormal",
                          {0},
                          {{"MappingInformationType", {"ByPolygonVertex"}},
                           {"ReferenceInformationType", {"Direct"}},
                           {"Normals", {normals}}}});
  for (const double side : {1.0, -2.0}) {
    const FbxItem model = encodings::fbx_model(
        2, {{"Lcl Rotation", {30.0, 40.0, 50.0}}, {"Lcl Scaling", {side, 0.5, 3.0}}});
    const Glb glb = glb_of(dressed(written(scene(box, model, {}), FbxForm::binary)).bytes);
    const Json& primitive = glb.json["meshes"][0]["primitives"][0];
    const auto places = glb.values<float>(primitive["attributes"]["POSITION"]);
    const auto written_normals = glb.values<float>(primitive["attributes"]["NORMAL"]);
    const auto triangles = glb.values<std::uint32_t>(primitive["indices"]);
    ASSERT_EQ(triangles.size(), 36U);
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      const auto row = [&](const std::vector<float>& rows, std::size_t k) {
        return Eigen::Vector3f(
            Eigen::Map<const Eigen::Vector3f>(&rows[3 * std::size_t{triangles[t + k]}]));
      };
      const Eigen::Vector3f edge = row(places, 1) - row(places, 0);
      const Eigen::Vector3f normal = edge.cross(row(places, 2) - row(places, 0)).normalized();
      for (const std::size_t k : {0U, 1U, 2U}) {
        EXPECT_LT((row(written_normals, k) - normal).norm(), 1e-5F);
      }
    }
  }
}

TEST_F(DressFbx, PicturesAreTakenFromTheFileOrFoundBesideIt) {
  fs::create_directory(folder_.path() / "textures");
  (void)folder_.write("textures/skin.png", png);
  for (const FbxForm form : all_forms) {
    for (const bool is_within : {true, false}) {
      FbxItem video{"Video",
                    {std::int64_t{30}, "Video::v", "Clip"},
                    {{"RelativeFilename", {"..\\work\\skin.png"}}}};
      if (is_within) {
        const std::string bytes = form == FbxForm::text ? base64_of(png) : png;
        video.children.push_back({"Content", {bytes}});
      }
      const FbxItems beside{material(0, {}),
                            material(1, {}),
                            {"Texture", {std::int64_t{20}, "Texture::t", ""}},
                            video};
      const std::vector<FbxItem> links{
          {"C", {"OP", std::int64_t{20}, first_material, "DiffuseColor"}},
          {"C", {"OP", std::int64_t{20}, first_material + 1, "Maya|TEX_color_map"}},
          {"C", {"OP", std::int64_t{20}, first_material + 1, "NormalMap"}},
          {"C", {"OO", std::int64_t{30}, std::int64_t{20}}}};
      const EditedFile edited = dressed(
          written(scene(encodings::fbx_box(), encodings::fbx_model(2), beside, links), form));
      EXPECT_TRUE(edited.notes.empty());
      const Glb glb = glb_of(edited.bytes);
      EXPECT_EQ(glb.json["textures"], Json::array({{{"source", 0}}}));  // one for all
      const Json& image = glb.json["images"][0];
      EXPECT_EQ(image["name"], "skin");
      const Json& view = glb.json["bufferViews"][image["bufferView"].get<std::size_t>()];
      EXPECT_EQ(glb.numbers.substr(view["byteOffset"], view["byteLength"]), png);
      for (const Json& one : glb.json["materials"]) {
        EXPECT_EQ(one["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
      }
      EXPECT_EQ(glb.json["materials"][1]["normalTexture"]["index"], 0);
    }
  }
}

TEST_F(DressFbx, OpacityIsWhatExportersMean) {
  using Given = std::vector<encodings::FbxProperty>;
  const std::vector<std::pair<Given, double>> cases{
      {{}, 1},
      {{{"Opacity", {0.25}}, {"TransparencyFactor", {1.0}}}, 0.25},
      {{{"TransparencyFactor", {0.75}}}, 0.25},
      {{{"TransparencyFactor", {1.0}}, {"TransparentColor", {0.0, 0.0, 0.0}}}, 1},
      {{{"TransparencyFactor", {1.0}}, {"TransparentColor", {0.5, 0.5, 0.5}}}, 0.5},
      {{{"Opacity", {0.0}}}, 1},  // nobody has a thing that is not seen
  };
  for (const auto& [given, opacity] : cases) {
    const FbxItems records =
        scene(encodings::fbx_box(), encodings::fbx_model(2), {material(0, given)});
    const Glb glb = glb_of(dressed(written(records, FbxForm::text)).bytes);
    const Json& look = glb.json["materials"][0];
    EXPECT_NEAR(look["pbrMetallicRoughness"]["baseColorFactor"][3].get<double>(), opacity, 1e-12);
    EXPECT_EQ(look.contains("alphaMode"), opacity < 1);
  }
}

/// Corners of triangles by place and texture coordinates in hundredths, by material.
using Corners = std::multiset<std::array<long, 15>>;
std::map<int, Corners> corners_of(const fs::path& file) {
  const auto look = read_materials(file);
  const PolygonSoup soup = read_polygons(file);
  std::map<int, Corners> result;
  for (Eigen::Index t = 0; look && t < look->triangles.rows(); ++t) {
    std::array<std::array<long, 5>, 3> triangle{};
    for (int k = 0; k < 3; ++k) {
      const int drawn = look->triangles(t, k);
      Eigen::RowVector<float, 5> row;
      row << soup.positions.row(look->vertices[idx(drawn)]).cast<float>(),
          look->places_in_picture.row(drawn);
      for (int n = 0; n < 5; ++n) triangle.at(idx(k)).at(idx(n)) = std::lround(100 * row[n]);
    }
    const auto first = std::min_element(triangle.begin(), triangle.end());
    std::rotate(triangle.begin(), first, triangle.end());
    std::array<long, 15> flat{};
    for (std::size_t k = 0; k < flat.size(); ++k) flat.at(k) = triangle.at(k / 5).at(k % 5);
    result[look->material[idx(t)]].insert(flat);
  }
  return result;
}

TEST_F(DressFbx, TheFilesOfARigCanBeRiggedAgain) {
  (void)folder_.write("looks.mtl",
                      "newmtl skin\nmap_Kd skin.png\nNs 90\n"
                      "newmtl glass\nKd .25 .5 1\nd .5\nPm 1\nPr .25\nKe .5 0 0\n");
  (void)folder_.write("skin.png", png);
  std::string obj = "mtllib looks.mtl\n";
  for (auto p : encodings::corners) {  // no face a rectangle, whose diagonals are alike
    p[0] = 25 * p[0] + p[1] + p[1] * p[2];
    obj += "v " + encodings::spaced(p) + "\n";
  }
  obj += "vt 0 0\nvt .5 0\nvt .5 1\nvt 0 .25\n";
  for (int face = 0; face < faces; ++face) {
    obj += face % 3 == 0 ? (face == 0 ? "usemtl skin\nf" : "usemtl glass\nf") : "f";
    for (int k = 0; k < 4; ++k) {
      obj += " " + std::to_string(vertex_at(face, k) + 1) + "/" + std::to_string(k + 1);
    }
    obj += "\n";
  }
  const fs::path given = folder_.write("box.obj", obj);
  const fs::path fbx = folder_.write("once.fbx", dressed(given, RigFormat::fbx).bytes);
  const Glb once = glb_of(dressed(given).bytes);
  const EditedFile edited = dressed(fbx);
  EXPECT_TRUE(edited.notes.empty());
  Glb twice = glb_of(edited.bytes);
  for (Json& material : twice.json["materials"]) material.erase("doubleSided");
  ASSERT_EQ(twice.json["materials"].size(), 2U);
  for (const std::size_t m : {0U, 1U}) {
    const Json& wanted = once.json["materials"][m];
    const Json& found = twice.json["materials"][m];
    EXPECT_EQ(found["name"], wanted["name"]);
    const Json& look = wanted["pbrMetallicRoughness"];
    const Json& again = found["pbrMetallicRoughness"];
    EXPECT_EQ(again["baseColorFactor"], look["baseColorFactor"]);
    EXPECT_NEAR(again["roughnessFactor"].get<double>(), look["roughnessFactor"].get<double>(),
                1e-9);
    EXPECT_EQ(again["metallicFactor"], look["metallicFactor"]);
    EXPECT_EQ(found.value("emissiveFactor", Json()), wanted.value("emissiveFactor", Json()));
    EXPECT_EQ(found.value("alphaMode", ""), wanted.value("alphaMode", ""));
  }
  const auto wanted = corners_of(folder_.write("once.glb", dressed(given).bytes));
  EXPECT_EQ(wanted.size(), 2U);
  EXPECT_EQ(corners_of(fbx), wanted);
  EXPECT_EQ(corners_of(folder_.write("twice.glb", edited.bytes)), wanted);
}

/// Two channels, the second of which is half on; the model is turned, and its uv seam copies vertex
/// 7, which moves, too.
TEST_F(DressFbx, ShapesBecomeMorphTargets) {
  const Textures textures{mappings[0], false};
  FbxItem box = encodings::fbx_box();
  box.children.push_back(textures.layer());
  FbxItems objects{{"Deformer", {std::int64_t{40}, "Deformer::m", "BlendShape"}}};
  std::vector<FbxItem> links{{"C", {"OO", std::int64_t{40}, std::int64_t{1}}}};
  const std::vector<double> moves{0.5, 0, 0, 0, 0, 2};
  for (const std::int64_t k : {0, 1}) {
    objects.push_back({"Deformer",
                       {50 + k, "SubDeformer::channel " + std::to_string(k), "BlendShapeChannel"},
                       {{"DeformPercent", {50.0 * double(k)}}}});
    objects.push_back({"Geometry",
                       {60 + k, "Geometry::s", "Shape"},
                       {{"Indexes", {std::vector<int>{2, 7}}}, {"Vertices", {moves}}}});
    links.push_back({"C", {"OO", 50 + k, std::int64_t{40}}});
    links.push_back({"C", {"OO", 60 + k, 50 + k}});
  }
  const FbxItem model = encodings::fbx_model(2, {{"Lcl Rotation", {0.0, 0.0, 90.0}}});
  for (const FbxForm form : all_forms) {
    const fs::path file = written(scene(box, model, objects, links), form);
    const PolygonSoup soup = read_polygons(file);
    const Glb glb = glb_of(dressed(file).bytes);
    const Json& mesh = glb.json["meshes"][0];
    EXPECT_EQ(mesh["weights"], Json({0, 0.5}));
    EXPECT_EQ(mesh["extras"]["targetNames"], Json({"channel 0", "channel 1"}));
    const Json& primitive = mesh["primitives"][0];
    const auto places = glb.values<float>(primitive["attributes"]["POSITION"]);
    ASSERT_EQ(primitive["targets"].size(), 2U);
    for (const Json& target : primitive["targets"]) {
      const Json& accessor = glb.json["accessors"][target["POSITION"].get<std::size_t>()];
      const Json& sparse = accessor["sparse"];
      EXPECT_EQ(3 * accessor["count"].get<std::size_t>(), places.size());
      const auto rows = glb.of_view<std::uint32_t>(sparse["indices"]["bufferView"]);
      const auto found = glb.of_view<float>(sparse["values"]["bufferView"]);
      ASSERT_EQ(rows.size(), 6U);  // each of the two on three faces
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const Eigen::Vector3f at =
            Eigen::Map<const Eigen::Vector3f>(&places[3 * std::size_t{rows[k]}]);
        const Eigen::Vector3f moved = Eigen::Map<const Eigen::Vector3f>(&found[3 * k]);
        const Eigen::Vector3d shown = soup.positions.row(2);
        const bool is_second =
            (at - (shown - 0.5 * Eigen::Vector3d(0, 0.5, 0)).cast<float>()).norm() < 1e-6F;
        const Eigen::Vector3f wanted =
            is_second ? Eigen::Vector3f(0, 0.5, 0) : Eigen::Vector3f(0, 0, 2);
        EXPECT_LT((moved - wanted).norm(), 1e-6F);
      }
    }
  }
}

/// In glTF the thing stands upright, in metres; its stored vertices stay as they are.
TEST_F(DressFbx, TheSceneIsInMetresWithYUp) {
  struct Frame {
    double unit;
    int up;
    int front;
    double front_sign;
    Eigen::Matrix3d axes;
  };
  Eigen::Matrix3d upright;
  upright << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const std::vector<Frame> frames{{1, 1, 2, 1, Eigen::Matrix3d::Identity()},
                                  {100, 1, 2, 1, Eigen::Matrix3d::Identity()},
                                  {2.54, 2, 1, -1, upright},
                                  {100, 2, 2, 1, Eigen::Matrix3d::Identity()},  // no axes
                                  {0, 7, 1, -1, Eigen::Matrix3d::Identity()}};
  const Rig rig = random_rig(8, 5, "bone ");
  for (const Frame& frame : frames) {
    SCOPED_TRACE(frame.unit);
    FbxItem settings{"GlobalSettings",
                     {},
                     {properties({{"UpAxis", {frame.up}},
                                  {"FrontAxis", {frame.front}},
                                  {"FrontAxisSign", {frame.front_sign}},
                                  {"UnitScaleFactor", {frame.unit}}})}};
    FbxItems records = scene(encodings::fbx_box(), encodings::fbx_model(2), {material(0, {})});
    records.push_back(settings);
    const fs::path file = written(records, FbxForm::binary);
    const PolygonSoup given = read_polygons(file);
    EXPECT_EQ(given.z_is_up, frame.up == 2);
    const auto edited =
        format_rig_into(file, rig, {RigFormat::glb, OldRig::replaced, "rig", "a test"});
    ASSERT_TRUE(edited);
    Rig stated = rig;  // as `rig_polygons` makes it of the soup
    stated.to_y_up = given.to_gltf;
    EXPECT_EQ(
        format_rig_into(file, stated, {RigFormat::glb, OldRig::replaced, "rig", "a test"})->bytes,
        edited->bytes);
    const fs::path made = folder_.write("made.glb", edited->bytes);
    const double scale = frame.unit > 0 ? frame.unit / 100 : 1;
    const auto in_scene = [&](const Positions& places) -> Positions {
      return scale * places * frame.axes.transpose();
    };
    EXPECT_LT((given.to_gltf - scale * frame.axes).norm(), 1e-15);
    EXPECT_LT((read_polygons(made).positions - in_scene(given.positions)).norm(), 1e-5 * scale);
    EXPECT_LT((read_rig(made, {})->joints - in_scene(rig.joints)).norm(), 1e-5 * scale);
    const Glb glb = glb_of(edited->bytes);
    const auto stored =
        glb.values<float>(glb.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"]);
    for (Eigen::Index v = 0; v < 8; ++v) {
      for (Eigen::Index k = 0; k < 3; ++k) {
        EXPECT_EQ(stored[idx(3 * v + k)], static_cast<float>(given.positions(v, k)));
      }
    }
  }
}

TEST_F(DressFbx, BrokenNumbersAreNone) {
  FbxItem box = encodings::fbx_box();
  box.children.push_back({"LayerElementUV",
                          {0},
                          {{"MappingInformationType", {"ByPolygonVertex"}},
                           {"ReferenceInformationType", {"IndexToDirect"}},
                           {"UV", {std::vector<double>{0.5, 0.5, 0.25}}},
                           {"UVIndex", {std::vector<int>{0, 0, -3, 1, 90000}}}}});
  box.children.push_back({"LayerElementNormal", {0}, {{"MappingInformationType", {"ByPolygon"}}}});
  for (const FbxForm form : all_forms) {
    const Glb glb = glb_of(dressed(written(scene(box, encodings::fbx_model(2), {}), form)).bytes);
    const Json& attributes = glb.json["meshes"][0]["primitives"][0]["attributes"];
    for (const float number : glb.values<float>(attributes["TEXCOORD_0"])) {
      EXPECT_TRUE(number == 0 || number == 0.5F || number == 1);
    }
  }
}

/// Of a box without looks in metres; one in centimetres is scaled.
TEST_F(DressFbx, NothingWhereThereIsNothingToKeep) {
  FbxItems records = encodings::fbx_box_scene();
  const Rig rig = random_rig(8, 3, "bone ");
  EXPECT_TRUE(format_rig_into(written(records, FbxForm::text), rig));
  records.push_back({"GlobalSettings", {}, {properties({{"UnitScaleFactor", {100.0}}})}});
  EXPECT_FALSE(format_rig_into(written(records, FbxForm::text), rig));
}

}  // namespace
}  // namespace curveskel::dress_fbx_laws
