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
    EXPECT_LT(mean_difference(rig.weights, own.weights), 0.3F);
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
    given.names.assign(static_cast<std::size_t>(count) + 1, "");
    const Rig rig = weights_on_joints(s.surface, s.skeleton, given);
    EXPECT_EQ(Eigen::MatrixXf(rig.weights).col(0).maxCoeff(), 0);
    const SkinWeights rest = rig.weights.rightCols(count);
    const Rig without = weights_on_joints(s.surface, s.skeleton, own);
    EXPECT_LT(mean_difference(rest, without.weights), 1e-5F);
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
