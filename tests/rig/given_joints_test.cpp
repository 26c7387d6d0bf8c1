// Laws of weights for joints that somebody else has placed.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/make_rig.hpp>
#include "tests/rig/rig_subjects.hpp"

namespace curveskel::given_joints_laws {
namespace {

/// Halves of the sums of absolute differences, 0..1, in the mean over the vertices.
float mean_difference(const SkinWeights& a, const SkinWeights& b) {
  return 0.5F * Eigen::MatrixXf(a - b).cwiseAbs().rowwise().sum().mean();
}

TEST(GivenJoints, HaveRowsOfOneToFourThatSumToOne) {
  for (const RigSubject& s : rig_subjects()) {
    SCOPED_TRACE(s.name);
    const Rig given = make_rig(s.surface, s.skeleton);
    const Rig rig = weights_on_joints(s.surface, s.skeleton, given);
    EXPECT_EQ(rig.joints, given.joints);
    EXPECT_EQ(rig.parents, given.parents);
    EXPECT_EQ(rig.names, given.names);
    for (Eigen::Index v = 0; v < rig.weights.rows(); ++v) {
      const auto count = rig.weights.row(v).nonZeros();
      EXPECT_TRUE(count >= 1 && count <= 4);
      EXPECT_NEAR(rig.weights.row(v).sum(), 1, 1e-5F);
    }
  }
}

/// Joints that the program has placed itself are moved by much the same parts of the surface.
TEST(GivenJoints, OfTheProgramHaveMuchTheSameWeights) {
  for (const RigSubject& s : rig_subjects()) {
    SCOPED_TRACE(s.name);
    const Rig own = make_rig(s.surface, s.skeleton);
    const Rig rig = weights_on_joints(s.surface, s.skeleton, own);
    EXPECT_LT(mean_difference(rig.weights, own.weights), 0.1F);
    for (std::size_t joint = 0; joint < own.names.size(); ++joint) {
      if (own.names[joint].find("_end") == std::string::npos) continue;
      EXPECT_EQ(rig.weights.col(static_cast<Eigen::Index>(joint)).sum(), 0) << own.names[joint];
    }
  }
}

/// A root on the ground, far from the hips, moves nothing of its own.
TEST(GivenJoints, ARootOutsideOfTheBodyMovesNothing) {
  for (const RigSubject& s : rig_subjects()) {
    SCOPED_TRACE(s.name);
    const Rig own = make_rig(s.surface, s.skeleton);
    const Eigen::Index count = own.joints.rows();
    Rig given;
    given.joints.resize(count + 1, 3);
    given.joints.row(0) = own.joints.row(0);
    given.joints(0, 1) -= 5 * bounding_box_diagonal(s.surface.positions);
    given.joints.bottomRows(count) = own.joints;
    given.parents.resize(count + 1);
    given.parents[0] = -1;
    given.parents.tail(count) = own.parents.array() + 1;
    given.names = {"ground"};
    given.names.insert(given.names.end(), own.names.begin(), own.names.end());
    const Rig rig = weights_on_joints(s.surface, s.skeleton, given);
    EXPECT_EQ(Eigen::MatrixXf(rig.weights).col(0).maxCoeff(), 0);
    const SkinWeights rest = rig.weights.rightCols(count);
    const Rig without = weights_on_joints(s.surface, s.skeleton, own);
    EXPECT_LT(mean_difference(rest, without.weights), 1e-5F);
  }
}

/// A straight tube along x, from 0 to 10, of radius 1, and joints in it, each the child of the one
/// before.
struct JointedTube {
  Surface surface;
  CurveSkeleton axis;
  Rig given;
};
JointedTube tube_with(const std::vector<Eigen::RowVector3d>& joints) {
  const shapes::Shape tube = shapes::translated(
      shapes::tube("", shapes::straight(10), shapes::constant(1), 16), {5, 0, 0});
  JointedTube made{tube.surface, tube.axis, {}};
  const auto count = static_cast<Eigen::Index>(joints.size());
  made.given.joints.resize(count, 3);
  made.given.parents.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    made.given.joints.row(k) = joints[static_cast<std::size_t>(k)];
    made.given.parents[k] = static_cast<int>(k) - 1;
  }
  made.given.names.assign(joints.size(), "");
  return made;
}

/// The least share of the joint among the vertices with x from `from` to `to`.
float least_share(const JointedTube& tube, const Rig& rig, int joint, double from, double to) {
  float least = 1;
  for (Eigen::Index v = 0; v < rig.weights.rows(); ++v) {
    const double x = tube.surface.positions(v, 0);
    if (x >= from && x <= to) least = std::min(least, rig.weights.coeff(v, joint));
  }
  return least;
}

/// A hand without fingers, a head.
TEST(GivenJoints, TheLastOneMovesWhatLiesAhead) {
  const JointedTube tube = tube_with({{0.5, 0, 0}, {4, 0, 0}, {7, 0, 0}});
  const Rig rig = weights_on_joints(tube.surface, tube.axis, tube.given);
  EXPECT_GT(least_share(tube, rig, 0, 0, 2.5), 0.95F);
  EXPECT_GT(least_share(tube, rig, 1, 5.3, 5.7), 0.85F);
  EXPECT_GT(least_share(tube, rig, 2, 8.5, 10), 0.95F);
}

/// As ends of chains are in most files.
TEST(GivenJoints, TheLastOneMovesNothingOutsideOfTheSurface) {
  const JointedTube tube = tube_with({{0.5, 0, 0}, {5, 0, 0}, {11.5, 0, 0}});
  const Rig rig = weights_on_joints(tube.surface, tube.axis, tube.given);
  EXPECT_EQ(Eigen::MatrixXf(rig.weights).col(2).maxCoeff(), 0);
  EXPECT_GT(least_share(tube, rig, 1, 7, 10), 0.95F);
}

/// As of a fin or a toe, whose bones lie beneath it.
TEST(GivenJoints, ABoneThatLeavesTheSurfaceHoldsWhatSeesIt) {
  const JointedTube tube = tube_with({{0.5, 0, 0}, {5, 0, 0}, {9, 2.7, 0}});
  const Rig rig = weights_on_joints(tube.surface, tube.axis, tube.given);
  EXPECT_GT(least_share(tube, rig, 1, 8, 10), 0.8F);
}

/// A body with all its joints, and one that has none.
TEST(GivenJoints, MoveABodyThatHasNone) {
  const JointedTube tube = tube_with({{0.5, 0, 0}, {5, 0, 0}});
  const shapes::Shape ball = shapes::translated(
      shapes::tube("", shapes::straight(2), shapes::constant(0.5), 12), {9, 4, 0});
  const shapes::Shape first = shapes::translated(
      shapes::tube("", shapes::straight(10), shapes::constant(1), 16), {5, 0, 0});
  const Surface both = shapes::together("", {first, ball}).surface;
  CurveSkeleton curve = tube.axis;
  const auto count = static_cast<int>(curve.nodes.rows());
  curve.nodes.conservativeResize(count + 2, 3);
  curve.nodes.bottomRows(2) << 8.5, 4, 0, 9.5, 4, 0;
  curve.radii.conservativeResize(count + 2);
  curve.radii.tail(2).setConstant(0.5);
  curve.edges.conservativeResize(curve.edges.rows() + 1, 2);
  curve.edges.bottomRows(1) << count, count + 1;
  const Rig rig = weights_on_joints(both, curve, tube.given);
  for (Eigen::Index v = 0; v < rig.weights.rows(); ++v) {
    EXPECT_NEAR(rig.weights.row(v).sum(), 1, 1e-5F);
    if (both.positions(v, 1) > 2) {
      EXPECT_EQ(rig.weights.coeff(v, 1), 1);
    }
  }
}

TEST(GivenJoints, GoAlongWithTheSurface) {
  const RigSubject& s = rig_subjects().front();
  const Rig given = make_rig(s.surface, s.skeleton);
  const Rig rig = weights_on_joints(s.surface, s.skeleton, given);
  Surface larger = s.surface;
  larger.positions *= 7;
  CurveSkeleton skeleton = scaled_curve(s.skeleton, 7);
  Rig larger_given = given;
  larger_given.joints *= 7;
  const Rig found = weights_on_joints(larger, skeleton, larger_given);
  EXPECT_LT(largest_difference(found.weights, rig.weights), 1e-3F);
}

TEST(GivenJoints, NoneAreRefused) {
  const RigSubject& s = rig_subjects().front();
  EXPECT_THROW((void)weights_on_joints(s.surface, s.skeleton, {}), Error);
}

}  // namespace
}  // namespace curveskel::given_joints_laws
