// Laws of the pieces of weights: no joint of ours has an island, and what is none stays as it was.
#include "rig/skin/weight_pieces.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/check_weights.hpp>
#include <curveskel/make_rig.hpp>
#include "meshes/shapes.hpp"
#include "tests/rig/rig_subjects.hpp"

namespace curveskel::weight_pieces_laws {
namespace {

constexpr std::size_t most_joints = 4;

/// A bar along x from -5 to 5: joint 0 moves its first half, joint 1 its second.
struct HalvedBar {
  Surface surface;
  SkinWeights weights;
};

HalvedBar halved_bar() {
  HalvedBar bar{shapes::tube("", shapes::straight(10), shapes::constant(0.5), 16).surface,
                SkinWeights()};
  const Eigen::Index count = bar.surface.positions.rows();
  bar.weights.resize(count, 3);
  for (Eigen::Index v = 0; v < count; ++v) {
    bar.weights.insert(v, bar.surface.positions(v, 0) < 0 ? 0 : 1) = 1;
  }
  bar.weights.makeCompressed();
  return bar;
}

std::vector<Eigen::Index> vertices_beyond(const Surface& surface, double x) {
  std::vector<Eigen::Index> found;
  for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
    if (surface.positions(v, 0) > x) found.push_back(v);
  }
  return found;
}

/// The vertices beyond x have these shares of joints 0, 1 and 2.
SkinWeights with_end(const HalvedBar& bar, double x, const std::vector<float>& shares) {
  SkinWeights weights = bar.weights;
  for (const Eigen::Index v : vertices_beyond(bar.surface, x)) {
    for (int joint = 0; joint < 3; ++joint) weights.coeffRef(v, joint) = shares[idx(joint)];
  }
  weights.prune(0.0F);
  return weights;
}

float difference(const SkinWeights& a, const SkinWeights& b) { return (a - b).norm(); }

TEST(WeightPieces, AreOneForEachJointOfARig) {
  for (const RigSubject& subject : rig_subjects()) {
    for (const double bones : {0.5, 2.0}) {
      for (const double softness : {0.5, 2.0, 20.0}) {
        SCOPED_TRACE(subject.name + ", softness " + std::to_string(softness));
        const Rig rig = make_rig(subject.surface, subject.skeleton,
                                 {{.bone_length = bones}, {.softness = softness}}, {});
        EXPECT_TRUE(check_weights(subject.surface, rig).islands.empty());
      }
    }
  }
}

TEST(WeightPieces, StayWhereThereIsNoIsland) {
  const HalvedBar bar = halved_bar();
  EXPECT_EQ(difference(without_islands(bar.surface, bar.weights, most_joints), bar.weights), 0);
}

TEST(WeightPieces, LeaveAnIslandToTheOtherJointsThere) {
  const HalvedBar bar = halved_bar();
  const SkinWeights with_island = with_end(bar, 4.5, {0.5F, 0.3F, 0.2F});
  const SkinWeights weights = without_islands(bar.surface, with_island, most_joints);
  EXPECT_LT(difference(weights, with_end(bar, 4.5, {0, 0.6F, 0.4F})), 1e-5);
}

TEST(WeightPieces, FillAnIslandThatNothingElseMovesFromAround) {
  const HalvedBar bar = halved_bar();
  const SkinWeights with_island = with_end(bar, 3, {1, 0, 0});
  const SkinWeights weights = without_islands(bar.surface, with_island, most_joints);
  EXPECT_LT(difference(weights, bar.weights), 1e-5);
}

/// The little that a joint has round an island goes with it, so that no edge is torn there.
TEST(WeightPieces, TakeTheSlopesOfAnIslandToo) {
  const HalvedBar bar = halved_bar();
  SkinWeights with_island = with_end(bar, 4, {0.05F, 0.95F, 0});
  for (const Eigen::Index v : vertices_beyond(bar.surface, 4.5)) {
    with_island.coeffRef(v, 0) = 0.5F;
    with_island.coeffRef(v, 1) = 0.5F;
  }
  const SkinWeights weights = without_islands(bar.surface, with_island, most_joints);
  EXPECT_LT(difference(weights, bar.weights), 1e-5);
}

/// A second body that a joint moves as well is no island.
TEST(WeightPieces, OfOtherComponentsStay) {
  const HalvedBar bar = halved_bar();
  const shapes::Shape tube = shapes::tube("", shapes::straight(10), shapes::constant(0.5), 16);
  const shapes::Shape ball = shapes::translated(shapes::ellipsoid({0.2, 0.2, 0.2}, 1), {4, 3, 0});
  const Surface both = shapes::together("", {tube, ball}).surface;
  SkinWeights weights = bar.weights;
  weights.conservativeResize(both.positions.rows(), 3);
  for (Eigen::Index v = bar.weights.rows(); v < weights.rows(); ++v) weights.insert(v, 0) = 1;
  weights.makeCompressed();
  EXPECT_EQ(difference(without_islands(both, weights, most_joints), weights), 0);
}

/// Clothes copy the weights of what lies below them, so that their islands are told apart.
TEST(WeightPieces, OfFollowersAreCountedAsTheirs) {
  const HalvedBar bar = halved_bar();
  Rig rig;
  rig.joints = Positions::Zero(3, 3);
  rig.parents.resize(3);
  for (int joint = 0; joint < 3; ++joint) rig.parents[joint] = joint - 1;
  rig.names = {"first", "second", "third"};
  rig.weights = with_end(bar, 3, {1, 0, 0});
  std::vector<bool> follows(idx(bar.surface.positions.rows()), false);
  ASSERT_EQ(check_weights(bar.surface, rig, follows).islands.size(), 1U);
  EXPECT_FALSE(check_weights(bar.surface, rig, follows).islands[0].follows);
  for (const Eigen::Index v : vertices_beyond(bar.surface, 3)) follows[idx(v)] = true;
  ASSERT_EQ(check_weights(bar.surface, rig, follows).islands.size(), 1U);
  EXPECT_TRUE(check_weights(bar.surface, rig, follows).islands[0].follows);
}

}  // namespace
}  // namespace curveskel::weight_pieces_laws
