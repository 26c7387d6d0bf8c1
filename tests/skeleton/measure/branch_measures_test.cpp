// Numbers of branches and junctions of curves on which they are known.
#include <curveskel/branch_measures.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

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

/// One turn and a half of a helix that rises by `pitch` a turn, with thin balls.
CurveSkeleton thin_helix(double radius, double pitch, int nodes) {
  CurveSkeleton helix = polyline(nodes, [&](double t) {
    const double angle = 3 * std::numbers::pi * t;
    return Place(radius * std::cos(angle), radius * std::sin(angle), 1.5 * pitch * t);
  });
  helix.radii.setConstant(0.1 * radius);
  return helix;
}

TEST(BranchMeasures, OfAHelixHaveItsCurvatureAndTorsion) {
  for (const double radius : {1.0, 30.0}) {
    for (const double pitch : {0.0, 3.0 * radius, -8.0 * radius}) {
      const double rise = pitch / (2 * std::numbers::pi);
      const double squares = radius * radius + rise * rise;
      for (const int nodes : {60, 2000}) {
        const auto measures = branch_measures(thin_helix(radius, pitch, nodes)).at(0);
        EXPECT_NEAR(measures.curvature * squares / radius, 1, 0.02) << nodes;
        EXPECT_NEAR(measures.torsion * squares, rise, 0.03 * std::abs(rise) + 1e-6) << nodes;
      }
    }
  }
  const auto straight = branch_measures(polyline(9, [](double t) { return Place(t, t, 3 * t); }));
  EXPECT_NEAR(straight.at(0).curvature, 0, 1e-9);
  EXPECT_TRUE(std::isnan(straight.at(0).torsion));
}

/// Nodes off their place by a share of a radius are no twist, however thin the tube.
TEST(BranchMeasures, OfAThinTubesHelixHaveItsTorsion) {
  for (const double share : {0.1, 0.03, 0.01}) {
    CurveSkeleton helix = thin_helix(1, 3, 1500);
    helix.radii.setConstant(share);
    std::mt19937 generator(5);
    std::normal_distribution<double> off(0, 0.003 * share);
    for (double& coordinate : helix.nodes.reshaped()) coordinate += off(generator);
    const double rise = 3 / (2 * std::numbers::pi);
    EXPECT_NEAR(branch_measures(helix).at(0).torsion * (1 + rise * rise) / rise, 1, 0.05) << share;
  }
}

/// Rays of length 4 from one point, in steps of 1/2; balls of radius 1.
CurveSkeleton star(const std::vector<Place>& directions) {
  CurveSkeleton skeleton;
  const auto rays = static_cast<Eigen::Index>(directions.size());
  skeleton.nodes = Positions::Zero(1 + 8 * rays, 3);
  skeleton.edges.resize(8 * rays, 2);
  for (Eigen::Index k = 0; k < 8; ++k) {
    for (Eigen::Index ray = 0; ray < rays; ++ray) {
      const Eigen::Index node = 1 + k * rays + ray;
      skeleton.nodes.row(node) =
          double(k + 1) / 2 * directions[static_cast<std::size_t>(ray)].normalized();
      skeleton.edges.row(k * rays + ray) << (k == 0 ? 0 : int(node - rays)), int(node);
    }
  }
  skeleton.radii = Eigen::VectorXd::Ones(skeleton.nodes.rows());
  skeleton.lives = Eigen::VectorXd::Zero(skeleton.nodes.rows());
  for (Eigen::Index ray = 0; ray < rays; ++ray)
    skeleton.lives[1 + 7 * rays + ray] = 9 - double(ray);
  return skeleton;
}

TEST(JunctionMeasures, HaveTheAnglesAndThePlanarityOfTheirRays) {
  const auto y = junction_measures(star({{1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}));
  ASSERT_EQ(y.size(), 1U);
  EXPECT_EQ(y[0].node, 0);
  EXPECT_EQ(y[0].branches, (std::vector<int>{0, 1, 2}));
  ASSERT_EQ(y[0].angles.size(), 3U);
  EXPECT_NEAR(y[0].angles[0], 135, 1e-9);
  EXPECT_NEAR(y[0].angles[1], 135, 1e-9);
  EXPECT_NEAR(y[0].angles[2], 90, 1e-9);
  EXPECT_NEAR(y[0].planarity, 1, 1e-9);
  const auto corner = junction_measures(star({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_NEAR(corner.at(0).planarity, 0, 1e-9);
  const auto four = junction_measures(star({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}));
  EXPECT_EQ(four.at(0).angles.size(), 6U);
  EXPECT_NEAR(four.at(0).planarity, 0, 1e-9);
}

/// Near the junction its body is one, and the curve bends to the junction's middle.
TEST(JunctionMeasures, HaveTheAnglesOfTheBranchesBeyondTheJunctionsBody) {
  const std::vector<Place> rays{{1, 0.2, 0}, {1, -0.2, 0}, {-1, 0, 0}};
  const CurveSkeleton even = star(rays);
  CurveSkeleton bent = even;
  for (Eigen::Index node = 1; node < 1 + 2 * 3; ++node) bent.nodes(node, 1) *= 3;
  EXPECT_NEAR(junction_measures(even).at(0).angles[0], 2 * std::atan(0.2) * 180 / std::numbers::pi,
              1e-9);
  EXPECT_NEAR(junction_measures(bent).at(0).angles[0], junction_measures(even).at(0).angles[0],
              1e-9);
}

TEST(BranchMeasures, HaveTheAngleToTheirParent) {
  const auto measures = branch_measures(star({{1, 0, 0}, {-1, 0, 0}, {1, 1, 0}}));
  ASSERT_EQ(measures.size(), 3U);
  EXPECT_NEAR(measures[2].parent_angle, 45, 1e-9);  // the first is the eldest
  EXPECT_TRUE(std::isnan(measures[0].parent_angle));
}

/// A binary tree of `depth` levels of branches, nodes numbered as in a heap below the root's tip.
CurveSkeleton binary_tree(int depth) {
  CurveSkeleton tree;
  const int count = 1 << depth;
  tree.nodes = Positions::Random(count, 3);
  tree.edges.resize(count - 1, 2);
  for (int node = 1; node < count; ++node) tree.edges.row(node - 1) << node / 2, node;
  tree.radii = Eigen::VectorXd::Ones(count);
  tree.radii[0] = 2;
  return tree;
}

TEST(BranchMeasures, CountOrdersFromTheRoot) {
  const CurveSkeleton tree = binary_tree(5);
  const auto measures = branch_measures(tree);
  const auto all = branches(tree);
  for (std::size_t b = 0; b < all.size(); ++b) {
    int level = 1;
    for (int node = all[b].nodes.back(); node > 1; node /= 2) ++level;
    EXPECT_EQ(measures[b].centrifugal_order, level);
    EXPECT_EQ(measures[b].strahler_order, 6 - level);
  }
  // From a leaf the same tree is a comb whose order no longer rises on the way back.
  const auto from_leaf = branch_measures(tree, 16);
  for (std::size_t b = 0; b < all.size(); ++b) {
    if (all[b].nodes.back() == 16) {
      EXPECT_EQ(from_leaf[b].centrifugal_order, 1);
    }
    if (all[b].nodes.front() != 0) continue;
    EXPECT_EQ(from_leaf[b].centrifugal_order, 5);
    EXPECT_EQ(from_leaf[b].strahler_order, 1);
  }
}

TEST(BranchMeasures, HaveNoStrahlerOrderWhereThereAreCycles) {
  CurveSkeleton tail;
  tail.nodes = Positions::Identity(4, 3);
  tail.edges.resize(4, 2);
  tail.edges << 0, 1, 0, 2, 0, 3, 1, 2;
  for (int root = -1; root < 4; ++root) {
    for (const BranchMeasures& one : branch_measures(tail, root)) {
      EXPECT_EQ(one.strahler_order, 0);
      EXPECT_GE(one.centrifugal_order, 1);
    }
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
