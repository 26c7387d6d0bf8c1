// Laws of the checks of weights: each finds what was done wrong, and nothing else.
#include <curveskel/check_weights.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "meshes/shapes.hpp"
#include "rig/measure/turned_joints.hpp"
#include "tests/rig/random_rigs.hpp"

namespace curveskel::check_weights_laws {
namespace {

constexpr int joints = 5;

/// A bar along x from -5 to 5 with joints at -5, -2.5 and so on, each part rigid.
struct Bar {
  Surface surface;
  Rig rig;
};

Bar rigid_bar() {
  Bar bar;
  bar.surface = shapes::tube("", shapes::straight(10), shapes::constant(0.5), 16).surface;
  const double left = bar.surface.positions.col(0).minCoeff();
  bar.rig.joints = Positions::Zero(joints, 3);
  bar.rig.parents.resize(joints);
  for (int joint = 0; joint < joints; ++joint) {
    bar.rig.joints(joint, 0) = left + 2.2 * joint;
    bar.rig.parents[joint] = joint - 1;
    bar.rig.names.push_back("joint");
  }
  bar.rig.weights = SkinWeights(bar.surface.positions.rows(), joints);
  for (Eigen::Index v = 0; v < bar.surface.positions.rows(); ++v) {
    int joint = joints - 1;
    while (joint > 0 && bar.surface.positions(v, 0) < bar.rig.joints(joint, 0)) --joint;
    bar.rig.weights.insert(v, joint) = 1;
  }
  bar.rig.weights.makeCompressed();
  return bar;
}

void set(Rig& rig, Eigen::Index vertex, const std::vector<std::pair<int, float>>& row) {
  for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) it.valueRef() = 0;
  for (const auto& [joint, share] : row) rig.weights.coeffRef(vertex, joint) = share;
}

/// The vertex farthest along x.
Eigen::Index last_vertex(const Bar& bar) {
  Eigen::Index vertex = 0;
  bar.surface.positions.col(0).maxCoeff(&vertex);
  return vertex;
}

/// A joint turns the sum of all that moves with it and with the joints below it.
TEST(TurningShares, AreTheSumsOverAllThatHangsFromAJoint) {
  for (const int count : {1, 7, 40}) {
    const Rig rig = random_rig(60, count, "b");
    Eigen::MatrixXd wanted = Eigen::MatrixXf(rig.weights).cast<double>();
    for (int joint = count - 1; joint > 0; --joint) {
      wanted.col(rig.parents[joint]) += wanted.col(joint);
    }
    EXPECT_LT((Eigen::MatrixXd(turning_shares(rig)) - wanted).cwiseAbs().maxCoeff(), 1e-12);
    TurningShares shares(rig);
    for (int joint = count - 1; joint >= 0; --joint) {  // in any order
      int last = -1;
      Eigen::VectorXd found = Eigen::VectorXd::Zero(60);
      for (const auto& [vertex, share] : shares.of(joint)) {
        EXPECT_LT(last, vertex);
        last = vertex;
        found[vertex] = share;
      }
      EXPECT_LT((found - wanted.col(joint)).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}

TEST(CheckWeights, FindNothingInARigidBar) {
  const Bar bar = rigid_bar();
  const WeightChecks found = check_weights(bar.surface, bar.rig);
  EXPECT_EQ(found.vertices, bar.surface.positions.rows());
  EXPECT_EQ(found.unweighted, 0);
  EXPECT_EQ(found.with_influences[0], found.vertices);
  EXPECT_TRUE(found.idle.empty());
  EXPECT_TRUE(found.islands.empty());
  EXPECT_EQ(found.bleeding, 0);
  ASSERT_EQ(found.poses.size(), idx(joints - 1));
  for (const auto& pose : found.poses) {
    EXPECT_GT(pose.stretch, 1.05) << "rigid parts tear";
    EXPECT_NEAR(pose.volume, 1, 0.05);
  }
}

TEST(CheckWeights, FindVerticesThatNothingMovesAndJointsThatMoveNothing) {
  Bar bar = rigid_bar();
  for (Eigen::Index v = 0; v < bar.rig.weights.rows(); ++v) {
    if (bar.rig.weights.coeff(v, 3) > 0) set(bar.rig, v, {{2, 1.0F}});
  }
  set(bar.rig, 5, {});
  const WeightChecks found = check_weights(bar.surface, bar.rig);
  EXPECT_EQ(found.unweighted, 1);
  EXPECT_EQ(found.idle, std::vector<int>{3});
  set(bar.rig, 5, {{0, 0.25F}, {1, 0.25F}, {2, 0.25F}, {4, 0.25F}});
  EXPECT_EQ(check_weights(bar.surface, bar.rig).with_influences[3], 1);
}

TEST(CheckWeights, FindIslandsButNotWholeComponents) {
  Bar bar = rigid_bar();
  const Eigen::Index far = last_vertex(bar);
  set(bar.rig, far, {{0, 0.3F}, {joints - 1, 0.7F}});
  const WeightChecks found = check_weights(bar.surface, bar.rig);
  ASSERT_EQ(found.islands.size(), 1U);
  EXPECT_EQ(found.islands[0].joint, 0);
  EXPECT_EQ(found.islands[0].vertices, 1);
  // A ball that moves with joint 0 wherever it is.
  const shapes::Shape bar_shape = shapes::tube("", shapes::straight(10), shapes::constant(0.5), 16);
  const shapes::Shape ball = shapes::translated(shapes::ellipsoid({0.2, 0.2, 0.2}, 1), {0, 3, 0});
  const Bar clean = rigid_bar();
  Bar both{shapes::together("", {bar_shape, ball}).surface, clean.rig};
  both.rig.weights.conservativeResize(both.surface.positions.rows(), joints);
  for (Eigen::Index v = clean.surface.positions.rows(); v < both.surface.positions.rows(); ++v) {
    both.rig.weights.coeffRef(v, 0) = 1;
  }
  EXPECT_TRUE(check_weights(both.surface, both.rig).islands.empty());
}

TEST(CheckWeights, FindWhatMovesOverSeveralJoints) {
  Bar bar = rigid_bar();
  const Eigen::Index far = last_vertex(bar);
  set(bar.rig, far, {{joints - 3, 0.2F}, {joints - 1, 0.8F}});
  EXPECT_EQ(check_weights(bar.surface, bar.rig).bleeding, 0) << "two steps";
  set(bar.rig, far, {{joints - 4, 0.2F}, {joints - 1, 0.8F}});
  EXPECT_EQ(check_weights(bar.surface, bar.rig).bleeding, 1) << "three steps";
  set(bar.rig, far, {{joints - 4, 0.04F}, {joints - 1, 0.96F}});
  EXPECT_EQ(check_weights(bar.surface, bar.rig).bleeding, 0) << "hardly anything";
}

/// The softer the bend, the less an edge is stretched; a body that turns as a whole is as it was.
TEST(CheckWeights, SoftBendsStretchLess) {
  Bar bar = rigid_bar();
  double before = 10;
  for (const double width : {0.6, 1.2, 2.0}) {
    for (Eigen::Index v = 0; v < bar.rig.weights.rows(); ++v) {
      const double off = bar.surface.positions(v, 0) - bar.rig.joints(2, 0);
      const auto share = static_cast<float>(std::clamp(0.5 + off / width, 0.0, 1.0));
      set(bar.rig, v, {{1, 1 - share}, {2, share}});
    }
    const WeightChecks found = check_weights(bar.surface, bar.rig);
    ASSERT_EQ(found.poses.size(), 2U);
    EXPECT_EQ(found.poses[0].stretch, 1) << "all of it turns";
    EXPECT_NEAR(found.poses[0].volume, 1, 1e-9);
    EXPECT_LT(found.poses[1].stretch, before) << width;
    EXPECT_LT(found.poses[1].volume, 1) << "linear blend skinning loses volume in a bend";
    before = found.poses[1].stretch;
  }
}

}  // namespace
}  // namespace curveskel::check_weights_laws
