// Laws of what is inside written rigs: lengths, matrices, bounds, normals, as glTF 2.0 wants them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/rig_files.hpp>
#include "tests/rig/random_rigs.hpp"
#include "tests/surface/encodings.hpp"

namespace curveskel::rig_gltf_laws {
namespace {

using Json = nlohmann::json;

struct Chunks {
  Json json;
  std::string numbers;
};

std::uint32_t word_at(const std::string& bytes, std::size_t place) {
  std::uint32_t word = 0;
  std::memcpy(&word, &bytes.at(place), sizeof word);
  return word;
}

Chunks chunks_of(const std::string& glb) {
  const std::size_t json_size = word_at(glb, 12);
  const std::size_t numbers = 20 + json_size + 8;
  return {Json::parse(glb.substr(20, json_size)), glb.substr(numbers)};
}

Chunks written_chunks(const Surface& surface, const Rig& rig) {
  return chunks_of(format_rig(surface, rig, RigFormat::glb, "a torus", "a test"));
}

/// `width` single-precision numbers a row.
Eigen::MatrixXf floats_of(const Chunks& chunks, int accessor, Eigen::Index width) {
  const Json& named = chunks.json["accessors"][idx(accessor)];
  const Json& view = chunks.json["bufferViews"][named["bufferView"].get<std::size_t>()];
  Eigen::MatrixXf rows(width, named["count"].get<Eigen::Index>());
  EXPECT_EQ(named["componentType"], 5126);
  EXPECT_EQ(view["byteLength"].get<std::size_t>(), idx(rows.size()) * sizeof(float));
  const std::string bytes = chunks.numbers.substr(view.value("byteOffset", std::size_t{0}),
                                                  view["byteLength"].get<std::size_t>());
  std::memcpy(rows.data(), bytes.data(), bytes.size());
  return rows.transpose();
}

TEST(WrittenGlb, HasTheLengthsThatItsHeadersSay) {
  const Surface surface = torus_surface();
  for (const WrittenCase& one : written_cases()) {
    for (const std::string name : {"t", "to", "tor", "torr"}) {  // of all lengths modulo four
      const Rig rig = random_rig(surface.positions.rows(), one.joints, one.name);
      const std::string glb = format_rig(surface, rig, RigFormat::glb, name, "a test");
      EXPECT_EQ(glb.substr(0, 4), "glTF");
      EXPECT_EQ(word_at(glb, 4), 2U);
      EXPECT_EQ(word_at(glb, 8), glb.size());
      const std::size_t json_size = word_at(glb, 12);
      EXPECT_EQ(json_size % 4, 0U);
      EXPECT_EQ(glb.substr(16, 4), "JSON");
      EXPECT_EQ(word_at(glb, 20 + json_size) % 4, 0U);
      EXPECT_EQ(28 + json_size + word_at(glb, 20 + json_size), glb.size());
      EXPECT_EQ(glb.substr(24 + json_size, 4), std::string("BIN\0", 4));
      const Chunks chunks = chunks_of(glb);
      EXPECT_EQ(chunks.json["buffers"][0]["byteLength"], chunks.numbers.size());
    }
  }
}

TEST(WrittenGltf, HoldsWhatTheGlbHolds) {
  const Surface surface = torus_surface();
  for (const WrittenCase& one : written_cases()) {
    const Rig rig = random_rig(surface.positions.rows(), one.joints, one.name);
    Chunks glb = written_chunks(surface, rig);
    Json gltf = Json::parse(format_rig(surface, rig, RigFormat::gltf, "a torus", "a test"));
    EXPECT_EQ(gltf["buffers"][0]["uri"],
              "data:application/octet-stream;base64," + encodings::base64(glb.numbers));
    gltf["buffers"][0].erase("uri");
    EXPECT_EQ(gltf, glb.json);
  }
}

TEST(WrittenGlb, PutsEachJointWhereItIsInTwoWays) {
  const Surface surface = torus_surface();
  for (const WrittenCase& one : written_cases()) {
    const Rig rig = random_rig(surface.positions.rows(), one.joints, one.name);
    const Chunks chunks = written_chunks(surface, rig);
    const Json& skin = chunks.json["skins"][0];
    ASSERT_EQ(skin["joints"].size(), idx(one.joints));
    const Eigen::MatrixXf binds = floats_of(chunks, skin["inverseBindMatrices"], 16);
    std::map<int, int> above;
    for (std::size_t node = 0; node < chunks.json["nodes"].size(); ++node) {
      for (const int child : chunks.json["nodes"][node].value("children", Json::array())) {
        EXPECT_TRUE(above.emplace(child, static_cast<int>(node)).second) << child;
      }
    }
    for (int joint = 0; joint < one.joints; ++joint) {
      Eigen::Affine3d frame = Eigen::Affine3d::Identity();
      for (int node = skin["joints"][idx(joint)]; above.contains(node); node = above.at(node)) {
        const Json& shift = chunks.json["nodes"][idx(node)]["translation"];
        const Json& turn = chunks.json["nodes"][idx(node)]["rotation"];
        const Eigen::Quaterniond rotation(turn[3], turn[0], turn[1], turn[2]);
        EXPECT_NEAR(rotation.norm(), 1, 1e-12);
        frame = Eigen::Translation3d(shift[0], shift[1], shift[2]) * rotation * frame;
      }
      EXPECT_LT((frame.translation().transpose() - rig.joints.row(joint)).norm(), 1e-9);
      const Eigen::Matrix4f bind = binds.row(joint).reshaped(4, 4);  // by columns
      EXPECT_LT((bind.cast<double>() * frame.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-5);
    }
  }
}

TEST(WrittenGlb, HasBoundsNormalsAndWeightsAsGltfWantsThem) {
  const Surface surface = torus_surface();
  const Rig rig = random_rig(surface.positions.rows(), 300, "joint ");
  const Chunks chunks = written_chunks(surface, rig);
  const Json& attributes = chunks.json["meshes"][0]["primitives"][0]["attributes"];
  const Eigen::MatrixXf positions = floats_of(chunks, attributes["POSITION"], 3);
  const Json& bounds = chunks.json["accessors"][attributes["POSITION"].get<std::size_t>()];
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(bounds["min"][idx(axis)].get<float>(), positions.col(axis).minCoeff());
    EXPECT_EQ(bounds["max"][idx(axis)].get<float>(), positions.col(axis).maxCoeff());
  }
  const Eigen::MatrixXf normals = floats_of(chunks, attributes["NORMAL"], 3);
  EXPECT_LT((normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-6F);
  const Eigen::MatrixXf shares = floats_of(chunks, attributes["WEIGHTS_0"], 4);
  EXPECT_LT((shares.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-6F);
  EXPECT_GE(shares.minCoeff(), 0);
  EXPECT_EQ(chunks.json["asset"]["generator"], "a test");
}

TEST(WrittenGlb, HasOneNormalForVerticesInOnePlace) {
  const Surface whole = torus_surface();
  std::vector<int> first_at(idx(whole.positions.rows()), -1);
  Surface cut{Positions(whole.triangles.size(), 3), Triangles(whole.triangles.rows(), 3)};
  for (Eigen::Index f = 0; f < cut.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      cut.triangles(f, k) = static_cast<int>(3 * f + k);
      int& first = first_at[idx(whole.triangles(f, k))];
      if (first < 0) first = cut.triangles(f, k);
      cut.positions.row(3 * f + k) = whole.positions.row(whole.triangles(f, k));
    }
  }
  const auto normals_of = [](const Surface& surface) {
    const Chunks chunks =
        written_chunks(surface, random_rig(surface.positions.rows(), 3, "joint "));
    return floats_of(chunks, chunks.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"], 3);
  };
  const Eigen::MatrixXf expected = normals_of(whole);
  const Eigen::MatrixXf found = normals_of(cut);
  for (Eigen::Index f = 0; f < cut.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_LT((found.row(3 * f + k) - expected.row(whole.triangles(f, k))).norm(), 0.2F);
      const int first = first_at[idx(whole.triangles(f, k))];
      EXPECT_EQ(found.row(3 * f + k), found.row(first));
    }
  }
}

TEST(WrittenGlb, IsRefusedWhereSinglePrecisionWouldMoveTheVertices) {
  Surface surface = torus_surface();
  const Rig rig = random_rig(surface.positions.rows(), 3, "joint ");
  surface.positions.array() += 1e7;
  EXPECT_THROW((void)format_rig(surface, rig, RigFormat::glb, "far", ""), Error);
  surface.positions = surface.positions.cast<float>().cast<double>().eval();  // nothing to lose
  EXPECT_NO_THROW((void)format_rig(surface, rig, RigFormat::glb, "far", ""));
}

/// A vertex whose faces have no area gets some unit normal all the same.
TEST(WrittenGlb, HasUnitNormalsWhereTheSurfaceHasNone) {
  Surface surface;
  surface.positions.resize(3, 3);
  surface.positions << 0, 0, 0, 1, 0, 0, 2, 0, 0;
  surface.triangles.resize(1, 3);
  surface.triangles << 0, 1, 2;
  const Chunks chunks = written_chunks(surface, random_rig(3, 2, "joint "));
  const Json& attributes = chunks.json["meshes"][0]["primitives"][0]["attributes"];
  const Eigen::MatrixXf normals = floats_of(chunks, attributes["NORMAL"], 3);
  EXPECT_LT((normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-6F);
}

}  // namespace
}  // namespace curveskel::rig_gltf_laws
