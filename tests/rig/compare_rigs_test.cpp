// Laws of comparing rigs: nothing differs from itself, and what is known to differ differs by what
// is known.
#include <curveskel/compare_rigs.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "base/least_pairs.hpp"
#include "meshes/shapes.hpp"
#include "tests/rig/random_rigs.hpp"

namespace curveskel::compare_rigs_laws {
namespace {

constexpr double length = 12;  // of the bar; L is a little more, as its ends are round
constexpr double radius = 1;

double longest_side(const Surface& surface) {
  return (surface.positions.colwise().maxCoeff() - surface.positions.colwise().minCoeff())
      .maxCoeff();
}

/// A round bar along x with joints at these places of it, one after the other; each vertex goes
/// with the last joint before it.
RiggedSurface rigged_bar(const std::vector<double>& places) {
  RiggedSurface bar;
  bar.surface = shapes::tube("", shapes::straight(length), shapes::constant(radius), 24).surface;
  const auto joints = static_cast<Eigen::Index>(places.size());
  bar.rig.joints = Positions::Zero(joints, 3);
  bar.rig.parents.resize(joints);
  for (Eigen::Index joint = 0; joint < joints; ++joint) {
    bar.rig.joints(joint, 0) = places[idx(joint)];
    bar.rig.parents[joint] = static_cast<int>(joint) - 1;
    bar.rig.names.push_back("bone " + std::to_string(joint));
  }
  bar.rig.weights.resize(bar.surface.positions.rows(), joints);
  for (Eigen::Index vertex = 0; vertex < bar.surface.positions.rows(); ++vertex) {
    Eigen::Index owner = 0;
    for (Eigen::Index joint = 1; joint < joints; ++joint) {
      if (bar.surface.positions(vertex, 0) > places[idx(joint)]) owner = joint;
    }
    bar.rig.weights.insert(vertex, owner) = 1;
  }
  bar.rig.weights.makeCompressed();
  return bar;
}

std::vector<RiggedSurface> random_subjects() {
  std::vector<RiggedSurface> all;
  for (const int joints : {1, 2, 7, 40}) {
    const Surface torus = torus_surface();
    all.push_back({torus, random_rig(torus.positions.rows(), joints, "bone ")});
  }
  all.push_back(rigged_bar({-5, -2, 1, 4}));
  return all;
}

void expect_same(const RigComparison& a, const RigComparison& b, double tolerance) {
  EXPECT_EQ(a.joints, b.joints);
  EXPECT_EQ(a.truth_joints, b.truth_joints);
  EXPECT_NEAR(a.joints_to_joints, b.joints_to_joints, tolerance);
  EXPECT_NEAR(a.joints_to_bones, b.joints_to_bones, tolerance);
  EXPECT_NEAR(a.bones_to_bones, b.bones_to_bones, tolerance);
  EXPECT_NEAR(a.root_distance, b.root_distance, tolerance);
  EXPECT_EQ(a.by_thickness.hits, b.by_thickness.hits);
  EXPECT_EQ(a.by_size.hits, b.by_size.hits);
  ASSERT_EQ(a.poses.has_value(), b.poses.has_value());
  if (a.poses) {
    EXPECT_EQ(a.poses->poses, b.poses->poses);
    EXPECT_NEAR(a.poses->mean_distance, b.poses->mean_distance, tolerance);
    EXPECT_NEAR(a.poses->shared, b.poses->shared, tolerance);
  }
}

TEST(CompareRigs, NothingDiffersFromItself) {
  for (const RiggedSurface& subject : random_subjects()) {
    const RigComparison found = compare_rigs(subject, subject);
    EXPECT_EQ(found.joints, found.truth_joints);
    EXPECT_EQ(found.joints_to_joints, 0);
    EXPECT_LT(found.bones_to_bones, 1e-12);
    EXPECT_EQ(found.root_distance, 0);
    for (const JointHits& hits : {found.by_size, found.by_thickness}) {
      EXPECT_EQ(hits.hits, found.joints);
      EXPECT_EQ(hits.overlap, 1);
      EXPECT_EQ(hits.precision, 1);
      EXPECT_EQ(hits.recall, 1);
    }
    ASSERT_TRUE(found.poses && found.weights);
    EXPECT_LT(found.poses->mean_distance, 1e-12);
    EXPECT_NEAR(found.poses->shared, found.poses->poses > 0 ? 1 : 0, 1e-12);
    EXPECT_EQ(found.weights->precision, 1);
    EXPECT_EQ(found.weights->recall, 1);
    EXPECT_EQ(found.weights->l1, 0);
  }
}

/// Lengths are over L, so nothing depends on unit and place; axes may be any.
TEST(CompareRigs, DoesNotDependOnUnitPlaceAndAxes) {
  const auto moved = [](RiggedSurface subject) {
    const Eigen::RowVector3d shift(30, -7, 2);
    for (Positions* places : {&subject.surface.positions, &subject.rig.joints}) {
      const Positions turned = *places;
      for (int axis = 0; axis < 3; ++axis) places->col(axis) = 4 * turned.col((axis + 1) % 3);
      places->rowwise() += shift;
    }
    return subject;
  };
  const RiggedSurface truth = rigged_bar({-5, -2, 1, 4});
  const RiggedSurface rig = rigged_bar({-5.2, -1, 1.3, 2, 4.9});
  expect_same(compare_rigs(rig, truth), compare_rigs(moved(rig), moved(truth)), 1e-9);
}

TEST(CompareRigs, TheOtherWayRoundPrecisionIsRecall) {
  const RiggedSurface one = rigged_bar({-5, -2, 1, 4});
  const RiggedSurface other = rigged_bar({-5.2, -1, 1.3, 2, 4.9});
  const RigComparison there = compare_rigs(one, other);
  const RigComparison back = compare_rigs(other, one);
  EXPECT_NEAR(there.joints_to_joints, back.joints_to_joints, 1e-12);
  EXPECT_NEAR(there.joints_to_bones, back.joints_to_bones, 1e-12);
  EXPECT_NEAR(there.bones_to_bones, back.bones_to_bones, 1e-12);
  EXPECT_EQ(there.by_size.precision, back.by_size.recall);
  EXPECT_EQ(there.by_size.recall, back.by_size.precision);
  EXPECT_EQ(there.by_size.overlap, back.by_size.overlap);
}

/// Each joint moved across the bar by `share` of its radius.
TEST(CompareRigs, AShiftCountsAsLongAsItIs) {
  const RiggedSurface truth = rigged_bar({-5, -2, 1, 4});
  const double side = longest_side(truth.surface);
  for (const double shift : {0.1, 0.5, 0.8, 0.95, 1.05, 1.3}) {
    SCOPED_TRACE(shift);
    RiggedSurface rig = truth;
    rig.rig.joints.col(2).array() += shift * radius;
    const RigComparison found = compare_rigs(rig, truth);
    EXPECT_NEAR(found.joints_to_joints, shift * radius / side, 1e-9);
    EXPECT_NEAR(found.root_distance, shift * radius / side, 1e-9);
    EXPECT_NEAR(found.joints_to_bones, shift * radius / side, 1e-4);
    EXPECT_NEAR(found.bones_to_bones, shift * radius / side, 1e-4);
    // The bar is `radius` thick on each side of the joints, but for the edges of 24 sides.
    EXPECT_EQ(found.by_thickness.hits, shift < 1 ? 4 : 0);
    EXPECT_EQ(found.by_size.hits, shift * radius < 0.05 * side ? 4 : 0);
  }
}

/// More joints in the same bones: only joints differ.
TEST(CompareRigs, JointsInBonesLeaveTheBones) {
  const RiggedSurface truth = rigged_bar({-5, -1, 3});
  const RigComparison found = compare_rigs(rigged_bar({-5, -3, -1, 1, 3}), truth);
  EXPECT_LT(found.bones_to_bones, 0.003);  // half a step of the samples
  EXPECT_LT(found.joints_to_bones, 0.003);
  EXPECT_NEAR(found.joints_to_joints, 0.5 * (2 * 2.0 / 5) / longest_side(truth.surface), 1e-9);
  EXPECT_EQ(found.by_size.recall, 1);
  EXPECT_NEAR(found.by_size.precision, 3.0 / 5, 1e-12);
  EXPECT_NEAR(found.by_size.overlap, 6.0 / 8, 1e-12);
}

/// A topmost joint with one child that moves nothing, and a second joint in one place, are no
/// more joints.
TEST(CompareRigs, HandlesAndJointsInOnePlaceDoNotCount) {
  const RiggedSurface truth = rigged_bar({-5, -2, 1, 4});
  RiggedSurface rig = truth;
  const Eigen::Index joints = truth.rig.joints.rows();
  rig.rig.joints.resize(joints + 2, 3);
  rig.rig.joints << Eigen::RowVector3d(0, -9, 0), truth.rig.joints, truth.rig.joints.row(2);
  rig.rig.parents.resize(joints + 2);
  rig.rig.parents << -1, truth.rig.parents.array() + 1, 3;
  rig.rig.names.insert(rig.rig.names.begin(), "root");
  rig.rig.names.emplace_back("twist");
  rig.rig.weights = SkinWeights(truth.rig.weights.rows(), joints + 2);
  for (Eigen::Index vertex = 0; vertex < truth.rig.weights.rows(); ++vertex) {
    for (SkinWeights::InnerIterator it(truth.rig.weights, vertex); it; ++it) {
      rig.rig.weights.insert(vertex, it.col() + 1) = it.value();
    }
  }
  const RigComparison same = compare_rigs(truth, truth);
  expect_same(compare_rigs(rig, truth), same, 1e-12);
  expect_same(compare_rigs(truth, rig), same, 1e-12);
  ASSERT_TRUE(compare_rigs(rig, truth).weights.has_value());
  EXPECT_EQ(compare_rigs(rig, truth).weights->l1, 0);
  rig.rig.weights.coeffRef(0, 0) = 0.2F;  // a stray weight makes no joint of a handle
  const RigComparison stray = compare_rigs(truth, rig);
  EXPECT_EQ(stray.truth_joints, same.truth_joints);
  EXPECT_EQ(stray.root_distance, same.root_distance);
}

/// Turned by 45 degrees about another place along the bone, what moves ends up a chord away; what
/// only one of them moves is beside the point here, as the weights are the same.
TEST(CompareRigs, PosesDifferByTheChordOfTheTurn) {
  const RiggedSurface truth = rigged_bar({-5, 1});
  for (const double away : {-0.5, 0.25, 1.0}) {
    RiggedSurface rig = truth;
    rig.rig.joints(1, 0) += away;
    const RigComparison found = compare_rigs(rig, truth);
    ASSERT_TRUE(found.poses.has_value());
    EXPECT_EQ(found.poses->poses, 1);
    EXPECT_NEAR(found.poses->shared, 1, 1e-6);
    const double chord = 2 * std::sin(std::numbers::pi / 8) * std::abs(away);
    EXPECT_NEAR(found.poses->mean_distance, chord / longest_side(truth.surface), 1e-9);
    EXPECT_FALSE(found.weights.has_value());
    EXPECT_FALSE(found.not_weighed.empty());
  }
}

TEST(CompareRigs, WeightsDifferByWhatIsKnown) {
  const RiggedSurface truth = rigged_bar({-5, 1});
  RiggedSurface rig = truth;
  rig.rig.weights.setZero();
  for (Eigen::Index vertex = 0; vertex < rig.rig.weights.rows(); ++vertex) {
    rig.rig.weights.coeffRef(vertex, 0) = 0.5F;
    rig.rig.weights.coeffRef(vertex, 1) = 0.5F;
  }
  const RigComparison found = compare_rigs(rig, truth);
  ASSERT_TRUE(found.weights.has_value());
  EXPECT_EQ(found.weights->precision, 0.5);
  EXPECT_EQ(found.weights->recall, 1);
  EXPECT_NEAR(found.weights->l1, 1, 1e-6);
  const RigComparison back = compare_rigs(truth, rig);
  ASSERT_TRUE(back.weights.has_value());
  EXPECT_EQ(back.weights->precision, 1);
  EXPECT_EQ(back.weights->recall, 0.5);
  EXPECT_NEAR(back.weights->l1, 1, 1e-6);
}

TEST(CompareRigs, SaysWhyItDoesNotPose) {
  const RiggedSurface truth = rigged_bar({-5, 1});
  RiggedSurface moved = truth;
  moved.surface.positions.col(0).array() += 0.01;
  const RigComparison apart = compare_rigs(moved, truth);
  EXPECT_FALSE(apart.poses || apart.weights);
  EXPECT_NE(apart.not_posed.find("places"), std::string::npos);
  const RiggedSurface torus{torus_surface(), random_rig(torus_surface().positions.rows(), 4, "")};
  const RigComparison other = compare_rigs(torus, truth);
  EXPECT_FALSE(other.poses || other.weights);
  EXPECT_NE(other.not_posed.find("vertices"), std::string::npos);
}

TEST(CompareRigs, PlacesNeedNoWeights) {
  const RiggedSurface truth = rigged_bar({-5, -2, 1, 4});
  const RiggedSurface rig = rigged_bar({-5.2, -1, 1.3, 2, 4.9});
  const RigComparison whole = compare_rigs(rig, truth);
  const auto without_weights = [](RiggedSurface subject) {
    subject.rig.weights.resize(0, subject.rig.joints.rows());
    return subject;
  };
  RiggedSurface joints_alone = without_weights(rig);
  joints_alone.surface = {};
  for (const auto& [one, other] :
       {std::pair{joints_alone, truth}, std::pair{rig, without_weights(truth)}}) {
    const RigComparison found = compare_rigs(one, other);
    EXPECT_EQ(found.joints_to_joints, whole.joints_to_joints);
    EXPECT_EQ(found.by_size.hits, whole.by_size.hits);
    EXPECT_FALSE(found.poses || found.weights);
    EXPECT_NE(found.not_posed.find("weights"), std::string::npos);
  }
}

TEST(CompareRigs, RefusesATruthWithoutExtent) {
  RiggedSurface truth = rigged_bar({-5, 1});
  const RiggedSurface rig = truth;
  truth.surface.positions.setZero();
  try {
    (void)compare_rigs(rig, truth);
    FAIL() << "measured by nothing";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
  }
}

TEST(CompareRigs, StopsWhenAskedTo) {
  const RiggedSurface truth = rigged_bar({-5, 1});
  std::stop_source source;
  source.request_stop();
  Monitor monitor;
  monitor.stop = source.get_token();
  EXPECT_THROW((void)compare_rigs(truth, truth, monitor), Cancelled);
}

/// The least sum over all ways to pair, one by one.
double least_sum(const Eigen::MatrixXd& costs) {
  if (costs.rows() > costs.cols()) return least_sum(costs.transpose());
  std::vector<int> columns(idx(costs.cols()));
  std::iota(columns.begin(), columns.end(), 0);
  double least = std::numeric_limits<double>::infinity();
  do {
    double sum = 0;
    for (Eigen::Index row = 0; row < costs.rows(); ++row) sum += costs(row, columns[idx(row)]);
    least = std::min(least, sum);
  } while (std::next_permutation(columns.begin(), columns.end()));
  return least;
}

TEST(LeastPairs, HaveTheLeastSumOfAll) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> cost(-1, 3);
  for (Eigen::Index rows = 1; rows <= 6; ++rows) {
    for (Eigen::Index columns = 1; columns <= 6; ++columns) {
      for (const bool coarse : {false, true}) {  // with ties
        Eigen::MatrixXd costs(rows, columns);
        for (double& entry : costs.reshaped()) {
          entry = coarse ? std::round(cost(random)) : cost(random);
        }
        const std::vector<int> pairs = least_pairs(costs);
        ASSERT_EQ(pairs.size(), idx(rows));
        std::vector<bool> taken(idx(columns), false);
        double sum = 0;
        Eigen::Index number = 0;
        for (Eigen::Index row = 0; row < rows; ++row) {
          const int column = pairs[idx(row)];
          if (column < 0) continue;
          EXPECT_FALSE(taken[idx(column)]);
          taken[idx(column)] = true;
          sum += costs(row, column);
          ++number;
        }
        EXPECT_EQ(number, std::min(rows, columns));
        EXPECT_NEAR(sum, least_sum(costs), 1e-9);
      }
    }
  }
}

/// No vertex turns by enough of it to be counted.
TEST(CompareRigs, AJointOfALittleOfEachVertexIsNoLimb) {
  RiggedSurface bar = rigged_bar({-6, 0});
  bar.rig.weights.setZero();
  for (Eigen::Index vertex = 0; vertex < bar.rig.weights.rows(); ++vertex) {
    bar.rig.weights.insert(vertex, 0) = 0.993F;
    bar.rig.weights.insert(vertex, 1) = 0.007F;
  }
  bar.rig.weights.makeCompressed();
  const RigComparison found = compare_rigs(bar, bar);
  ASSERT_TRUE(found.poses.has_value());
  EXPECT_EQ(found.poses->poses, 0);
  EXPECT_EQ(found.poses->mean_distance, 0);
}

}  // namespace
}  // namespace curveskel::compare_rigs_laws
