// Laws of reading: one box in every encoding, variants of the formats, real files.
#include <curveskel/read.hpp>

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/clean.hpp>
#include "surface/read/formats.hpp"
#include "surface/read/utf16.hpp"
#include "tests/own_folder.hpp"
#include "tests/real_surfaces.hpp"
#include "tests/surface/encodings.hpp"
#include "tests/surface/gltf_by_the_rule.hpp"
#include "tests/surface/reading.hpp"
#include "tests/surface/scene_encodings.hpp"
#include "tests/surface/vtk_encodings.hpp"
#include "tests/surface/zip_encodings.hpp"

namespace curveskel::read_laws {
namespace {

using encodings::Encoding;
using namespace std::string_literals;

std::filesystem::path write_zipped(const OwnFolder& folder, const std::string& name,
                                   const std::string& bytes) {
  const gzFile file = gzopen((folder.path() / name).c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  return folder.path() / name;
}

// ---- Every encoding -----------------------------------------------------------------------------

std::vector<Encoding> every_encoding() {
  std::vector<Encoding> result = encodings::all();
  for (Encoding& encoding : encodings::all_of_vtk()) result.push_back(std::move(encoding));
  for (Encoding& encoding : encodings::all_of_3mf()) result.push_back(std::move(encoding));
  for (Encoding& encoding : encodings::all_of_scenes()) result.push_back(std::move(encoding));
  return result;
}

class EveryEncoding : public testing::TestWithParam<Encoding> {};

TEST_P(EveryEncoding, GivesTheSamePolygons) {
  const OwnFolder folder;
  const PolygonSoup soup =
      read_polygons(folder.write("box" + GetParam().extension, GetParam().bytes), {});
  EXPECT_EQ(outlines(soup), outlines_of_the_box(GetParam().is_quads));
}

TEST_P(EveryEncoding, GivesTheSamePolygonsWhenGzipped) {
  const OwnFolder folder;
  const PolygonSoup soup = read_polygons(
      write_zipped(folder, "box" + GetParam().extension + ".gz", GetParam().bytes), {});
  EXPECT_EQ(outlines(soup), outlines_of_the_box(GetParam().is_quads));
}

TEST_P(EveryEncoding, IsABoxOfVolumeSixWhenCleaned) {
  const OwnFolder folder;
  const CleanSurface box =
      clean(read_polygons(folder.write("box" + GetParam().extension, GetParam().bytes), {}), {});
  EXPECT_EQ(box.surface.positions.rows(), 8);
  EXPECT_EQ(box.surface.triangles.rows(), 12);
  EXPECT_DOUBLE_EQ(volume(box.surface), 6);
}

/// Reads what may be broken: anything but a surface or an input error fails the test.
void read_anything(const FileBytes& file) {
  try {
    const PolygonSoup soup = read_content(file, {});
    EXPECT_TRUE(soup.positions.allFinite());
    EXPECT_EQ(soup.offsets.front(), 0);
    EXPECT_EQ(soup.offsets.back(), static_cast<std::int64_t>(soup.corners.size()));
    EXPECT_TRUE(std::is_sorted(soup.offsets.begin(), soup.offsets.end()));
    for (const std::int32_t corner : soup.corners) {
      ASSERT_GE(corner, 0);
      ASSERT_LT(corner, soup.positions.rows());
    }
    (void)clean(soup, {});
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input) << error.what();
  }
}

TEST_P(EveryEncoding, CutOffAnywhereIsReadOrRefused) {
  const std::string& bytes = GetParam().bytes;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    read_anything({"cut" + GetParam().extension, bytes.substr(0, size)});
  }
}

TEST_P(EveryEncoding, WithWrongBytesIsReadOrRefused) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    std::string bytes = GetParam().bytes;
    for (int wrong = 0; wrong <= i % 3; ++wrong) {
      bytes[random() % bytes.size()] =
          i % 2 == 0 ? static_cast<char>(random() % 256) : "0123456789-\n #/."[random() % 16];
    }
    read_anything({"wrong" + GetParam().extension, bytes});
  }
}

INSTANTIATE_TEST_SUITE_P(Box, EveryEncoding, testing::ValuesIn(every_encoding()),
                         [](const auto& test) { return test.param.name; });

TEST(Reading, OfACountedFormatCutOffAnywhereIsRefused) {
  for (const Encoding& encoding : every_encoding()) {
    if (encoding.name.find("obj") == 0) continue;
    // The comment or colour behind the last face may be missing; so may everything behind a solid.
    const std::string& bytes = encoding.bytes;
    std::size_t whole = bytes.find_last_not_of(" \r\n") + 1;
    if (encoding.name == "off_colours" || encoding.name == "off_more_behind_vertices") {
      whole = bytes.rfind(" 3 ");
    }
    if (encoding.name == "off_normals") whole = bytes.rfind(" # c");
    if (encoding.extension == ".vtk") {
      whole = bytes.find_last_not_of(
                  " \n", std::min(bytes.find("POINT_DATA"), bytes.find("point_data")) - 1) +
              1;
    }
    if (encoding.name == "stl_text" || encoding.name == "stl_on_one_line" ||
        encoding.name == "stl_commented") {
      whole = bytes.find("endsolid") + 8;
    }
    if (encoding.name.find("stl_binary_count") == 0) continue;  // a whole facet may be cut off
    for (std::size_t size = 0; size < whole; ++size) {
      const FileBytes file{"cut" + encoding.extension, encoding.bytes.substr(0, size)};
      EXPECT_NE(refusal_of([&] { return read_content(file, {}); }), "")
          << encoding.name << " after " << size << " bytes";
    }
  }
}

// ---- Variants -----------------------------------------------------------------------------------

TEST(Reading, TakesTriangleStripsOfPlyWithRestarts) {
  const OwnFolder folder;
  const auto file = folder.write("strips.ply",
                                 "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\n"
                                 "property float y\nproperty float z\nelement tristrips 2\n"
                                 "property list int int vertex_indices\nend_header\n"
                                 "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n"
                                 "8 0 1 2 3 -1 2 3 4\n3 4 3 2\n");
  const PolygonSoup soup = read_polygons(file, {});
  EXPECT_EQ(soup.corners, (std::vector<std::int32_t>{0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 2}));
  EXPECT_EQ(soup.offsets, (std::vector<std::int64_t>{0, 3, 6, 9, 12}));
}

TEST(Reading, TakesStripsOfVtkLikeItsPolygons) {
  const OwnFolder folder;
  const auto triangles_of = [&](const std::string& name, const std::string& bytes) {
    return outlines(read_polygons(folder.write(name, bytes), {}));
  };
  for (const std::string format : {"ascii", "raw"}) {
    const Outlines strips = triangles_of("strips.vtp", encodings::vtp({.format = format}, true));
    ASSERT_EQ(strips.size(), 12U);
    const CleanSurface box =
        clean(read_polygons(folder.write("strips.vtp", encodings::vtp({.format = format}, true))));
    EXPECT_DOUBLE_EQ(volume(box.surface), 6);
  }
  EXPECT_EQ(triangles_of("strips.vtk",
                         "# vtk DataFile Version 3.0\nstrips\nASCII\nDATASET POLYDATA\n"
                         "POINTS 5 double\n0 0 0 1 0 0 0 1 0 1 1 0 0 2 0\n"
                         "TRIANGLE_STRIPS 2 9\n4 0 1 2 3\n3 2 3 4\n"),
            triangles_of("polygons.obj",
                         "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 2 0\n"
                         "f 1 2 3\nf 3 2 4\nf 3 4 5\n"));
}

TEST(Reading, TakesFacesOfObjBeforeTheirVertices) {
  const OwnFolder folder;
  const PolygonSoup soup =
      read_polygons(folder.write("early.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"), {});
  EXPECT_EQ(soup.corners, (std::vector<std::int32_t>{0, 1, 2}));
}

TEST(Reading, KeepsEveryDigitOfADouble) {
  const OwnFolder folder;
  const PolygonSoup soup = read_polygons(
      folder.write("digits.obj",
                   "v 0.1 -1e-300 12345678901234567890\nv 4.9e-324 1.7976931348623157e308"
                   " 0.30000000000000004\nv 0 0 0\nf 1 2 3\n"),
      {});
  EXPECT_EQ(soup.positions(0, 0), 0.1);
  EXPECT_EQ(soup.positions(0, 1), -1e-300);
  EXPECT_EQ(soup.positions(0, 2), 12345678901234567890.0);
  EXPECT_EQ(soup.positions(1, 0), 4.9e-324);
  EXPECT_EQ(soup.positions(1, 1), 1.7976931348623157e308);
  EXPECT_EQ(soup.positions(1, 2), 0.30000000000000004);
}

TEST(Reading, TakesSeveralGzipMembersAsOneFile) {
  const OwnFolder folder;
  const std::string bytes = encodings::obj();
  const auto slurp = [](const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream bytes_of;
    bytes_of << stream.rdbuf();
    return bytes_of.str();
  };
  const std::string first = slurp(write_zipped(folder, "first.gz", bytes.substr(0, 40)));
  const std::string second = slurp(write_zipped(folder, "second.gz", bytes.substr(40)));
  const PolygonSoup soup = read_polygons(folder.write("box.obj.gz", first + second), {});
  EXPECT_EQ(outlines(soup), outlines_of_the_box(true));
}

TEST(Reading, TakesEveryCharacterOfUtf16) {
  // U+00E9, U+20AC and U+1F600, the last of which takes two units; then half of one.
  FileBytes file{"names.obj", "\xff\xfe#\0\xe9\0\xac\x20\x3d\xd8\x00\xde\x3d\xd8\n\0"s};
  ASSERT_TRUE(is_utf16(file.content));
  utf16_to_utf8(file);
  EXPECT_EQ(file.content, "#\u00e9\u20ac\U0001F600\uFFFD\n");
}

TEST(Reading, OfAnStlWhoseCountIsTooSmallIsSaid) {
  const OwnFolder folder;
  std::string said;
  Monitor monitor;
  monitor.note = [&](std::string_view text) { said += text; };
  (void)read_polygons(folder.write("box.stl", encodings::stl_binary("a box", 6)), monitor);
  EXPECT_NE(said.find("announces 6 facets and has 12"), std::string::npos) << said;
}

TEST(Reading, StopsWhenAsked) {
  const OwnFolder folder;
  std::stop_source source;
  source.request_stop();
  Monitor monitor;
  monitor.stop = source.get_token();
  EXPECT_THROW((void)read_polygons(folder.write("box.obj", encodings::obj()), monitor), Cancelled);
}

// ---- Vertices without a place ------------------------------------------------------------------

void replace_all(std::string& bytes, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = bytes.find(from, at)) != std::string::npos; at += to.size()) {
    bytes.replace(at, from.size(), to);
  }
}

template <typename Number>
std::string in_binary(Number x, Number y, Number z, bool big_endian) {
  std::string bytes;
  for (const Number number : {x, y, z}) encodings::append(bytes, number, big_endian);
  return bytes;
}

/// The file with y of the corner (1, 2, 3) made NaN, wherever it stands plainly.
std::string with_nan(const Encoding& encoding) {
  std::string bytes = encoding.bytes;
  replace_all(bytes, "solid vertex 1 2 3", "solid");
  for (const auto& [from, to] : {std::pair{" 1 2 3", " 1 nan 3"}, std::pair{"\n1 2 3", "\n1 nan 3"},
                                 std::pair{",1,2,3", ",1,nan,3"},
                                 std::pair{" 1.000000 2.000000 3", " 1.000000 -nan(ind) 3"}}) {
    replace_all(bytes, from, to);
  }
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (const bool big_endian : {false, true}) {
    replace_all(bytes, in_binary(1.0F, 2.0F, 3.0F, big_endian),
                in_binary(1.0F, nan, 3.0F, big_endian));
    replace_all(bytes, in_binary(1.0, 2.0, 3.0, big_endian),
                in_binary(1.0, static_cast<double>(nan), 3.0, big_endian));
  }
  return bytes;
}

TEST(Reading, LeavesOutPolygonsOfVerticesWithoutAPlaceInEveryFormat) {
  std::set<std::string> formats;
  for (const Encoding& encoding : every_encoding()) {
    const std::string bytes = with_nan(encoding);
    if (bytes == encoding.bytes || encoding.name == "obj_with_everything") continue;
    SCOPED_TRACE(encoding.name);
    const PolygonSoup soup = read_content({"box" + encoding.extension, bytes}, {});
    Outlines wanted = outlines_of_the_box(encoding.is_quads);
    const std::size_t all = wanted.size();
    std::erase_if(wanted, [](const auto& polygon) {
      return std::find(polygon.begin(), polygon.end(), std::array<double, 3>{1, 2, 3}) !=
             polygon.end();
    });
    EXPECT_EQ(outlines(soup), wanted);
    EXPECT_GE(soup.unplaced_vertices, 1);
    EXPECT_EQ(soup.unplaced_polygons, all - wanted.size());
    EXPECT_TRUE(soup.positions.allFinite());
    formats.insert(encoding.extension);
  }
  for (const std::string format :
       {".obj", ".off", ".ply", ".stl", ".glb", ".vtp", ".vtk", ".dae", ".fbx"}) {
    EXPECT_TRUE(formats.contains(format)) << format;
  }
}

TEST(Reading, KnowsNoNumberInAnyProgramsSpelling) {
  for (const std::string word : {"nan", "NaN", "-nan", "-nan(ind)", "inf", "-inf", "INF",
                                 "infinity", "1.#QNAN", "-1.#IND", "1.#INF00", "1e999"}) {
    std::string bytes = encodings::obj();
    replace_all(bytes, "v 1 2 3", "v 1 2 " + word);
    const PolygonSoup soup = read_content({"box.obj", bytes}, {});
    EXPECT_EQ(soup.unplaced_vertices, 1) << word;
    EXPECT_EQ(soup.unplaced_polygons, 3) << word;
  }
}

TEST(Reading, RefusesAFileThatWouldLoseMoreFacesThanStay) {
  std::string bytes = encodings::obj();
  replace_all(bytes, "v 1 2 3", "v 1 2 nan");
  replace_all(bytes, "v 0 0 0", "v 0 0 nan");
  const std::string message = refusal_of([&] { return read_content({"box.obj", bytes}, {}); });
  EXPECT_NE(message.find("2 of 8 vertices"), std::string::npos) << message;
  EXPECT_NE(message.find("6 of 6 faces"), std::string::npos) << message;
}

/// Games have levels of this name, which begin with a count: 123 of something is no glTF.
TEST(Reading, CallsOtherDataByTheNameOfTheFileWhateverItsFirstByte) {
  for (int first = 0; first < 256; ++first) {
    const std::string bytes = static_cast<char>(first) + "\0\0\0t\1\0\0wall\0\x8f\xc4\3"s;
    const std::string message = refusal_of([&] { return read_content({"level.ply", bytes}, {}); });
    EXPECT_NE(message.find("needed \"ply\""), std::string::npos) << first << ": " << message;
  }
}

// ---- Real files ---------------------------------------------------------------------------------

TEST(RealSurfaces, BrokenOnesAreRefused) {
  for (const auto& file : present_among({"defects/badindex-too-large.off",
                                         "defects/badindex-zero.obj",
                                         "defects/comments-only.obj",
                                         "defects/empty.obj",
                                         "defects/empty.off",
                                         "defects/empty.ply",
                                         "defects/empty.stl",
                                         "defects/garbage.ply",
                                         "defects/header-lies-huge-count.off",
                                         "defects/header-lies-huge-count.ply",
                                         "defects/header-only-0-0.off",
                                         "defects/negative-index.off",
                                         "defects/not-numbers.off",
                                         "defects/one-vertex.obj",
                                         "defects/pointcloud-crab-14k.ply",
                                         "defects/truncated-ascii.off",
                                         "defects/truncated-binary.ply",
                                         "defects/truncated-binary.stl",
                                         "defects/truncated.glb",
                                         "defects/wrong-extension.obj"})) {
    const std::string name = real_surface(file)->filename().string();
    EXPECT_NE(refusal(*real_surface(file)).find(name), std::string::npos) << name;
  }
}

/// The meshes have the pose in which the rigs were bound.
TEST(RealSurfaces, GltfRigsAreTheirWeldedMeshes) {
  for (const auto& [scene, mesh] :
       {std::pair{"CesiumMan.gltf", "cesium-man-2k.ply"},
        std::pair{"quaternius-horse-1k.glb", "quaternius-horse-1k.ply"},
        std::pair{"quaternius-trex-1k.glb", "quaternius-trex-1k.ply"}}) {
    if (!collection_folder() && !real_surface("rigs/" + std::string(scene))) continue;
    const auto path = [](const std::string& name) { return real_surface("rigs/" + name).value(); };
    const auto rounded = [](const auto& p) {
      return std::array<float, 3>{static_cast<float>(p(0)), static_cast<float>(p(1)),
                                  static_cast<float>(p(2))};
    };
    const CleanSurface welded = clean(read_polygons(path(scene), {}), {});
    std::vector<std::array<float, 3>> bound(
        static_cast<std::size_t>(welded.surface.positions.rows()));
    const auto vertices = GltfByTheRule(path(scene)).vertices();
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const int vertex = welded.vertex_of_input[static_cast<Eigen::Index>(v)];
      if (vertex >= 0) bound[static_cast<std::size_t>(vertex)] = rounded(vertices[v].modelled);
    }
    std::vector<std::array<float, 3>> expected;
    const CleanSurface truth = clean(read_polygons(path(mesh), {}), {});
    for (const auto& p : truth.surface.positions.rowwise()) expected.push_back(rounded(p));
    std::sort(bound.begin(), bound.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(bound, expected) << scene;
  }
}

}  // namespace
}  // namespace curveskel::read_laws
