// Laws of reading glTF: what a scene shows is what is read.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/read_rig.hpp>
#include "tests/own_folder.hpp"
#include "tests/real_surfaces.hpp"
#include "tests/rig/rigged_bar.hpp"
#include "tests/surface/encodings.hpp"
#include "tests/surface/gltf_by_the_rule.hpp"
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

TEST(ReadingGltf, LeavesASkinnedMeshWithoutWeightsAsModelled) {
  const OwnFolder folder;
  const PolygonSoup soup = read_scene(folder, R"("skins": [{"joints": [1]}], "nodes": [
        {"mesh": 0, "skin": 0, "scale": [7, 7, 7]}, {"translation": [1, 1, 1]}])");
  EXPECT_EQ(outlines(soup), outlines_of_the_box(false));
}

/// Vertex by vertex; those that no joint moves are left out.
void expect_placed_by_the_rule(const std::filesystem::path& file, double tolerance) {
  const Positions read = read_polygons(file, {}).positions;
  const auto expected = GltfByTheRule(file).vertices();
  ASSERT_EQ(static_cast<std::size_t>(read.rows()), expected.size());
  const double size = bounding_box_diagonal(read);
  for (std::size_t v = 0; v < expected.size(); ++v) {
    if (!expected[v].is_weighted) continue;
    const Eigen::Vector3d found = read.row(static_cast<Eigen::Index>(v)).transpose();
    ASSERT_LT((found - expected[v].placed).norm(), tolerance * size) << v;
  }
}

TEST(ReadingGltf, PlacesSkinnedMeshesByTheRuleInTheirRestPose) {
  const OwnFolder folder;
  for (const RiggedBar& bar : std::vector<RiggedBar>{{.turn = 0.3},
                                                     {.helper_nodes = true, .turn = -0.7},
                                                     {.inverse_bind = false, .turn = 0.2},
                                                     {.normalized_bytes = true, .turn = 0.5},
                                                     {.unit = 0.25, .turn = 1.1},
                                                     {.first_weight = 0, .turn = 0.3},
                                                     {.joints = 40, .turn = 0.05}}) {
    const auto file = folder.write("bar.gltf", gltf_of(bar));
    expect_placed_by_the_rule(file, 1e-5);
    RiggedBar straight = bar;
    straight.turn = 0;
    const auto bound = folder.write("straight.gltf", gltf_of(straight));
    const Positions moved = read_polygons(file, {}).positions - read_polygons(bound, {}).positions;
    EXPECT_GT(moved.rowwise().norm().maxCoeff(), 0.1);
  }
}

TEST(ReadingGltf, KeepsASkinThatRestsAsBoundBitByBit) {
  const OwnFolder folder;
  const auto file = folder.write("bar.gltf", gltf_of({.joints = 9}));
  const Positions positions = read_polygons(file, {}).positions;
  const auto expected = GltfByTheRule(file).vertices();
  for (std::size_t v = 0; v < expected.size(); ++v) {
    EXPECT_EQ(positions.row(static_cast<Eigen::Index>(v)).transpose(), expected[v].modelled);
  }
}

/// The bar twice, the second time with weights that are bytes: 128 and 127 of 255 for halves.
nlohmann::json bar_of_two_sides(double turn) {
  auto file = nlohmann::json::parse(gltf_of({.joints = 4, .turn = turn}));
  auto& primitives = file["meshes"][0]["primitives"];
  auto other = primitives[0];
  std::string shares;
  for (int v = 0; v < 20; ++v) {
    const bool end = v < 4 || v >= 16;
    shares += end ? std::string("\xff\0\0\0", 4) : std::string("\x80\x7f\0\0", 4);
  }
  file["buffers"].push_back(
      {{"byteLength", shares.size()},
       {"uri", "data:application/octet-stream;base64," + encodings::base64(shares)}});
  file["bufferViews"].push_back({{"buffer", 1}, {"byteLength", shares.size()}});
  file["accessors"].push_back({{"bufferView", file["bufferViews"].size() - 1},
                               {"componentType", 5121},
                               {"normalized", true},
                               {"count", 20},
                               {"type", "VEC4"}});
  other["attributes"]["WEIGHTS_0"] = file["accessors"].size() - 1;
  primitives.push_back(other);
  return file;
}

TEST(ReadingGltf, KeepsTheSidesOfSeamsTogether) {
  const OwnFolder folder;
  const auto gaps = [](const auto& place) {
    double widest = 0;
    for (int v = 0; v < 20; ++v) widest = std::max(widest, (place(v) - place(v + 20)).norm());
    return widest;
  };
  for (const double turn : {0.05, -0.03, 2.0}) {
    const auto path = folder.write("seam.gltf", bar_of_two_sides(turn).dump());
    const auto rule = GltfByTheRule(path).vertices();
    const Positions read = read_polygons(path, {}).positions;
    ASSERT_EQ(read.rows(), 40);
    const double by_rule = gaps([&](int v) { return rule[static_cast<std::size_t>(v)].placed; });
    EXPECT_GT(by_rule, 1e-5);
    const double found = gaps([&](int v) { return Eigen::Vector3d(read.row(v).transpose()); });
    if (turn < 1) {
      EXPECT_EQ(found, 0);
    } else {
      EXPECT_NEAR(found, by_rule, 1e-3 * by_rule);  // too wide for a rounding: left as it is
    }
  }
}

TEST(ReadingGltf, PlacesAllScenesOfTheCollectionByTheRule) {
  int scenes = 0;
  int skinned = 0;
  for (const auto& folder : real_surface_folders()) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      const std::string path = entry.path().string();
      if (!path.ends_with(".glb") && !path.ends_with(".gltf")) continue;
      if (path.find("/defects/") != std::string::npos) continue;
      SCOPED_TRACE(path);
      const GltfByTheRule rule(path);
      if (!rule.is_plain()) continue;
      expect_placed_by_the_rule(path, 1e-4);
      ++scenes;
      if (read_rig(path, {})) ++skinned;
    }
  }
  EXPECT_GE(scenes, collection_folder() ? 20 : 1);
  EXPECT_GE(skinned, collection_folder() ? 15 : 1);
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
