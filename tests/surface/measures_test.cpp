#include <curveskel/advanced/measures.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "meshes/shapes.hpp"
#include "surface/mesh/flat_edges.hpp"

namespace curveskel::measures_laws {
namespace {

// Axis-aligned box with one corner at `corner`, outward.
Surface box(const Eigen::RowVector3d& corner, const Eigen::RowVector3d& size) {
  Surface surface;
  surface.positions.resize(8, 3);
  for (int v = 0; v < 8; ++v) {
    const Eigen::RowVector3d step(v & 1, v >> 1 & 1, v >> 2);
    surface.positions.row(v) = corner + step.cwiseProduct(size);
  }
  surface.triangles.resize(12, 3);
  surface.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4,
      6, 0, 6, 2, 1, 3, 7, 1, 7, 5;
  return surface;
}

TEST(Measures, BoxHasTheValuesOfTheFormula) {
  const Surface surface = box({0, 0, 0}, {1, 2, 3});
  EXPECT_DOUBLE_EQ(area(surface), 22);
  EXPECT_DOUBLE_EQ(volume(surface), 6);
  EXPECT_DOUBLE_EQ(bounding_box_diagonal(surface.positions), std::sqrt(14.0));
}

TEST(Measures, ScaleWithTheirPowerOfLength) {
  for (const double s : {1e-30, 1e-9, 1e-6, 1e6, 1e9}) {
    const Surface surface = box({0, 0, 0}, {s, 2 * s, 3 * s});
    EXPECT_NEAR(area(surface) / (22 * s * s), 1, 1e-13);
    EXPECT_NEAR(volume(surface) / (6 * s * s * s), 1, 1e-13);
    EXPECT_NEAR(bounding_box_diagonal(surface.positions) / (std::sqrt(14.0) * s), 1, 1e-13);
  }
}

TEST(Measures, FarOffOriginCostsNoDigitsOfTheVolume) {
  const Surface surface = box({1048576, -2097152, 4194304}, {1, 2, 3});
  EXPECT_DOUBLE_EQ(volume(surface), 6);
  EXPECT_DOUBLE_EQ(area(surface), 22);
}

TEST(Measures, TurningTheSurfaceInsideOutNegatesVolumeAndNormals) {
  const Surface surface = box({0, 0, 0}, {1, 2, 3});
  Surface turned = surface;
  turned.triangles.col(1).swap(turned.triangles.col(2));
  EXPECT_DOUBLE_EQ(volume(turned), -volume(surface));
  EXPECT_LT((vertex_normals(turned) + vertex_normals(surface)).norm(), 1e-14);
}

TEST(Measures, NormalsAtABoxCornerDoNotDependOnHowItsSidesAreCut) {
  // Angle weights: every corner sees three right angles, whichever way the diagonals run.
  const Surface surface = box({0, 0, 0}, {1, 2, 3});
  const Positions normals = vertex_normals(surface);
  for (int v = 0; v < 8; ++v) {
    const Eigen::RowVector3d outward(v & 1 ? 1 : -1, v >> 1 & 1 ? 1 : -1, v >> 2 ? 1 : -1);
    EXPECT_LT((normals.row(v) - outward / std::sqrt(3.0)).norm(), 1e-14) << "corner " << v;
  }
}

TEST(Measures, VertexWithoutAreaHasNoNormal) {
  Surface surface = box({0, 0, 0}, {1, 2, 3});
  surface.positions.setZero();
  EXPECT_EQ(vertex_normals(surface), Positions(Positions::Zero(8, 3)));
  EXPECT_EQ(area(surface), 0);
  EXPECT_EQ(volume(surface), 0);
}

TEST(Measures, NothingMeasuresZero) {
  EXPECT_EQ(area(Surface{}), 0);
  EXPECT_EQ(volume(Surface{}), 0);
  EXPECT_EQ(bounding_box_diagonal(Positions{}), 0);
}

TEST(FlatEdges, AreTheDiagonalsOfABoxOfAnySize) {
  for (const double s : {1e-200, 1e-9, 1.0, 1e9, 1e200}) {
    EXPECT_DOUBLE_EQ(share_of_flat_edges(box({0, 0, 0}, {s, 2 * s, 3 * s})), 1.0 / 3);
  }
  EXPECT_EQ(share_of_flat_edges(Surface()), 0);
}

TEST(FlatEdges, AreNoneWhereThereIsNoise) {
  for (const shapes::Shape& drawn : {shapes::box({1, 2, 3}, 8), shapes::sieve(3)}) {
    EXPECT_GT(share_of_flat_edges(drawn.surface), 0.5) << drawn.name;
    EXPECT_LT(share_of_flat_edges(shapes::noisy(drawn, 0.01, 1).surface), 0.02) << drawn.name;
  }
  const shapes::Shape ball = shapes::ellipsoid({1, 1, 2}, 4);
  EXPECT_LT(share_of_flat_edges(ball.surface), 0.1);
}

}  // namespace
}  // namespace curveskel::measures_laws
