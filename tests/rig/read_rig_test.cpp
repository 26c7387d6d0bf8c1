// Laws of reading rigs: the joints and weights of a bar that is known, however the file says them.
#include <curveskel/read_rig.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/rig_files.hpp>
#include "tests/own_folder.hpp"
#include "tests/real_surfaces.hpp"
#include "tests/rig/rigged_bar.hpp"
#include "tests/surface/gltf_by_the_rule.hpp"

namespace curveskel::read_rig_laws {
namespace {

namespace fs = std::filesystem;

class ReadRig : public testing::Test {
 protected:
  [[nodiscard]] std::optional<Rig> read(const RiggedBar& bar) const {
    write_rigged_bar(file(), bar);
    return read_rig(file(), {});
  }
  [[nodiscard]] std::string refusal(const RiggedBar& bar) const {
    try {
      (void)read(bar);
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      return error.what();
    }
    return "";
  }
  [[nodiscard]] fs::path file() const { return folder_.path() / "bar.gltf"; }

 private:
  OwnFolder folder_;
};

void expect_sums_of_one(const SkinWeights& weights) {
  for (Eigen::Index vertex = 0; vertex < weights.rows(); ++vertex) {
    float sum = 0;
    for (SkinWeights::InnerIterator it(weights, vertex); it; ++it) {
      EXPECT_GT(it.value(), 0);
      sum += it.value();
    }
    if (sum != 0) {
      EXPECT_NEAR(sum, 1, 1e-6) << vertex;
    }
  }
}

std::vector<RiggedBar> ways_to_say_it() {
  return {{},
          {.joints = 1},
          {.joints = 2, .children_first = true},
          {.joints = 9, .children_first = true, .helper_nodes = true},
          {.helper_nodes = true},
          {.inverse_bind = false},
          {.helper_nodes = true, .inverse_bind = false},
          {.normalized_bytes = true},
          {.unit = 0.25},
          {.joints = 40, .children_first = true, .normalized_bytes = true}};
}

TEST_F(ReadRig, SameJointsAndWeightsHoweverTheFileSaysThem) {
  int way = 0;
  for (const RiggedBar& bar : ways_to_say_it()) {
    SCOPED_TRACE(way++);
    const auto rig = read(bar);
    ASSERT_TRUE(rig);
    ASSERT_EQ(rig->joints.rows(), bar.joints);
    ASSERT_EQ(rig->names.size(), static_cast<std::size_t>(bar.joints));
    for (int joint = 0; joint < bar.joints; ++joint) {
      EXPECT_EQ(rig->names[static_cast<std::size_t>(joint)], "joint " + std::to_string(joint));
      EXPECT_EQ(rig->parents[joint], joint - 1);
      EXPECT_LT((rig->joints.row(joint) - Eigen::RowVector3d(joint, 0, 0)).norm(), 1e-5);
    }
    const Positions positions = read_polygons(file(), {}).positions;
    ASSERT_EQ(rig->weights.rows(), positions.rows());
    ASSERT_EQ(rig->weights.cols(), bar.joints);
    expect_sums_of_one(rig->weights);
    for (int vertex = 0; vertex < positions.rows(); ++vertex) {
      for (int joint = 0; joint < bar.joints; ++joint) {
        const double reach = std::abs(positions(vertex, 0) - joint);
        const bool end = vertex < 4 || vertex >= positions.rows() - 4;
        const double expected = reach > 0.75 ? 0 : end ? 1 : 0.5;
        EXPECT_NEAR(rig->weights.coeff(vertex, joint), expected, 0.003) << vertex << ' ' << joint;
      }
    }
  }
}

TEST_F(ReadRig, JointsWithoutANameGetOne) {
  auto bar = nlohmann::json::parse(gltf_of({.joints = 3}));
  for (auto& node : bar["nodes"]) {
    if (node["name"] != "joint 2") node.erase("name");
  }
  bar["nodes"][3]["name"] = "joint_2";
  write_file(file(), bar.dump());
  const std::vector<std::string> names{"joint_1", "joint_2_2", "joint_2"};
  EXPECT_EQ(read_rig(file(), {})->names, names);
  EXPECT_EQ(read_joints(file(), {}).names, names);
  // Blender finds the bone that moves a vertex by its name.
  const fs::path kept = file().parent_path() / "kept.fbx";
  const auto edited =
      format_rig_into(file(), *read_rig(file()), {RigFormat::fbx, OldRig::kept, "rig", "test"});
  write_file(kept, edited->bytes);
  EXPECT_EQ(read_joints(kept, {}).names, names);
}

TEST_F(ReadRig, VerticesThatNothingMovesHaveEmptyRows) {
  const auto rig = read({.first_weight = 0});
  ASSERT_TRUE(rig);
  EXPECT_EQ(rig->weights.row(0).nonZeros(), 0);
  EXPECT_EQ(rig->weights.row(1).nonZeros(), 1);
}

TEST_F(ReadRig, NothingWhereThereIsNoSkin) {
  write_file(file(), encodings::gltf_embedded());
  EXPECT_FALSE(read_rig(file(), {}));
  write_file(file(), encodings::obj());
  EXPECT_FALSE(read_rig(file(), {}));
}

TEST_F(ReadRig, WhatIsWrongIsNamed) {
  EXPECT_NE(refusal({.first_weight = -1}).find("weight -1.0"), std::string::npos);
  EXPECT_NE(refusal({.joints = 4, .first_joint = 4}).find("the skin's 4 joints"),
            std::string::npos);
  EXPECT_NE(refusal({.matrix_scale = 0}).find("not affine"), std::string::npos);
}

/// A joint lies where its node is, and what it alone moves stays with it.
TEST_F(ReadRig, PosedJointsAreWhereTheSceneHasThem) {
  for (const double turn : {0.2, -1.0}) {
    const auto rig = read({.joints = 6, .helper_nodes = true, .turn = turn});
    ASSERT_TRUE(rig);
    const auto moves = GltfByTheRule(file()).moves_of_joints();
    for (int joint = 0; joint < 6; ++joint) {
      const Eigen::Vector4d bound(joint, 0, 0, 1);
      const Eigen::Vector4d posed = moves.at("joint " + std::to_string(joint)) * bound;
      EXPECT_LT((rig->joints.row(joint).transpose() - posed.head<3>()).norm(), 1e-5) << joint;
      if (joint > 1) {
        EXPECT_GT((posed - bound).norm(), 0.05);  // the bar is bent
      }
    }
  }
}

TEST_F(ReadRig, RiggedMeshesHaveTheJointsOfTheirIndex) {
  const fs::path folder = real_surface_folders().back() / "rigs";
  int rigs = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.path().string().ends_with(".joints.json")) continue;
    const auto truth = nlohmann::json::parse(std::ifstream(entry.path()));
    const std::string original = truth["original"];
    if (!original.ends_with(".glb") && !original.ends_with(".gltf")) continue;
    SCOPED_TRACE(original);
    ++rigs;
    const auto rig = read_rig(folder / original, {});
    ASSERT_TRUE(rig);
    expect_sums_of_one(rig->weights);
    EXPECT_EQ(rig->weights.rows(), read_polygons(folder / original, {}).positions.rows());
    const double size =
        (rig->joints.colwise().maxCoeff() - rig->joints.colwise().minCoeff()).norm();
    std::map<std::string, int> joint_of_name;
    for (int joint = 0; joint < rig->joints.rows(); ++joint) {
      EXPECT_LT(rig->parents[joint], joint);
      joint_of_name[rig->names[static_cast<std::size_t>(joint)]] = joint;
    }
    const auto& joints = truth["joints"];
    const auto moves = GltfByTheRule(folder / original).moves_of_joints();
    ASSERT_EQ(joints.size(), joint_of_name.size());
    for (const auto& joint : joints) {
      const int found = joint_of_name.at(joint["name"]);
      const auto& at = joint["position"];
      const Eigen::Vector4d bound(at[0], at[1], at[2], 1);  // the index has the bind pose
      const Eigen::Vector4d posed = moves.at(joint["name"]) * bound;
      EXPECT_LT((rig->joints.row(found).transpose() - posed.head<3>()).norm(), 1e-4 * size);
      const int parent = joint["parent"];
      const std::string above = parent < 0 ? "" : joints[static_cast<std::size_t>(parent)]["name"];
      const int own = rig->parents[found];
      EXPECT_EQ(own < 0 ? "" : rig->names[static_cast<std::size_t>(own)], above);
    }
  }
  EXPECT_EQ(rigs, collection_folder() ? 4 : 1);
}

}  // namespace
}  // namespace curveskel::read_rig_laws
