// Numbers of branches of curves on which they are known.
#include <curveskel/branch_measures.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace curveskel {
namespace {

using Place = Eigen::Vector3d;

/// `count` edges along place(0) .. place(1), the radius growing from 1 to 3.
template <typename Function>
CurveSkeleton polyline(int count, const Function& place) {
  CurveSkeleton skeleton;
  skeleton.nodes.resize(count + 1, 3);
  skeleton.radii = Eigen::VectorXd::LinSpaced(count + 1, 1, 3);
  skeleton.edges.resize(count, 2);
  for (int k = 0; k <= count; ++k) skeleton.nodes.row(k) = place(double(k) / count);
  for (int k = 0; k < count; ++k) skeleton.edges.row(k) << k, k + 1;
  return skeleton;
}

TEST(BranchMeasures, OfAHelixAreThoseOfTheFormula) {
  for (const double pitch : {0.5, 2.0, 20.0}) {
    for (const int turns : {1, 3}) {
      const double angle = 2 * std::numbers::pi * turns;
      const CurveSkeleton helix = polyline(4000, [&](double t) {
        return Place(std::cos(angle * t), std::sin(angle * t), pitch * turns * t);
      });
      const double height = pitch * turns;
      const double length = std::hypot(angle, height);
      const auto measures = branch_measures(helix);
      ASSERT_EQ(measures.size(), 1U);
      EXPECT_EQ(measures[0].kind, BranchKind::chain);
      EXPECT_NEAR(measures[0].length, length, 1e-5 * length);
      EXPECT_NEAR(measures[0].chord, height, 1e-9);
      EXPECT_NEAR(measures[0].tortuosity, length / height - 1, 1e-5 * length / height);
      EXPECT_NEAR(measures[0].mean_radius, 2, 1e-6);
      EXPECT_EQ(measures[0].least_radius, 1);
      EXPECT_EQ(measures[0].largest_radius, 3);
    }
  }
}

TEST(BranchMeasures, OfAStraightBranchHaveNoTortuosityHoweverItIsDivided) {
  for (const int count : {1, 2, 7}) {
    const auto measures =
        branch_measures(polyline(count, [](double t) { return Place(t * t, 2 * t * t, 0); }));
    EXPECT_NEAR(measures.at(0).tortuosity, 0, 1e-12);
    EXPECT_NEAR(measures.at(0).length, std::sqrt(5.0), 1e-12);
  }
}

TEST(BranchMeasures, TellRingsLeavesAndInnerBranchesApart) {
  CurveSkeleton ring;
  ring.nodes = Positions::Identity(3, 3);
  ring.edges.resize(3, 2);
  ring.edges << 0, 1, 0, 2, 1, 2;
  const auto of_ring = branch_measures(ring);
  ASSERT_EQ(of_ring.size(), 1U);
  EXPECT_EQ(of_ring[0].kind, BranchKind::ring);
  EXPECT_EQ(of_ring[0].chord, 0);
  EXPECT_TRUE(std::isnan(of_ring[0].tortuosity));
  EXPECT_TRUE(std::isnan(of_ring[0].mean_radius)) << "it has no radii";

  // A loop with a tail, and a letter H.
  CurveSkeleton tail = ring;
  tail.nodes = Positions::Identity(4, 3);
  tail.edges.resize(4, 2);
  tail.edges << 0, 1, 0, 2, 0, 3, 1, 2;
  CurveSkeleton letter;
  letter.nodes = Positions::Random(6, 3);
  letter.edges.resize(5, 2);
  letter.edges << 0, 1, 0, 2, 0, 3, 3, 4, 3, 5;
  const auto count = [](const CurveSkeleton& skeleton, BranchKind kind) {
    int number = 0;
    for (const BranchMeasures& one : branch_measures(skeleton)) number += one.kind == kind ? 1 : 0;
    return number;
  };
  EXPECT_EQ(count(tail, BranchKind::inner), 1);
  EXPECT_EQ(count(tail, BranchKind::leaf), 1);
  EXPECT_EQ(count(letter, BranchKind::inner), 1);
  EXPECT_EQ(count(letter, BranchKind::leaf), 4);
}

}  // namespace
}  // namespace curveskel
