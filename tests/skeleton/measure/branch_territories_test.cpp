// Parts of surfaces that add up.
#include <curveskel/branch_territories.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/extract.hpp>
#include "meshes/shapes.hpp"
#include "tests/skeleton/measure/tubes.hpp"
#include "tests/surfaces.hpp"

namespace curveskel {
namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(BranchTerritories, AddUpToTheSurfaceAndItsVolume) {
  for (const NamedSurface& one : families()) {
    SCOPED_TRACE(one.name);
    const CurveSkeleton skeleton = extract(one.surface).skeleton;
    if (skeleton.edges.rows() == 0) continue;
    const BranchTerritories parts = branch_territories(one.surface, skeleton);
    if (parts.branch_of_face.minCoeff() < 0) continue;  // a ball beside: it has no branch
    const double whole = volume(one.surface);
    EXPECT_NEAR(sum(parts.areas), area(one.surface), 1e-9 * area(one.surface));
    EXPECT_NEAR(sum(parts.volumes), whole, 1e-9 * whole);
    for (const double part : parts.volumes) EXPECT_GT(part, 0) << "of " << whole;
  }
}

/// The surface elsewhere, and a ball beside it without a branch.
Surface moved_beside_a_ball(const Surface& surface, const Eigen::Vector3d& way) {
  const Surface ball = shapes::ellipsoid({1, 1, 1}, 2).surface;
  const Eigen::Index vertices = surface.positions.rows();
  Surface both;
  both.positions.resize(vertices + ball.positions.rows(), 3);
  both.positions << surface.positions.rowwise() + way.transpose(), ball.positions;
  both.triangles.resize(surface.triangles.rows() + ball.triangles.rows(), 3);
  both.triangles << surface.triangles, (ball.triangles.array() + int(vertices)).matrix();
  return both;
}

TEST(ThoroughBranchTerritories, AreTheSameElsewhereAndBesideOthers) {
  for (const NamedSurface& one : families()) {
    SCOPED_TRACE(one.name);
    CurveSkeleton skeleton = extract(one.surface).skeleton;
    if (skeleton.edges.rows() == 0) continue;
    const BranchTerritories there = branch_territories(one.surface, skeleton);
    const double size = bounding_box_diagonal(one.surface.positions);
    const Eigen::Vector3d way = 10 * size * Eigen::Vector3d(0.6, -0.48, 0.64);
    const Surface both = moved_beside_a_ball(one.surface, way);
    skeleton.nodes.rowwise() += way.transpose();
    const Eigen::Index vertices = one.surface.positions.rows();
    skeleton.node_of_vertex.conservativeResize(both.positions.rows());
    skeleton.node_of_vertex.tail(both.positions.rows() - vertices).setConstant(-1);
    const BranchTerritories here = branch_territories(both, skeleton);
    for (std::size_t b = 0; b < there.volumes.size(); ++b) {
      EXPECT_NEAR(here.volumes[b], there.volumes[b], 1e-6 * volume(one.surface)) << "branch " << b;
    }
  }
}

TEST(BranchTerritories, DivideATubeWhereItsJunctionLies) {
  const auto one = [](double) { return 1.0; };
  const Surface tube = straight_tube(12, 241, 48, one, one);
  CurveSkeleton skeleton = chain(points_on_x(0, 12, 25), 1);
  // A stub at x = 4 makes a junction there.
  skeleton.nodes.conservativeResize(26, 3);
  skeleton.nodes.row(25) << 4, 0, 0.5;
  skeleton.radii = Eigen::VectorXd::Constant(26, 1);
  Edges edges(25, 2);
  for (int k = 0; k < 9; ++k) edges.row(k) << k, k + 1;
  edges.row(9) << 8, 25;
  for (int k = 9; k < 24; ++k) edges.row(k + 1) << k, k + 1;
  skeleton.edges = edges;
  skeleton.node_of_vertex.resize(tube.positions.rows());
  for (Eigen::Index v = 0; v < tube.positions.rows(); ++v) {
    skeleton.node_of_vertex[v] = static_cast<int>(std::lround(tube.positions(v, 0) * 2));
  }
  const BranchTerritories parts = branch_territories(tube, skeleton);
  ASSERT_EQ(parts.volumes.size(), 3U);
  const double whole = volume(tube);
  EXPECT_NEAR(parts.volumes[0] / whole, 4.0 / 12, 0.01);
  EXPECT_NEAR((parts.volumes[1] + parts.volumes[2]) / whole, 8.0 / 12, 0.01);
}

TEST(BranchTerritories, PolygonsGoWithMostOfTheirCorners) {
  Eigen::VectorXi labels(5);
  labels << 3, 3, 1, 1, 2;
  const Eigen::VectorXi of = majority_labels(labels, {0, 1, 2, 0, 2, 4, 0, 2, 3, 1}, {0, 3, 6, 10});
  EXPECT_EQ(of[0], 3);
  EXPECT_EQ(of[1], 3) << "of three different the first";
  EXPECT_EQ(of[2], 3);
}

}  // namespace
}  // namespace curveskel
