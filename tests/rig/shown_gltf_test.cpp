// Laws of rigs put into glTF files that rest in another pose than their old joints were bound in,
// as these files are shown.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/write_file.hpp>
#include <curveskel/read.hpp>
#include <curveskel/rig_files.hpp>
#include "meshes/shapes.hpp"
#include "tests/glb.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/edit_subjects.hpp"
#include "tests/rig/rig_subjects.hpp"
#include "tests/surface/gltf_by_the_rule.hpp"

namespace curveskel::shown_gltf_laws {
namespace {

namespace fs = std::filesystem;
using Vertices = std::vector<GltfByTheRule::Vertex>;

std::vector<EditCase> posed_cases() {
  std::vector<EditCase> cases{
      {.name = "plain"},
      {.name = "cm", .nested = true, .cm = true},
      {.name = "quantised", .quantised = true},
      {.name = "interleaved", .nested = true, .interleaved = true, .morphed = true},
      {.name = "shaded", .nested = true, .shaded = true},
      {.name = "all",
       .text = true,
       .nested = true,
       .morphed = true,
       .instanced = true,
       .rich = true,
       .shaded = true,
       .loose = true}};
  for (EditCase& one : cases) {
    one.old_rig = 4;
    one.old_turn = 0.4;
  }
  return cases;
}

class ShownGltf : public testing::Test {
 protected:
  [[nodiscard]] static std::string edited(const fs::path& file, bool as_bound) {
    const auto rows = read_polygons(file, {}, {as_bound}).positions.rows();
    const EditOptions options{RigFormat::glb, OldRig::replaced, "holder rig", "a test", {},
                              as_bound};
    return format_rig_into(file, random_rig(rows, 9, "bone "), options)->bytes;
  }

  OwnFolder folder_;
};

void expect_alike(const Vertices& before, const Vertices& after, double size) {
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t v = 0; v < before.size(); ++v) {
    EXPECT_LT((before[v].placed - after[v].placed).norm(), 2e-6 * size) << v;
    EXPECT_LT((before[v].normal - after[v].normal).norm(), 1e-5) << v;
    EXPECT_LT((before[v].tangent - after[v].tangent).norm(), 1e-5) << v;
  }
}

/// By the standard's rule; `weights` of morph targets, if they are not the file's own.
Vertices vertices_of(const fs::path& file, const std::vector<double>& weights = {}) {
  return GltfByTheRule(file, weights).vertices();
}

TEST_F(ShownGltf, PlacesNormalsAndTangentsAreThoseThatWereShown) {
  for (const EditCase& one : posed_cases()) {
    SCOPED_TRACE(one.name);
    const EditSubject subject(folder_.path(), one);
    const fs::path after = folder_.write("after.glb", edited(subject.path(), false));
    const PolygonSoup shown = read_polygons(subject.path());
    const PolygonSoup found = read_polygons(after);
    EXPECT_TRUE(shown.posed);
    EXPECT_FALSE(found.posed);
    EXPECT_EQ(found.corners, shown.corners);
    const double size = bounding_box_diagonal(shown.positions);
    EXPECT_LT((found.positions - shown.positions).rowwise().norm().maxCoeff(), 2e-6 * size);
    expect_alike(vertices_of(subject.path()), vertices_of(after), size);
    if (!one.morphed) continue;
    for (const std::vector<double>& weights : {std::vector{0.0, 0.0}, std::vector{1.0, 0.7}}) {
      expect_alike(vertices_of(subject.path(), weights), vertices_of(after, weights), size);
    }
  }
}

TEST_F(ShownGltf, KeepsTheBytesAndAllAttributesButThese) {
  for (const EditCase& one : posed_cases()) {
    SCOPED_TRACE(one.name);
    const EditSubject subject(folder_.path(), one);
    const Glb after = glb_of(edited(subject.path(), false));
    for (const std::string& buffer : subject.buffers()) {
      EXPECT_NE(after.numbers.find(buffer), std::string::npos);
    }
    for (std::size_t mesh = 0; mesh < subject.json()["meshes"].size(); ++mesh) {
      const auto& before = subject.json()["meshes"][mesh]["primitives"];
      for (std::size_t k = 0; k < before.size(); ++k) {
        for (const auto& [name, accessor] : before[k]["attributes"].items()) {
          if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) continue;
          const bool is_bent =
              mesh == 0 && (name == "POSITION" || name == "NORMAL" || name == "TANGENT");
          const auto& found = after.json["meshes"][mesh]["primitives"][k]["attributes"][name];
          EXPECT_EQ(found == accessor, !is_bent) << mesh << " " << name;
        }
      }
    }
  }
}

/// A primitive without vertices beside those of the bent mesh, and a vertex without a place.
TEST_F(ShownGltf, BoundsAreOfThePlacesThatThereAre) {
  const EditSubject subject(folder_.path(), posed_cases().front());
  Glb glb{subject.json(), subject.buffers()[0]};
  glb.numbers.resize((glb.numbers.size() + 3) / 4 * 4);
  auto& primitives = glb.json["meshes"][0]["primitives"];
  const std::size_t places = primitives[0]["attributes"]["POSITION"];
  const std::size_t view = glb.json["accessors"][places]["bufferView"];
  const std::size_t begin = glb.json["bufferViews"][view]["byteOffset"];
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&glb.numbers[begin], &nothing, sizeof nothing);
  auto none = glb.json["accessors"][places];
  none["count"] = 0;
  none.erase("min");
  none.erase("max");
  glb.json["accessors"].push_back(none);
  primitives.push_back({{"attributes", {{"POSITION", glb.json["accessors"].size() - 1}}}});
  const fs::path file = folder_.write("none.glb", bytes_of(glb));
  const Glb after = glb_of(edited(file, false));
  const std::size_t written = after.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
  EXPECT_NE(written, places);
  for (const char* bound : {"min", "max"}) {
    for (const auto& number : after.json["accessors"][written][bound]) {
      EXPECT_TRUE(number.is_number()) << number;
    }
  }
}

/// The two halves of the torus go on sharing their vertices.
TEST_F(ShownGltf, SharedVerticesAreWrittenOnce) {
  for (const EditCase& one : posed_cases()) {
    const EditSubject subject(folder_.path(), one);
    const auto primitives = glb_of(edited(subject.path(), false)).json["meshes"][0]["primitives"];
    EXPECT_EQ(primitives[0]["attributes"], primitives[1]["attributes"]) << one.name;
    EXPECT_EQ(primitives[0].value("targets", nlohmann::json()),
              primitives[1].value("targets", nlohmann::json()))
        << one.name;
  }
}

// A robot's hands were T-posed as bound, and its arms, which hang from the same joints, were not.
TEST_F(ShownGltf, MeshesThatHangFromJointsGoWithThemAsBound) {
  EditCase posed = posed_cases().front();
  EditCase rested = posed;
  rested.name = "rested";
  rested.old_turn = 0;
  const auto as_bound = [&](const EditCase& one) {
    const EditSubject subject(folder_.path(), one);
    return read_polygons(subject.path(), {}, {true}).positions;
  };
  const Positions bent = as_bound(posed);
  const Positions straight = as_bound(rested);
  ASSERT_EQ(bent.rows(), straight.rows());
  const Eigen::Matrix3d turn =  // of the topmost joint, about the origin
      Eigen::AngleAxisd(posed.old_turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Index ring = shapes::torus(1, 0.4, 8).surface.positions.rows();
  const Eigen::Index body = bent.rows() - 2 * ring;  // then the ring beside it, then the sword
  const Positions turned = straight * turn.transpose();
  EXPECT_LT((bent.topRows(body) - turned.topRows(body)).norm(), 1e-5);
  EXPECT_LT((bent.bottomRows(ring) - turned.bottomRows(ring)).norm(), 1e-5);
  EXPECT_EQ(bent.middleRows(body, ring), straight.middleRows(body, ring));
}

TEST_F(ShownGltf, FilesThatRestAsBoundComeOutTheSame) {
  for (const EditCase& one : edit_cases()) {
    if (one.old_turn != 0) continue;
    const EditSubject subject(folder_.path(), one);
    EXPECT_EQ(edited(subject.path(), false), edited(subject.path(), true)) << one.name;
  }
}

}  // namespace
}  // namespace curveskel::shown_gltf_laws
