#include "surface/read.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "surface/clean.hpp"
#include "surface/formats.hpp"
#include "surface/measures.hpp"
#include "tests/surface/encodings.hpp"

namespace curveskel::read_laws {
namespace {

using encodings::Encoding;

/// A folder of its own for each test, gone with it.
class Folder {
 public:
  Folder() {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '.');
    path_ = std::filesystem::path(testing::TempDir()) /
            ("curveskel-" + std::to_string(::getpid()) + "-" + name);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path write(const std::string& name,
                                            const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }
  [[nodiscard]] std::filesystem::path write_zipped(const std::string& name,
                                                   const std::string& bytes) const {
    const gzFile file = gzopen((path_ / name).c_str(), "wb");
    gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(file);
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// The message of the Error(Fault::input) that reading throws; fails the test if there is none.
template <typename Read>
std::string refusal_of(const Read& read) {
  try {
    const PolygonSoup soup = read();
    ADD_FAILURE() << soup.file << " was read: " << soup.positions.rows() << " vertices, "
                  << soup.offsets.size() - 1 << " polygons";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "";
}

std::string refusal(const std::filesystem::path& file) {
  return refusal_of([&] { return read_polygons(file, {}); });
}

/// Each polygon as the positions of its corners, which no numbering of vertices changes.
std::vector<std::vector<std::array<double, 3>>> outlines(const PolygonSoup& soup) {
  std::vector<std::vector<std::array<double, 3>>> result;
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    result.emplace_back();
    for (auto i = soup.offsets[p]; i < soup.offsets[p + 1]; ++i) {
      const auto position = soup.positions.row(soup.corners[static_cast<std::size_t>(i)]);
      result.back().push_back({position.x(), position.y(), position.z()});
    }
  }
  return result;
}

std::vector<std::vector<std::array<double, 3>>> outlines_of_the_box(bool as_quads) {
  std::vector<std::vector<std::array<double, 3>>> result;
  const auto add = [&](const auto& polygon) {
    result.emplace_back();
    for (const int v : polygon) {
      const auto& p = encodings::corners[static_cast<std::size_t>(v)];
      result.back().push_back(
          {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    }
  };
  if (as_quads) {
    for (const auto& quad : encodings::quads) add(quad);
  } else {
    for (const auto& triangle : encodings::triangles()) add(triangle);
  }
  return result;
}

// ---- Every encoding -----------------------------------------------------------------------------

class EveryEncoding : public testing::TestWithParam<Encoding> {};

TEST_P(EveryEncoding, GivesTheSamePolygons) {
  const Folder folder;
  const PolygonSoup soup =
      read_polygons(folder.write("box" + GetParam().extension, GetParam().bytes), {});
  EXPECT_EQ(outlines(soup), outlines_of_the_box(GetParam().is_quads));
}

TEST_P(EveryEncoding, GivesTheSamePolygonsWhenGzipped) {
  const Folder folder;
  const PolygonSoup soup = read_polygons(
      folder.write_zipped("box" + GetParam().extension + ".gz", GetParam().bytes), {});
  EXPECT_EQ(outlines(soup), outlines_of_the_box(GetParam().is_quads));
}

TEST_P(EveryEncoding, IsABoxOfVolumeSixWhenCleaned) {
  const Folder folder;
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

INSTANTIATE_TEST_SUITE_P(Box, EveryEncoding, testing::ValuesIn(encodings::all()),
                         [](const auto& test) { return test.param.name; });

TEST(Reading, OfACountedFormatCutOffAnywhereIsRefused) {
  for (const Encoding& encoding : encodings::all()) {
    if (encoding.name.find("obj") == 0) continue;
    // The comment or colour behind the last face may be missing; so may everything behind a solid.
    const std::string& bytes = encoding.bytes;
    std::size_t whole = bytes.find_last_not_of(" \r\n") + 1;
    if (encoding.name == "off_colours") whole = bytes.rfind(" 3 ");
    if (encoding.name == "off_normals") whole = bytes.rfind(" # c");
    if (encoding.name == "stl_text") whole = bytes.find("endsolid") + 8;
    for (std::size_t size = 0; size < whole; ++size) {
      const FileBytes file{"cut" + encoding.extension, encoding.bytes.substr(0, size)};
      EXPECT_NE(refusal_of([&] { return read_content(file, {}); }), "")
          << encoding.name << " after " << size << " bytes";
    }
  }
}

// ---- Variants -----------------------------------------------------------------------------------

TEST(Reading, TakesTriangleStripsOfPlyWithRestarts) {
  const Folder folder;
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

TEST(Reading, TakesFacesOfObjBeforeTheirVertices) {
  const Folder folder;
  const PolygonSoup soup =
      read_polygons(folder.write("early.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"), {});
  EXPECT_EQ(soup.corners, (std::vector<std::int32_t>{0, 1, 2}));
}

TEST(Reading, KeepsEveryDigitOfADouble) {
  const Folder folder;
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
  const Folder folder;
  const std::string bytes = encodings::obj();
  const auto slurp = [](const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream bytes_of;
    bytes_of << stream.rdbuf();
    return bytes_of.str();
  };
  const std::string first = slurp(folder.write_zipped("first.gz", bytes.substr(0, 40)));
  const std::string second = slurp(folder.write_zipped("second.gz", bytes.substr(40)));
  const PolygonSoup soup = read_polygons(folder.write("box.obj.gz", first + second), {});
  EXPECT_EQ(outlines(soup), outlines_of_the_box(true));
}

TEST(Reading, StopsWhenAsked) {
  const Folder folder;
  std::stop_source source;
  source.request_stop();
  Monitor monitor;
  monitor.stop = source.get_token();
  EXPECT_THROW((void)read_polygons(folder.write("box.obj", encodings::obj()), monitor), Cancelled);
}

// ---- glTF ---------------------------------------------------------------------------------------

PolygonSoup read_scene(const Folder& folder, const std::string& scene) {
  return read_polygons(folder.write("scene.gltf", encodings::gltf_embedded(scene)), {});
}

TEST(ReadingGltf, PlacesMeshesByTheirNodes) {
  const Folder folder;
  // Child: scaled by 2, turned by 90 degrees round z, moved by (1, 2, 3). Parent: moved by 10 in x.
  const PolygonSoup soup = read_scene(folder, R"("scenes": [{"nodes": [1]}], "nodes": [
        {"mesh": 0, "scale": [2, 2, 2], "rotation": [0, 0, 0.70710678118654757, 0.70710678118654757],
         "translation": [1, 2, 3]},
        {"children": [0], "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 10,0,0,1]}])");
  ASSERT_EQ(soup.positions.rows(), 8);
  for (Eigen::Index v = 0; v < 8; ++v) {
    const auto& p = encodings::corners[static_cast<std::size_t>(v)];
    EXPECT_NEAR(soup.positions(v, 0), 11 - 2 * p[1], 1e-12);
    EXPECT_NEAR(soup.positions(v, 1), 2 + 2 * p[0], 1e-12);
    EXPECT_NEAR(soup.positions(v, 2), 3 + 2 * p[2], 1e-12);
  }
}

TEST(ReadingGltf, ShowsAMeshAtEveryNodeThatHasIt) {
  const Folder folder;
  const PolygonSoup soup = read_scene(folder, R"("nodes": [
      {"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}, {"translation": [1, 1, 1]}])");
  EXPECT_EQ(soup.positions.rows(), 16);
  EXPECT_EQ(soup.offsets.size(), 25U);
}

TEST(ReadingGltf, KeepsMirroredMeshesOutward) {
  const Folder folder;
  const PolygonSoup soup = read_scene(folder, R"("nodes": [{"mesh": 0, "scale": [-1, 1, 1]}])");
  const CleanSurface box = clean(soup, {});
  EXPECT_EQ(box.changes.components_turned, 0);
  EXPECT_DOUBLE_EQ(volume(box.surface), 6);
}

TEST(ReadingGltf, LeavesSkinnedMeshesAsModelled) {
  const Folder folder;
  const PolygonSoup soup = read_scene(folder, R"("skins": [{"joints": [1]}], "nodes": [
        {"mesh": 0, "skin": 0, "scale": [7, 7, 7]}, {"translation": [1, 1, 1]}])");
  EXPECT_EQ(outlines(soup), outlines_of_the_box(false));
}

TEST(ReadingGltf, UnrollsStripsAndFans) {
  const Folder folder;
  const std::string uri = R"("uri": "data:application/octet-stream;base64,)" +
                          encodings::base64(encodings::gltf_buffer()) + R"(", )";
  const auto corners = [&](const std::string& mode) {
    const std::string json = encodings::gltf_json(uri, encodings::one_node, R"("mode": )" + mode);
    return read_polygons(folder.write("mode" + mode + ".gltf", json), {}).corners;
  };
  EXPECT_EQ(corners("5"),
            (std::vector<std::int32_t>{0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4, 4, 5, 6, 5, 7, 6}));
  EXPECT_EQ(corners("6"),
            (std::vector<std::int32_t>{1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 6, 0, 6, 7, 0}));
}

TEST(ReadingGltf, FindsTheBufferBesideTheFile) {
  const Folder folder;
  const auto file = folder.write("scene.gltf", encodings::gltf_json(R"("uri": "the%20box.bin", )"));
  EXPECT_NE(refusal(file).find("the box.bin"), std::string::npos);
  (void)folder.write("the box.bin", encodings::gltf_buffer());
  EXPECT_EQ(outlines(read_polygons(file, {})), outlines_of_the_box(false));
}

TEST(ReadingGltf, NeedsNoPictures) {
  const Folder folder;
  const PolygonSoup soup =
      read_scene(folder, encodings::one_node + R"(, "images": [{"uri": "not-there.png"}])");
  EXPECT_EQ(outlines(soup), outlines_of_the_box(false));
}

TEST(ReadingGltf, RefusesWhatItCannotShow) {
  const Folder folder;
  const auto message = [&](const std::string& scene) {
    return refusal(folder.write("bad.gltf", encodings::gltf_embedded(scene)));
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  contains(message(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "children": [0]}])"),
           "node 0 twice");
  contains(message(R"("scenes": [{"nodes": [4]}], "nodes": [{"mesh": 0}])"), "node 4");
  contains(message(R"("nodes": [{"mesh": 3}])"), "mesh 3");
  contains(message(R"("nodes": [{"mesh": 0, "matrix": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])"),
           "node 0 that is not affine");
  contains(message(encodings::one_node + R"(, "extensionsUsed": ["KHR_draco_mesh_compression"],
                     "extensionsRequired": ["KHR_draco_mesh_compression"])"),
           "KHR_draco_mesh_compression");
}

// ---- What is refused, and how -------------------------------------------------------------------

struct Broken {
  std::string name;
  std::string file;
  std::string bytes;
  std::vector<std::string> said;  ///< parts of the message

  friend void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }
};

std::string ply_header(const std::string& vertices, const std::string& faces,
                       const std::string& encoding = "ascii") {
  return "ply\nformat " + encoding + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::vector<Broken> broken_files() {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  return {
      {"empty", "a.obj", "", {"0 bytes"}},
      {"obj_index_zero",
       "a.obj",
       three + "f 0 1 2\n",
       {"line 4", "\"0\"", "counts vertices from 1"}},
      {"obj_index_too_large",
       "a.obj",
       three + "f 1 2 3\nf 1 2 4\n",
       {"line 5", "vertex 4", "at most 3"}},
      {"obj_index_too_negative", "a.obj", three + "f -1 -2 -4\n", {"line 4", "\"-4\""}},
      {"obj_index_word", "a.obj", three + "f 1 2 x\n", {"line 4", "\"x\"", "a vertex index"}},
      {"obj_index_glued", "a.obj", three + "f 1 2 3x\n", {"line 4", "\"x\"", "a vertex index"}},
      {"obj_two_coordinates",
       "a.obj",
       "v 0 0\nv 1 0 0\n",
       {"line 1", "the end of the line", "z coordinate"}},
      {"obj_decimal_comma", "a.obj", "v 0,5 0 0\n", {"line 1", "\"0,5\"", "x coordinate"}},
      {"obj_nan", "a.obj", three + "v 0 nan 0\nf 1 2 4\n", {"line 4", "\"nan\"", "finite"}},
      {"obj_too_large", "a.obj", "v 0 1e999 0\n", {"line 1", "\"1e999\"", "finite"}},
      {"obj_points", "a.obj", three, {"point cloud", "3 vertices"}},
      {"off_words",
       "a.off",
       "OFF\n3 1 0\n0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n",
       {"line 3", "\"zero\"", "z coordinate"}},
      {"off_index",
       "a.off",
       "OFF\n3 1 0\n" + points + "3 0 1 3\n",
       {"line 6", "\"3\"", "from 0 to 2"}},
      {"off_truncated",
       "a.off",
       "OFF\n3 4 0\n" + points + "3 0 1 2\n# one of four\n",
       {"the end of the file after 1", "4 faces"}},
      {"off_counts",
       "a.off",
       "OFF\n2000000000 2000000000 0\n0 0 0\n",
       {"line 2", "2000000000 vertices", "6 bytes"}},
      {"off_corners",
       "a.off",
       "OFF\n3 1 0\n" + points + "999999999 0 1 2\n",
       {"line 6", "\"999999999\"", "number of corners"}},
      {"off_negative_counts", "a.off", "OFF\n-3 1 0\n" + points, {"line 2", "-3 vertices"}},
      {"off_in_four_dimensions", "a.off", "4OFF\n3 1 0\n", {"line 1", "three dimensions"}},
      {"off_in_five_dimensions", "a.off", "nOFF 5\n3 1 0\n", {"line 1", "three dimensions"}},
      {"off_binary", "a.off", "OFF BINARY\n", {"line 1", "binary OFF"}},
      {"off_of_other_content", "a.off", "hello\n", {"line 1", "\"hello\"", "\"OFF\""}},
      {"off_inf",
       "a.off",
       "OFF\n3 1 0\n0 0 -inf\n1 0 0\n0 1 0\n3 0 1 2\n",
       {"line 3", "\"-inf\"", "finite"}},
      {"ply_magic", "a.ply", "plx\n", {"line 1", "\"plx\"", "\"ply\""}},
      {"ply_header_ends",
       "a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\n",
       {"end_header", "truncated"}},
      {"ply_type",
       "a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty flaot x\nend_header\n",
       {"line 4", "\"flaot\"", "a type"}},
      {"ply_format",
       "a.ply",
       "ply\nformat binary 1.0\nend_header\n",
       {"line 2", "\"binary\"", "binary_little_endian"}},
      {"ply_keyword",
       "a.ply",
       "ply\nformat ascii 1.0\nelment vertex 3\nend_header\n",
       {"line 3", "\"elment\""}},
      {"ply_without_z",
       "a.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 "
       "0\n",
       {"\"z\""}},
      {"ply_counts",
       "a.ply",
       ply_header("4000000000", "1", "binary_little_endian") + points,
       {"4000000000 rows", "\"vertex\""}},
      {"ply_ascii_counts",
       "a.ply",
       ply_header("3", "4000000000") + points,
       {"4000000000 rows", "\"face\""}},
      {"ply_negative_count", "a.ply", ply_header("-1", "1"), {"line 3", "\"-1\""}},
      {"ply_word",
       "a.ply",
       ply_header("3", "1") + "0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n",
       {"line 11", "\"zero\""}},
      {"ply_index",
       "a.ply",
       ply_header("3", "1") + points + "3 0 1 3\n",
       {"line 13", "vertex index 3", "0 to 2"}},
      {"ply_nan",
       "a.ply",
       ply_header("3", "1") + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n",
       {"line 11", "nan", "finite"}},
      {"ply_binary_nan",
       "a.ply",
       ply_header("1", "0", "binary_little_endian") + std::string(8, '\0') +
           std::string("\0\0\xC0\x7F", 4),
       {"NaN", "row 0", "\"z\"", "finite"}},
      {"ply_points", "a.ply", ply_header("3", "0") + points, {"point cloud", "3 vertices"}},
      {"stl_truncated",
       "a.stl",
       encodings::stl_binary("x").substr(0, 300),
       {"12 facets", "300 bytes", "684 bytes"}},
      {"stl_short", "a.stl", "nothing", {"7 bytes"}},
      {"stl_text_truncated",
       "a.stl",
       encodings::stl_text().substr(0, encodings::stl_text().find("    endloop")),
       {"the end of the file", "endfacet"}},
      {"stl_without_end",
       "a.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
       "0\nendloop\nendfacet\n",
       {"endsolid"}},
      {"stl_two_vertices",
       "a.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 "
       "0\nendloop\nendfacet\nendsolid\n",
       {"line 7", "2 vertices"}},
      {"stl_word",
       "a.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertx 0 0 0\n",
       {"line 4", "\"vertx\""}},
      {"stl_nan",
       "a.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 nan 0\n",
       {"line 4", "\"nan\"", "finite"}},
      {"stl_vertex_without_facet",
       "a.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
       "endloop\nendfacet\nvertex 0 0 0\nendsolid\n",
       {"line 9", "\"vertex\"", "\"facet\" before"}},
      {"stl_facet_in_facet",
       "a.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendsolid\n",
       {"line 6", "\"endsolid\"", "\"endfacet\" first"}},
      {"glb_truncated", "a.glb", encodings::glb().substr(0, 500), {"chunk", "truncated"}},
      {"glb_short", "a.glb", "glTF", {"glTF"}},
      {"gltf_without_version", "a.gltf", "{}", {"glTF"}},
      {"gltf_no_json", "a.gltf", "{\"asset\": ", {"glTF"}},
      {"gltf_short_buffer",
       "a.gltf",
       encodings::gltf_json(R"("uri": "data:application/octet-stream;base64,AAAA", )"),
       {"glTF"}},
      {"gltf_endless_buffer", "a.gltf", encodings::gltf_json(R"("uri": "/dev/zero", )"), {"glTF"}},
      {"gltf_deep",
       "a.gltf",
       R"({"asset": {"version": "2.0", "extras": )" + std::string(100000, '[') +
           std::string(100000, ']') + "}}",
       {"nested 100002 deep"}},
      {"gltf_nothing", "a.gltf", R"({"asset": {"version": "2.0"}})", {"0 vertices"}},
      {"unknown", "a.xyz", "hello", {"\"hello\"", "obj, off, ply, stl, gltf, glb"}},
      {"gzip_truncated",
       "a.obj.gz",
       std::string("\x1f\x8b\x08\0\0\0\0\0\0\x03\x4b", 11),
       {"a.obj.gz"}},
      {"gzip_garbage",
       "a.obj.gz",
       std::string("\x1f\x8b\x08\0\0\0\0\0\0\x03", 10) + "garbage garbage",
       {"a.obj.gz"}},
  };
}

class BrokenFile : public testing::TestWithParam<Broken> {};

TEST_P(BrokenFile, IsRefusedByNameAndPlace) {
  const Folder folder;
  const std::string message = refusal(folder.write(GetParam().file, GetParam().bytes));
  EXPECT_NE(message.find(GetParam().file), std::string::npos) << message;
  for (const std::string& part : GetParam().said) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
  }
}

INSTANTIATE_TEST_SUITE_P(All, BrokenFile, testing::ValuesIn(broken_files()),
                         [](const auto& test) { return test.param.name; });

TEST(Reading, RefusesWhatIsNoReadableFile) {
  const Folder folder;
  EXPECT_NE(refusal(folder.path() / "missing.obj").find("No such file"), std::string::npos);
  EXPECT_NE(refusal(folder.path()).find("a directory"), std::string::npos);
}

TEST(Reading, RefusesAFileThatMayNotBeRead) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may read everything";
  const Folder folder;
  const auto file = folder.write("secret.obj", encodings::obj());
  ::chmod(file.c_str(), 0);
  EXPECT_NE(refusal(file).find("Permission denied"), std::string::npos);
}

// ---- Real files ---------------------------------------------------------------------------------

class SharedMeshes : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << "no folder " << folder_;
  }
  std::filesystem::path folder_ = CURVESKEL_SHARED_MESHES;
};

TEST_F(SharedMeshes, BrokenOnesAreRefused) {
  for (const char* name : {"badindex-too-large.off",
                           "badindex-zero.obj",
                           "comments-only.obj",
                           "empty.obj",
                           "empty.off",
                           "empty.ply",
                           "empty.stl",
                           "garbage.ply",
                           "header-lies-huge-count.off",
                           "header-lies-huge-count.ply",
                           "header-only-0-0.off",
                           "inf-coordinate.off",
                           "nan-coordinates.obj",
                           "nan-coordinates.ply",
                           "negative-index.off",
                           "not-numbers.off",
                           "one-vertex.obj",
                           "pointcloud-crab-14k.ply",
                           "truncated-ascii.off",
                           "truncated-binary.ply",
                           "truncated-binary.stl",
                           "truncated.glb",
                           "wrong-extension.obj"}) {
    EXPECT_NE(refusal(folder_ / "defects" / name).find(name), std::string::npos) << name;
  }
}

TEST_F(SharedMeshes, GltfRigsAreTheirWeldedMeshes) {
  for (const auto& [scene, mesh] :
       {std::pair{"CesiumMan.gltf", "cesium-man-2k.ply"},
        std::pair{"quaternius-horse-1k.glb", "quaternius-horse-1k.ply"},
        std::pair{"quaternius-trex-1k.glb", "quaternius-trex-1k.ply"}}) {
    const auto positions = [&](const char* name) {
      const CleanSurface result = clean(read_polygons(folder_ / "rigs" / name, {}), {});
      std::vector<std::array<float, 3>> points;
      for (const auto& p : result.surface.positions.rowwise()) {
        points.push_back(
            {static_cast<float>(p(0)), static_cast<float>(p(1)), static_cast<float>(p(2))});
      }
      std::sort(points.begin(), points.end());
      return points;
    };
    EXPECT_EQ(positions(scene), positions(mesh)) << scene;
  }
}

}  // namespace
}  // namespace curveskel::read_laws
