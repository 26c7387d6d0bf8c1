// Laws of rigs for OBJ files with materials: what a corner of a face names is there in glTF.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_materials.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include "rig/gltf/obj_file.hpp"
#include "rig/gltf/split_mesh.hpp"
#include "tests/glb.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/random_rigs.hpp"
#include "tests/surface/encodings.hpp"

namespace curveskel::dress_obj_laws {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string png("\x89PNG\r\n\x1a\n not a true picture", 27);

/// A torus whose every face has texture coordinates of its own kind: by its row, so that each
/// vertex has up to `seams` of them; faces in `materials` runs.
struct ObjSubject {
  int seams = 3;
  int materials = 2;
  bool normals = false;
  bool backwards = false;  ///< negative indices

  [[nodiscard]] std::string text() const {
    const Surface torus = torus_surface();
    std::ostringstream obj;
    obj.precision(17);
    if (materials > 0) obj << "mtllib looks of it.mtl\n";
    for (const auto& v : torus.positions.rowwise()) {
      obj << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    }
    for (int seam = 0; seam < seams; ++seam) obj << "vt " << 0.1 * seam << " 0.25\n";
    if (normals) obj << "vn 0 0 2\nvn 1 0 0\n";
    const int vertices = static_cast<int>(torus.positions.rows());
    const Eigen::Index faces = torus.triangles.rows();
    for (Eigen::Index f = 0; f < faces; ++f) {
      if (materials > 0 && f * materials % faces < materials) {
        obj << "usemtl m " << f * materials / faces << '\n';
      }
      obj << 'f';
      for (const int v : torus.triangles.row(f)) {
        obj << ' ' << (backwards ? v - vertices : v + 1);
        if (seams > 0) obj << '/' << texture_of(f) + 1;
        if (normals) obj << (seams > 0 ? "/" : "//") << f % 2 + 1;
      }
      obj << '\n';
    }
    return obj.str();
  }

  [[nodiscard]] int texture_of(Eigen::Index face) const {
    return static_cast<int>(face) % std::max(seams, 1);
  }
};

std::vector<ObjSubject> subjects() {
  return {{},
          {.seams = 1, .materials = 1},
          {.seams = 0, .materials = 3},
          {.seams = 5, .materials = 0},
          {.seams = 0, .materials = 0, .normals = true},
          {.seams = 2, .materials = 4, .normals = true, .backwards = true}};
}

class DressObj : public testing::Test {
 protected:
  [[nodiscard]] EditedFile dressed(const std::string& obj, const Rig& rig) const {
    const auto edited = format_rig_into(folder_.write("a thing.obj", obj), rig,
                                        {RigFormat::glb, OldRig::replaced, "rig", "a test"});
    EXPECT_TRUE(edited);
    return *edited;
  }

  void write_materials() const {
    (void)folder_.write(
        "looks of it.mtl",
        "newmtl m 0\nKd 0.25 0.5 1\nd 0.5\nNs 250\n"
        "newmtl m 1\nKd 0.1 0.1 0.1\nmap_Kd -s 2 4 1 -o 0.25 0.5 skin one.png\nKe 0 0 0\n"
        "newmtl m 2\nmap_Kd C:\\work\\skin one.png\nmap_Ke none.png\nPm 1\n"
        "newmtl m 3\nmap_Kd painting.tga\nmap_d painting.tga\n");
    (void)folder_.write("skin one.png", png);
    (void)folder_.write("painting.tga", "no glTF has this");
  }

  OwnFolder folder_;
  const Rig rig_ = random_rig(torus_surface().positions.rows(), 9, "bone ");
};

TEST_F(DressObj, KeepsTheVerticesAndCopiesThoseAtSeams) {
  write_materials();
  const Surface torus = torus_surface();
  const Eigen::Index count = torus.positions.rows();
  for (const ObjSubject& subject : subjects()) {
    const EditedFile edited = dressed(subject.text(), rig_);
    const fs::path file = folder_.write("dressed.glb", edited.bytes);
    const PolygonSoup soup = read_polygons(file, {});
    ASSERT_GE(soup.positions.rows(), count);
    EXPECT_LT((soup.positions.topRows(count) - torus.positions).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_EQ(soup.positions.rows() > count, subject.seams > 1 || subject.normals);
    EXPECT_EQ(soup.corners.size(), idx(torus.triangles.size()));
    const Rig found = *read_rig(file, {});
    const fs::path bare =
        folder_.write("bare.glb", format_rig(torus, rig_, RigFormat::glb, "", ""));
    const Eigen::MatrixXf expected = read_rig(bare, {})->weights;
    std::map<std::array<float, 3>, Eigen::Index> vertex_at;
    const auto place = [&](const Positions& all, Eigen::Index v) -> std::array<float, 3> {
      const Eigen::RowVector3f at = all.row(v).cast<float>();
      return {at.x(), at.y(), at.z()};
    };
    for (Eigen::Index v = 0; v < count; ++v) vertex_at[place(torus.positions, v)] = v;
    for (Eigen::Index v = 0; v < soup.positions.rows(); ++v) {
      const Eigen::Index own = vertex_at.at(place(soup.positions, v));
      if (v < count) {
        EXPECT_EQ(own, v);
      }
      EXPECT_LT((Eigen::MatrixXf(found.weights.row(v)) - expected.row(own)).norm(), 1e-6F);
    }
  }
}

/// By material, every triangle with the places, texture coordinates and normals of its corners.
TEST_F(DressObj, EveryCornerHasWhatItsFaceNames) {
  write_materials();
  const Surface torus = torus_surface();
  for (const ObjSubject& subject : subjects()) {
    const Glb glb = glb_of(dressed(subject.text(), rig_).bytes);
    const Json& primitives = glb.json["meshes"][0]["primitives"];
    const auto runs = static_cast<std::size_t>(std::max(subject.materials, 1));
    ASSERT_EQ(primitives.size(), runs);
    const Json& attributes = primitives[0]["attributes"];
    const auto places = glb.values<float>(attributes["POSITION"]);
    const auto normals = glb.values<float>(attributes["NORMAL"]);
    const auto textures = attributes.contains("TEXCOORD_0")
                              ? glb.values<float>(attributes["TEXCOORD_0"])
                              : std::vector<float>();
    EXPECT_EQ(textures.empty(), subject.seams == 0);
    Eigen::Index face = 0;
    for (std::size_t run = 0; run < runs; ++run) {
      EXPECT_EQ(primitives[run]["attributes"], attributes);  // all share their vertices
      EXPECT_EQ(primitives[run].value("material", -1), subject.materials > 0 ? int(run) : -1);
      const auto corners = glb.values<std::uint32_t>(primitives[run]["indices"]);
      for (std::size_t c = 0; c < corners.size(); ++c) {
        const std::size_t v = corners[c];
        const auto f = face + static_cast<Eigen::Index>(c / 3);
        const Eigen::RowVector3d at =
            torus.positions.row(torus.triangles(f, static_cast<Eigen::Index>(c % 3)));
        EXPECT_NEAR(
            (Eigen::Map<const Eigen::RowVector3f>(&places[3 * v]).cast<double>() - at).norm(), 0,
            1e-6);
        if (subject.seams > 0) {
          EXPECT_FLOAT_EQ(textures[2 * v], 0.1F * float(subject.texture_of(f)));
          EXPECT_FLOAT_EQ(textures[2 * v + 1], 0.75F);
        }
        const Eigen::RowVector3f normal = Eigen::Map<const Eigen::RowVector3f>(&normals[3 * v]);
        EXPECT_NEAR(normal.norm(), 1, 1e-6);
        if (subject.normals) {
          EXPECT_FLOAT_EQ(normal[f % 2 == 0 ? 2 : 0], 1);
        }
      }
      face += static_cast<Eigen::Index>(corners.size() / 3);
    }
    EXPECT_EQ(face, torus.triangles.rows());
  }
}

TEST_F(DressObj, MaterialsAreThoseOfTheLibrary) {
  write_materials();
  const EditedFile edited = dressed(ObjSubject{.materials = 5}.text(), rig_);
  const Glb glb = glb_of(edited.bytes);
  const Json& materials = glb.json["materials"];
  ASSERT_EQ(materials.size(), 5U);
  for (int m = 0; m < 5; ++m) EXPECT_EQ(materials[idx(m)]["name"], "m " + std::to_string(m));
  EXPECT_EQ(materials[0]["pbrMetallicRoughness"]["baseColorFactor"], Json({0.25, 0.5, 1.0, 0.5}));
  EXPECT_EQ(materials[0]["pbrMetallicRoughness"]["roughnessFactor"], 0.5);
  EXPECT_EQ(materials[0]["alphaMode"], "BLEND");
  EXPECT_FALSE(materials[1].contains("alphaMode"));
  EXPECT_FALSE(materials[1].contains("emissiveFactor"));
  EXPECT_EQ(materials[1]["pbrMetallicRoughness"]["baseColorFactor"], Json({1.0, 1.0, 1.0, 1.0}));
  EXPECT_EQ(materials[2]["pbrMetallicRoughness"]["metallicFactor"], 1.0);
  EXPECT_FALSE(materials[4].contains("pbrMetallicRoughness"));  // in no library
  ASSERT_EQ(glb.json["images"].size(), 1U);                     // one picture, two materials
  EXPECT_EQ(glb.json["textures"], Json::array({{{"source", 0}}}));
  for (const std::size_t m : {1U, 2U}) {
    EXPECT_EQ(materials[m]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
  }
  const auto tiled = [&](std::size_t m) {
    const Json& picture = materials[m]["pbrMetallicRoughness"]["baseColorTexture"];
    return picture.value("/extensions/KHR_texture_transform"_json_pointer, Json());
  };
  EXPECT_EQ(tiled(1), Json({{"scale", {2.0, 4.0}}, {"offset", {0.25, -3.5}}}));  // from above
  EXPECT_TRUE(tiled(2).is_null());
  const Json& view =
      glb.json["bufferViews"][glb.json["images"][0]["bufferView"].get<std::size_t>()];
  EXPECT_EQ(glb.numbers.substr(view["byteOffset"], view["byteLength"]), png);
  const auto is_noted = [&](const std::string& word) {
    return std::any_of(edited.notes.begin(), edited.notes.end(), [&](const std::string& note) {
      return note.find(word) != std::string::npos;
    });
  };
  EXPECT_TRUE(is_noted("none.png"));
  EXPECT_TRUE(is_noted("painting.tga"));
  EXPECT_TRUE(is_noted("\"m 4\""));
  EXPECT_FALSE(is_noted("skin one"));
}

TEST_F(DressObj, AMissingLibraryIsNamed) {
  const EditedFile edited = dressed(ObjSubject{}.text(), rig_);
  ASSERT_FALSE(edited.notes.empty());
  EXPECT_NE(edited.notes[0].find("looks of it.mtl"), std::string::npos);
  EXPECT_EQ(glb_of(edited.bytes).json["materials"].size(), 2U);
}

/// Polygons are triangulated with their texture coordinates; a face without a place is left out.
TEST_F(DressObj, PolygonsKeepTheirTextureCoordinates) {
  const std::string obj =
      "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 nan\nv 1 3 1\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
      "f 1/1 2/2 3/3 4/4\nf 4/4 3/3 6\nf 1/1 5/2 3/3\n";
  const Glb glb = glb_of(dressed(obj, random_rig(6, 3, "bone ")).bytes);
  const Json& primitive = glb.json["meshes"][0]["primitives"][0];
  const auto corners = glb.values<std::uint32_t>(primitive["indices"]);
  const auto textures = glb.values<float>(primitive["attributes"]["TEXCOORD_0"]);
  ASSERT_EQ(corners.size(), 9U);
  const std::array<std::array<float, 2>, 4> expected{{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  for (std::size_t c = 0; c < 6; ++c) {
    ASSERT_LT(corners[c], 4U);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(textures[2 * std::size_t{corners[c]} + k], expected.at(corners[c]).at(k));
    }
  }
  for (const float number : glb.values<float>(primitive["attributes"]["POSITION"])) {
    EXPECT_TRUE(std::isfinite(number));
  }
}

/// The faces of a torus in `objects` runs of their own name; vertices all before the first object,
/// or those that an object has first in front of its faces.
std::string text_of_objects(const Surface& torus, int objects, bool vertices_first, bool textures) {
  std::ostringstream obj;
  obj.precision(17);
  std::vector<int> number(idx(torus.positions.rows()), 0);  // in the file, from 1
  int written = 0;
  const auto write_vertex = [&](int v) {
    if (number[idx(v)] > 0) return;
    number[idx(v)] = ++written;
    const auto at = torus.positions.row(v);
    obj << "v " << at.x() << ' ' << at.y() << ' ' << at.z() << '\n';
  };
  const auto run_of = [&](Eigen::Index f) { return f * objects / torus.triangles.rows(); };
  for (int v = 0; vertices_first && v < torus.positions.rows(); ++v) write_vertex(v);
  if (textures) obj << "vt 0.5 0.5\n";
  for (int object = 0; object < objects; ++object) {
    obj << "o empty " << object << "\no part " << object << '\n';
    for (const bool faces : {false, true}) {
      for (Eigen::Index f = 0; f < torus.triangles.rows(); ++f) {
        if (run_of(f) != object) continue;
        if (faces) obj << 'f';
        for (const int v : torus.triangles.row(f)) {
          if (faces) obj << ' ' << number[idx(v)] << (textures ? "/1" : "");
          if (!faces) write_vertex(v);
        }
        if (faces) obj << '\n';
      }
    }
  }
  return obj.str();
}

using PlacedFace = std::array<float, 9>;

PlacedFace placed_face(const std::vector<float>& places, const std::array<std::size_t, 3>& face) {
  PlacedFace placed{};
  for (std::size_t c = 0; c < 3; ++c) {
    std::copy_n(places.begin() + static_cast<std::ptrdiff_t>(3 * face.at(c)), 3,
                placed.begin() + static_cast<std::ptrdiff_t>(3 * c));
  }
  return placed;
}

struct ObjObjects {
  int count = 2;
  bool vertices_first = false;
  bool textures = false;
};

/// The faces of `face` on, those of object `object`; returns the next face.
Eigen::Index expect_object(const Glb& glb, const ObjObjects& objects, int object,
                           Eigen::Index face) {
  const Surface torus = torus_surface();
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> at = torus.positions.cast<float>();
  const std::vector<float> places(at.data(), at.data() + at.size());
  const Json& mesh = glb.json["meshes"][static_cast<std::size_t>(object)];
  const Json& node = glb.json["nodes"][static_cast<std::size_t>(object)];
  EXPECT_EQ(mesh["name"], "part " + std::to_string(object));
  EXPECT_EQ(node["name"], mesh["name"]);
  EXPECT_EQ(node["mesh"], object);
  EXPECT_TRUE(node.contains("skin"));
  const Json& attributes = mesh["primitives"][0]["attributes"];
  EXPECT_EQ(attributes.contains("TEXCOORD_0"), objects.textures);
  const auto found = glb.values<float>(attributes["POSITION"]);
  const auto corners = glb.values<std::uint32_t>(mesh["primitives"][0]["indices"]);
  const std::set<std::uint32_t> used(corners.begin(), corners.end());
  EXPECT_EQ(3 * used.size(), found.size());  // none that its faces do not have
  for (std::size_t c = 0; c < corners.size(); c += 3, ++face) {
    const auto expected = torus.triangles.row(face);
    EXPECT_EQ(placed_face(found, {corners[c], corners[c + 1], corners[c + 2]}),
              placed_face(places, {idx(expected[0]), idx(expected[1]), idx(expected[2])}));
  }
  return face;
}

/// As in Blender, which makes an object of each; none of those that have no faces.
TEST_F(DressObj, AnObjectIsANodeWithItsNameAndItsFaces) {
  const Surface torus = torus_surface();
  for (const int number : {0, 1, 2, 3, 4, 5}) {
    const ObjObjects objects{2 + number, number % 2 == 0, number % 3 == 0};
    const std::string text =
        text_of_objects(torus, objects.count, objects.vertices_first, objects.textures);
    const PolygonSoup soup = read_polygons(folder_.write("objects.obj", text), {});
    const Rig rig = random_rig(soup.positions.rows(), 9, "bone ");
    const EditedFile edited = dressed(text, rig);
    const Glb glb = glb_of(edited.bytes);
    ASSERT_EQ(glb.json["meshes"].size(), static_cast<std::size_t>(objects.count));
    Eigen::Index face = 0;
    for (int object = 0; object < objects.count; ++object) {
      face = expect_object(glb, objects, object, face);
    }
    EXPECT_EQ(face, torus.triangles.rows());
    const fs::path file = folder_.write("dressed.glb", edited.bytes);
    const Positions written = read_polygons(file, {}).positions;
    const Eigen::MatrixXf weights = read_rig(file, {})->weights;
    const Surface bare{soup.positions, triangulate(soup)};
    const fs::path bare_file =
        folder_.write("bare.glb", format_rig(bare, rig, RigFormat::glb, "", ""));
    const Eigen::MatrixXf expected = read_rig(bare_file, {})->weights;
    for (Eigen::Index v = 0; v < written.rows(); ++v) {
      Eigen::Index own = 0;
      (soup.positions.rowwise() - written.row(v)).rowwise().norm().minCoeff(&own);
      EXPECT_LT((weights.row(v) - expected.row(own)).norm(), 1e-6F);
    }
  }
}

/// Else a scene of thousands of objects would be gone through for each.
TEST_F(DressObj, AnObjectHasGroupsOfItsOwnMaterialsOnly) {
  std::string text;
  for (int object = 0; object < 40; ++object) {
    const std::string number = std::to_string(object);
    text.append("o ").append(number).append("\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl m ");
    text.append(number);
    text += "\nf -4 -2 -3\nf -4 -3 -1\nusemtl shared\nf -3 -2 -1\n";
    if (object % 3 == 0) text.append("usemtl m ").append(number).append("\nf -4 -1 -2\n");
  }
  const FileBytes file{"objects.obj", text};
  const DressedMesh mesh = read_obj_file(file, {}).mesh;
  ASSERT_EQ(mesh.materials.size(), 41U);
  for (const PartRange& part : ranges_of(mesh)) {
    const SplitMesh made = split(mesh, part, file);
    std::vector<std::string> names;
    for (const std::size_t material : made.materials) names.push_back(mesh.materials[material]);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, std::vector<std::string>({"m " + part.part.name, "shared"}));
    EXPECT_EQ(made.corners.size(), 2U);
  }
}

TEST_F(DressObj, NothingWhereThereIsNothingToKeep) {
  const std::string plain = ObjSubject{.seams = 0, .materials = 0}.text();
  EXPECT_FALSE(format_rig_into(folder_.write("plain.obj", plain), rig_));
  EXPECT_FALSE(format_rig_into(folder_.write("plain.off", encodings::off("OFF")), rig_));
}

TEST_F(DressObj, MaterialsAreReadAsTheyAreSeen) {
  write_materials();
  for (const ObjSubject& subject : subjects()) {
    const fs::path file = folder_.write("a thing.obj", subject.text());
    const auto found = read_materials(file);
    ASSERT_EQ(found.has_value(), subject.materials > 0);
    if (!found) continue;
    const Surface torus = torus_surface();
    ASSERT_EQ(found->triangles.rows(), torus.triangles.rows());
    std::set<std::array<int, 3>> faces;
    for (const auto& triangle : torus.triangles.rowwise()) {
      faces.insert({triangle[0], triangle[1], triangle[2]});
    }
    const auto runs = static_cast<Eigen::Index>(subject.materials);
    for (Eigen::Index f = 0; f < found->triangles.rows(); ++f) {
      std::array<int, 3> corners{};
      for (Eigen::Index k = 0; k < 3; ++k) {
        const int drawn = found->triangles(f, k);
        corners[idx(k)] = found->vertices[idx(drawn)];
        const float seen = found->places_in_picture(drawn, 0);
        const float across = found->material[idx(f)] == 1 ? (seen - 0.25F) / 2 : seen;  // tiled
        const int kind = std::max(subject.seams, 1);  // of texture coordinates
        if (subject.seams > 0) {
          EXPECT_NEAR(std::fmod(across * 10 + 0.5F, static_cast<float>(kind)),
                      static_cast<float>(f % kind) + 0.5F, 1e-3F);
        }
      }
      EXPECT_EQ(faces.erase(corners), 1U);
      EXPECT_EQ(found->material[idx(f)], f * runs / found->triangles.rows());
    }
    EXPECT_FLOAT_EQ(found->materials[0].colour[1], 0.5F);
  }
}

TEST_F(DressObj, APictureIsThereOnceForAllThatShowIt) {
  const std::string text = ObjSubject{.materials = 40}.text();
  std::string library;
  for (int k = 0; k < 40; ++k) {
    library += "newmtl m " + std::to_string(k) + "\nmap_Kd " + (k % 4 == 0 ? "other" : "skin");
    library += ".png\n";
  }
  (void)folder_.write("looks of it.mtl", library);
  (void)folder_.write("skin.png", png);
  (void)folder_.write("other.png", png + "another");
  const auto found = read_materials(folder_.write("a thing.obj", text));
  ASSERT_TRUE(found);
  ASSERT_EQ(found->materials.size(), 40U);
  EXPECT_EQ(found->pictures.size(), 2U);
  for (std::size_t k = 0; k < 40; ++k) {
    const int picture = found->materials[k].picture;
    ASSERT_GE(picture, 0);
    EXPECT_EQ(found->pictures[idx(picture)].bytes, k % 4 == 0 ? png + "another" : png);
  }
}

}  // namespace
}  // namespace curveskel::dress_obj_laws
