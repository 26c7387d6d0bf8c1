// A document keeps enough of a file to have it back as it was read.
#include "viewer/model/document.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include <curveskel/advanced/write_file.hpp>
#include <curveskel/error.hpp>
#include "tests/own_folder.hpp"
#include "tests/surface/encodings.hpp"

namespace curveskel::viewer::document_laws {
namespace {

namespace fs = std::filesystem;

TEST(DocumentOf, EveryEncodingHasThePolygonsThatWereRead) {
  const OwnFolder folder;
  bool triangles = false;
  bool polygons = false;
  for (const encodings::Encoding& encoding : encodings::all()) {
    SCOPED_TRACE(encoding.name);
    const fs::path file = folder.path() / (encoding.name + encoding.extension);
    write_file(file, encoding.bytes);
    const PolygonSoup read = read_polygons(file, {});
    const Document document = open_document({file}, {});
    ASSERT_TRUE(document.has_surface());
    const auto kept = document.polygons();
    EXPECT_EQ(kept->positions, read.positions);
    EXPECT_EQ(kept->corners, read.corners);
    EXPECT_EQ(kept->offsets, read.offsets);
    EXPECT_EQ(kept->format, read.format);
    EXPECT_EQ(kept->file, file);
    (document.soup ? polygons : triangles) = true;
  }
  EXPECT_TRUE(triangles) << "kept once";
  EXPECT_TRUE(polygons) << "kept beside their triangles";
}

TEST(DocumentOf, AFileOfAnotherKindSaysWhatItIs) {
  const OwnFolder folder;
  struct Case {
    std::string file;
    std::string content;
    std::string said;
  };
  const std::vector<Case> cases{
      {"a.usda", "#usda 1.0\n(\n", "a USD scene, needed a surface"},
      {"a.bvh", "HIERARCHY\nROOT hips\n{\n", "a BVH motion"},
      {"a.blend", "BLENDER-v304RENDH", "a Blender scene, needed a surface"},
      {"a.swc", "#usda 1.0\n(\n", "a USD scene, needed a skeleton"},
      {"a.xyz", "hello", "no known extension"}};
  for (const Case& foreign : cases) {
    const fs::path file = folder.path() / foreign.file;
    write_file(file, foreign.content);
    try {
      (void)open_document({file}, {});
      FAIL() << foreign.file;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(foreign.said), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace curveskel::viewer::document_laws
