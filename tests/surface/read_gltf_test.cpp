// Laws of reading glTF: what a scene shows is what is read.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/clean.hpp>
#include "tests/own_folder.hpp"
#include "tests/surface/encodings.hpp"
#include "tests/surface/reading.hpp"

namespace curveskel::read_gltf_laws {
namespace {

PolygonSoup read_scene(const OwnFolder& folder, const std::string& scene) {
  return read_polygons(folder.write("scene.gltf", encodings::gltf_embedded(scene)), {});
}

TEST(ReadingGltf, PlacesMeshesByTheirNodes) {
  const OwnFolder folder;
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
  const OwnFolder folder;
  const PolygonSoup soup = read_scene(folder, R"("nodes": [
      {"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}, {"translation": [1, 1, 1]}])");
  EXPECT_EQ(soup.positions.rows(), 16);
  EXPECT_EQ(soup.offsets.size(), 25U);
}

TEST(ReadingGltf, KeepsMirroredMeshesOutward) {
  const OwnFolder folder;
  const PolygonSoup soup = read_scene(folder, R"("nodes": [{"mesh": 0, "scale": [-1, 1, 1]}])");
  const CleanSurface box = clean(soup, {});
  EXPECT_EQ(box.changes.components_turned, 0);
  EXPECT_DOUBLE_EQ(volume(box.surface), 6);
}

TEST(ReadingGltf, LeavesSkinnedMeshesAsModelled) {
  const OwnFolder folder;
  const PolygonSoup soup = read_scene(folder, R"("skins": [{"joints": [1]}], "nodes": [
        {"mesh": 0, "skin": 0, "scale": [7, 7, 7]}, {"translation": [1, 1, 1]}])");
  EXPECT_EQ(outlines(soup), outlines_of_the_box(false));
}

TEST(ReadingGltf, UnrollsStripsAndFans) {
  const OwnFolder folder;
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
  const OwnFolder folder;
  const auto file = folder.write("scene.gltf", encodings::gltf_json(R"("uri": "the%20box.bin", )"));
  EXPECT_NE(refusal(file).find("the box.bin"), std::string::npos);
  (void)folder.write("the box.bin", encodings::gltf_buffer());
  EXPECT_EQ(outlines(read_polygons(file, {})), outlines_of_the_box(false));
}

TEST(ReadingGltf, NeedsNoPictures) {
  const OwnFolder folder;
  const PolygonSoup soup =
      read_scene(folder, encodings::one_node + R"(, "images": [{"uri": "not-there.png"}])");
  EXPECT_EQ(outlines(soup), outlines_of_the_box(false));
}

TEST(ReadingGltf, RefusesWhatItCannotShow) {
  const OwnFolder folder;
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

}  // namespace
}  // namespace curveskel::read_gltf_laws
