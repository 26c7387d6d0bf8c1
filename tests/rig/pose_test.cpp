// Laws of poses: the motions of joints, and the surface that follows them.
#include <curveskel/pose.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "tests/rig/random_rigs.hpp"

namespace curveskel::pose_laws {
namespace {

JointTurns no_turns(const Rig& rig) {
  return JointTurns(rig.names.size(), Eigen::Quaterniond::Identity());
}

JointTurns turns_by_lot(const Rig& rig) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  JointTurns turns = no_turns(rig);
  for (Eigen::Quaterniond& turn : turns) {
    turn = Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized();
  }
  return turns;
}

class Pose : public testing::TestWithParam<int> {
 protected:
  Surface torus = torus_surface();
  Rig rig = random_rig(torus.positions.rows(), GetParam(), "j");
  double nothing = 1e-6;  // weights are floats
};

TEST_P(Pose, NothingTurnedNothingMoves) {
  const auto motions = joint_motions(rig, no_turns(rig));
  EXPECT_TRUE(moved_joints(rig, motions).isApprox(rig.joints));
  EXPECT_LT((moved_surface(torus.positions, rig, motions) - torus.positions).norm(), nothing);
}

TEST_P(Pose, BonesKeepTheirLengths) {
  const Positions moved = moved_joints(rig, joint_motions(rig, turns_by_lot(rig)));
  for (Eigen::Index joint = 0; joint < moved.rows(); ++joint) {
    const int parent = rig.parents[joint];
    if (parent < 0) {
      EXPECT_LT((moved.row(joint) - rig.joints.row(joint)).norm(), 1e-9) << "turns where it is";
      continue;
    }
    EXPECT_NEAR((moved.row(joint) - moved.row(parent)).norm(),
                (rig.joints.row(joint) - rig.joints.row(parent)).norm(), 1e-9);
  }
}

TEST_P(Pose, OneRootTakesAllAlong) {
  JointTurns turns = no_turns(rig);
  turns[0] = Eigen::Quaterniond(Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, 2, 3).normalized()));
  const Positions moved = moved_surface(torus.positions, rig, joint_motions(rig, turns));
  for (Eigen::Index v = 0; v < moved.rows(); ++v) {
    const Eigen::Vector3d from = (torus.positions.row(v) - rig.joints.row(0)).transpose();
    const Eigen::Vector3d to = (moved.row(v) - rig.joints.row(0)).transpose();
    EXPECT_LT((turns[0] * from - to).norm(), nothing * (1 + from.norm()));
  }
}

TEST_P(Pose, AVertexThatNothingMovesStays) {
  rig.weights.row(0) *= 0;
  rig.weights.prune(0.0F);
  const Positions moved =
      moved_surface(torus.positions, rig, joint_motions(rig, turns_by_lot(rig)));
  EXPECT_EQ(moved.row(0), torus.positions.row(0));
}

INSTANTIATE_TEST_SUITE_P(Rigs, Pose, testing::Values(1, 2, 7, 60));

}  // namespace
}  // namespace curveskel::pose_laws
