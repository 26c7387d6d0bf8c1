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
#include "tests/rig/dae_subjects.hpp"
#include "tests/rig/random_rigs.hpp"
#include "tests/surface/scene_encodings.hpp"

namespace curveskel::dress_dae_laws {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using namespace dae_subjects;

class DressDae : public DaeDressing {};

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

/// The box, turned, with a target in which vertex 3, or each, is moved by .5 along y as it is
/// shown.
Dae morphed(bool relative, double weight, bool moves_all = false) {
  std::string numbers;
  for (std::size_t v = 0; v < 8; ++v) {
    const auto& p = encodings::corners[v];
    const Eigen::Vector3d base =
        relative ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(p[0], p[1], p[2]);
    const bool moves = moves_all || v == 3;
    const Eigen::Vector3d move = moves ? Eigen::Vector3d(0.5, 0, 0) : Eigen::Vector3d(0, 0, 0);
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
      "\"><source id=\"targets\"><IDREF_array count=\"1\">smile-mesh</IDREF_array></source>" +
      Dae::source("weights", 1, encodings::fbx_number(weight) + " ") +
      "<targets><input semantic=\"MORPH_TARGET\" source=\"#targets\"/><input "
      "semantic=\"MORPH_WEIGHT\" source=\"#weights\"/></targets></morph></controller>"
      "</library_controllers>";
  return file;
}

TEST_F(DressDae, MorphsBecomeMorphTargets) {
  for (const bool relative : {false, true}) {
    const Dae file = morphed(relative, 0);
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

/// Programs refuse a file with others. Vertices that are not listed are at 0.
TEST_F(DressDae, MorphTargetsHaveTheBoundsOfTheirNumbers) {
  for (const bool moves_all : {false, true}) {
    const Glb glb = glb_of(dressed(written(morphed(true, 0, moves_all))).bytes);
    const Json& target = glb.json["meshes"][0]["primitives"][0]["targets"][0];
    const Json& accessor = glb.json["accessors"][target["POSITION"].get<std::size_t>()];
    EXPECT_EQ(accessor["sparse"]["count"] == accessor["count"], moves_all);
    EXPECT_NEAR(accessor["min"][1].get<double>(), moves_all ? 0.5 : 0, 1e-6);
    EXPECT_NEAR(accessor["max"][1].get<double>(), 0.5, 1e-6);
  }
}

/// The weight of a morph that is on in the file is that of the target, not a part of the mesh.
TEST_F(DressDae, MorphsThatAreOnStaySliders) {
  for (const bool relative : {false, true}) {
    const Dae off = morphed(relative, 0);
    const Positions base = read_polygons(written(off)).positions;
    const fs::path path = written(morphed(relative, 0.25));
    const Positions shown = read_polygons(path).positions;
    Positions wanted = base;
    wanted(3, 1) += 0.25 * 0.5;
    EXPECT_LT((shown - wanted).norm(), 1e-12);
    const EditedFile edited = dressed(path);
    const Glb glb = glb_of(edited.bytes);
    const Json& mesh = glb.json["meshes"][0];
    EXPECT_EQ(mesh["weights"], Json({0.25}));
    const auto stored = glb.values<float>(mesh["primitives"][0]["attributes"]["POSITION"]);
    for (Eigen::Index k = 0; k < 24; ++k) EXPECT_NEAR(stored[idx(k)], base(k / 3, k % 3), 1e-6);
    const Positions seen = read_polygons(folder_.write("made.glb", edited.bytes)).positions;
    EXPECT_LT((seen.topRows(8) - shown).norm(), 1e-6);
  }
}

/// Blender writes morphs beside the meshes that they morph, and nothing that refers to them.
TEST_F(DressDae, MorphsThatNothingRefersToAreThoseOfTheirMesh) {
  for (const double weight : {0.0, 0.25}) {
    const Dae referred = morphed(false, weight);
    Dae loose = referred;
    loose.instance = Dae{}.instance;
    EXPECT_TRUE(read_polygons(written(loose)).positions ==
                read_polygons(written(referred)).positions);
    EXPECT_EQ(dressed(written(loose)).bytes, dressed(written(referred)).bytes);
    // One that something refers to is not that of the plain mesh beside it.
    Dae both = referred;
    both.binding =
        "</instance_controller><instance_geometry url=\"#box\"/><instance_controller "
        "url=\"#morph\">";
    const Positions shown = read_polygons(written(both)).positions;
    ASSERT_EQ(shown.rows(), 24);
    EXPECT_NEAR((shown.middleRows(8, 8) - shown.topRows(8)).norm(), 0.5 * weight, 1e-12);
    EXPECT_TRUE(shown.bottomRows(8) == shown.topRows(8));
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
