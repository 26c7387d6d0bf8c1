// Laws of rigs for scans: the colours, normals and pictures of PLY, and the colours of OBJ, are
// there in glTF.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_materials.hpp>
#include <curveskel/rig_files.hpp>
#include "tests/glb.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/random_rigs.hpp"
#include "tests/surface/encodings.hpp"

namespace curveskel::dress_ply_laws {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string png("\x89PNG\r\n\x1a\n no true picture", 24);

/// The box, a tetrahedron's worth of properties behind its coordinates.
struct PlySubject {
  bool is_binary = false;
  bool colours = false;
  bool float_colours = false;
  bool alpha = false;
  bool normals = false;
  std::string vertex_textures = {};  ///< names, as "s t"
  bool corner_textures = false;
  std::string picture = {};

  static int red(int vertex) { return 30 * vertex; }

  [[nodiscard]] std::string text() const {
    std::ostringstream header;
    header << "ply\nformat " << (is_binary ? "binary_little_endian" : "ascii") << " 1.0\n";
    if (!picture.empty()) header << "comment TextureFile " << picture << "\n";
    header << "element vertex 8\nproperty float x\nproperty float y\nproperty float z\n";
    if (normals) header << "property float nx\nproperty float ny\nproperty float nz\n";
    for (const char* name : {"red", "green", "blue", "alpha"}) {
      if (!colours || (std::string(name) == "alpha" && !alpha)) continue;
      header << "property " << (float_colours ? "float " : "uchar ") << name << "\n";
    }
    std::istringstream names(vertex_textures);
    for (std::string name; names >> name;) header << "property float " << name << "\n";
    header << "element face 6\nproperty list uchar int vertex_indices\n";
    if (corner_textures) header << "property list uchar float texcoord\n";
    header << "end_header\n";
    std::string all = header.str();
    const auto put = [&](auto value) {
      if (is_binary) {
        all.append(reinterpret_cast<const char*>(&value), sizeof value);
      } else {
        all += std::to_string(value) + " ";
      }
    };
    for (int v = 0; v < 8; ++v) {
      for (const double x : encodings::corners[idx(v)]) put(static_cast<float>(x));
      if (normals) {
        for (const float x : {0.0F, 0.0F, 2.0F}) put(x);
      }
      for (int k = 0; k < (colours ? (alpha ? 4 : 3) : 0); ++k) {
        const int value = k == 0 ? red(v) : (k == 3 ? 51 : 255);
        if (float_colours) {
          put(static_cast<float>(value) / 255);
        } else {
          put(static_cast<std::uint8_t>(value));
        }
      }
      if (!vertex_textures.empty()) {
        put(0.125F * static_cast<float>(v));
        put(0.25F);
      }
      if (!is_binary) all += "\n";
    }
    for (std::size_t face = 0; face < 6; ++face) {
      put(std::uint8_t{4});
      for (const int v : encodings::quads[face]) put(std::int32_t{v});
      if (corner_textures) {
        put(std::uint8_t{8});
        for (int k = 0; k < 4; ++k) {
          put(0.25F * static_cast<float>(k));
          put(0.125F * static_cast<float>(face));
        }
      }
      if (!is_binary) all += "\n";
    }
    return all;
  }
};

class DressPly : public testing::Test {
 protected:
  [[nodiscard]] Glb dressed(const fs::path& file) const {
    const auto edited = format_rig_into(file, random_rig(8, 5, "bone "),
                                        {RigFormat::glb, OldRig::replaced, "rig", "a test"});
    EXPECT_TRUE(edited);
    return glb_of(edited->bytes);
  }

  static const Json& attributes(const Glb& glb) {
    return glb.json["meshes"][0]["primitives"][0]["attributes"];
  }

  OwnFolder folder_;
};

double light_of(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

TEST_F(DressPly, ColoursAreKept) {
  for (const bool is_binary : {false, true}) {
    for (const bool float_colours : {false, true}) {
      for (const bool alpha : {false, true}) {
        const PlySubject subject{.is_binary = is_binary,
                                 .colours = true,
                                 .float_colours = float_colours,
                                 .alpha = alpha};
        const fs::path file = folder_.write("scan.ply", subject.text());
        const Glb glb = dressed(file);
        const auto colours = glb.values<float>(attributes(glb)["COLOR_0"]);
        ASSERT_EQ(colours.size(), 32U);  // no vertex is copied
        for (int v = 0; v < 8; ++v) {
          EXPECT_NEAR(colours[idx(4 * v)], light_of(PlySubject::red(v) / 255.0), 1e-5);
          EXPECT_NEAR(colours[idx(4 * v + 1)], 1, 1e-5);
          EXPECT_NEAR(colours[idx(4 * v + 3)], alpha ? 0.2 : 1, 1e-5);
        }
        const Json& material = glb.json["materials"].at(0);
        EXPECT_EQ(material["pbrMetallicRoughness"]["metallicFactor"], 0);
        EXPECT_EQ(glb.json["meshes"][0]["primitives"][0]["material"], 0);
        const auto look = read_materials(file);
        ASSERT_TRUE(look);
        for (std::size_t drawn = 0; drawn < look->vertices.size(); ++drawn) {
          EXPECT_NEAR(look->colours(Eigen::Index(drawn), 0),
                      light_of(PlySubject::red(look->vertices[drawn]) / 255.0), 1e-5);
        }
      }
    }
  }
}

TEST_F(DressPly, PicturesLieWhereTheFileSays) {
  (void)folder_.write("skin of it.png", png);
  for (const bool is_binary : {false, true}) {
    for (const std::string names : {"s t", "u v", "texture_u texture_v", ""}) {
      PlySubject subject{.is_binary = is_binary, .colours = true, .vertex_textures = names};
      subject.corner_textures = names.empty();
      subject.picture = "skin of it.png";
      const Glb glb = dressed(folder_.write("scan.ply", subject.text()));
      EXPECT_FALSE(attributes(glb).contains("COLOR_0"));
      EXPECT_EQ(glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
      EXPECT_EQ(glb.json["images"][0]["name"], "skin of it");
      const auto places = glb.values<float>(attributes(glb)["POSITION"]);
      const auto textures = glb.values<float>(attributes(glb)["TEXCOORD_0"]);
      if (!names.empty()) {
        ASSERT_EQ(places.size(), 24U);
        for (int v = 0; v < 8; ++v) {
          EXPECT_EQ(textures[idx(2 * v)], 0.125F * static_cast<float>(v));
          EXPECT_EQ(textures[idx(2 * v + 1)], 0.75F);
        }
        continue;
      }
      const auto triangles =
          glb.values<std::uint32_t>(glb.json["meshes"][0]["primitives"][0]["indices"]);
      ASSERT_EQ(triangles.size(), 36U);
      for (std::size_t c = 0; c < triangles.size(); ++c) {
        const std::size_t v = triangles[c];
        const std::size_t face = c / 6;
        EXPECT_EQ(textures[2 * v + 1], 1 - 0.125F * static_cast<float>(face));
        const auto corner = static_cast<std::size_t>(4 * textures[2 * v]);
        const auto& at = encodings::corners[idx(encodings::quads[face][corner])];
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_EQ(places[3 * v + k], static_cast<float>(at.at(k)));
        }
      }
    }
  }
}

TEST_F(DressPly, NormalsAreKept) {
  const Glb glb = dressed(folder_.write("scan.ply", PlySubject{.normals = true}.text()));
  const auto normals = glb.values<float>(attributes(glb)["NORMAL"]);
  ASSERT_EQ(normals.size(), 24U);
  for (int v = 0; v < 8; ++v) EXPECT_EQ(normals[idx(3 * v + 2)], 1);
}

TEST_F(DressPly, NothingWhereThereIsNothingToKeep) {
  const fs::path file = folder_.write("scan.ply", PlySubject{}.text());
  EXPECT_FALSE(format_rig_into(file, random_rig(8, 5, "bone ")));
  EXPECT_FALSE(read_materials(file));
}

TEST_F(DressPly, ColoursOfObjVerticesAreKept) {
  std::string obj;
  for (int v = 0; v < 8; ++v) {
    obj += "v " + encodings::spaced(encodings::corners[idx(v)]);
    if (v != 3) obj += " 0.5 " + std::to_string(0.125 * v) + " 1";
    obj += v % 2 == 0 ? " # scanned\n" : "\n";
  }
  for (const auto& quad : encodings::quads) {
    obj += "f";
    for (const int v : quad) obj += " " + std::to_string(v + 1);
    obj += "\n";
  }
  const Glb glb = dressed(folder_.write("scan.obj", obj));
  const auto colours = glb.values<float>(attributes(glb)["COLOR_0"]);
  ASSERT_EQ(colours.size(), 32U);
  for (int v = 0; v < 8; ++v) {
    EXPECT_NEAR(colours[idx(4 * v)], v == 3 ? 1 : light_of(0.5), 1e-6);
    EXPECT_NEAR(colours[idx(4 * v + 1)], v == 3 ? 1 : light_of(0.125 * v), 1e-6);
  }
}

/// "v x y z w": no colour.
TEST_F(DressPly, AFourthCoordinateIsNoColour) {
  const std::string obj =
      "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nv 0 0 1 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  EXPECT_FALSE(format_rig_into(folder_.write("thing.obj", obj), random_rig(4, 5, "bone ")));
}

}  // namespace
}  // namespace curveskel::dress_ply_laws
