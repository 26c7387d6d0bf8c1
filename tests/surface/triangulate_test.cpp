// Laws of triangulation: a polygon's triangles tile it.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include <curveskel/clean.hpp>
#include "tests/soups.hpp"

namespace curveskel::triangulate_laws {
namespace {

/// A polygon that winds once round the origin at changing distance, in a plane of any direction.
PolygonSoup star_shaped(int corners, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(
      6 * unit(), Eigen::Vector3d(unit() - 0.5, unit() - 0.5, unit() - 0.5).normalized()));
  PolygonSoup soup;
  soup.positions.resize(corners, 3);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * EIGEN_PI * i / corners;
    const double radius = 0.2 + unit();
    const Eigen::Vector3d flat(radius * std::cos(angle), radius * std::sin(angle), 3);
    soup.positions.row(i) = (turn * flat).transpose();
    soup.corners.push_back(i);
  }
  soup.offsets = {0, corners};
  return soup;
}

/// The strip between two turns of a spiral: every ear clipper's worst friend.
PolygonSoup spiral(Eigen::Index steps) {
  PolygonSoup soup;
  soup.positions.resize(2 * steps, 3);
  for (Eigen::Index i = 0; i < steps; ++i) {
    const double angle = 0.3 * static_cast<double>(i);
    const double radius = 1 + 0.1 * angle;
    soup.positions.row(i) << radius * std::cos(angle), radius * std::sin(angle), 0;
    soup.positions.row(2 * steps - 1 - i) << (radius - 0.3) * std::cos(angle),
        (radius - 0.3) * std::sin(angle), 0;
  }
  for (std::int32_t i = 0; i < 2 * steps; ++i) soup.corners.push_back(i);
  soup.offsets = {0, 2 * steps};
  return soup;
}

/// Slanting teeth on a bar: most corners are no ears until others are gone.
PolygonSoup comb(std::int32_t teeth) {
  PolygonSoup soup;
  const Eigen::Index all = teeth;
  soup.positions.resize(2 * all + 2, 3);
  for (Eigen::Index i = 0; i < all; ++i) {
    soup.positions.row(2 * i) << double(i), 0, 0;
    soup.positions.row(2 * i + 1) << double(i) + 20.5, 9, 0;
  }
  soup.positions.row(2 * all) << teeth, 0, 0;
  soup.positions.row(2 * all + 1) << teeth / 2.0, -3, 0;
  for (std::int32_t i = 2 * teeth + 1; i >= 0; --i) soup.corners.push_back(i);
  soup.offsets = {0, 2 * std::int64_t{teeth} + 2};
  return soup;
}

Eigen::Vector3d vector_area(const PolygonSoup& soup) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < soup.corners.size(); ++i) {
    const Eigen::Vector3d a = soup.positions.row(soup.corners[i]);
    const Eigen::Vector3d b = soup.positions.row(soup.corners[(i + 1) % soup.corners.size()]);
    sum += a.cross(b) / 2;
  }
  return sum;
}

/// Triangles that all face the polygon's way and whose areas add up to its area tile it.
void expect_tiled(const PolygonSoup& soup) {
  const Eigen::Vector3d whole = vector_area(soup);
  const Triangles triangles = triangulate(soup);
  ASSERT_EQ(triangles.rows(), static_cast<Eigen::Index>(soup.corners.size()) - 2);
  double sum = 0;
  for (const auto& t : triangles.rowwise()) {
    const Eigen::Vector3d a = soup.positions.row(t(0));
    const Eigen::Vector3d b = soup.positions.row(t(1));
    const Eigen::Vector3d c = soup.positions.row(t(2));
    const Eigen::Vector3d area = (b - a).cross(c - a) / 2;
    EXPECT_GT(area.dot(whole), -1e-12 * whole.squaredNorm());
    sum += area.norm();
  }
  EXPECT_NEAR(sum, whole.norm(), 1e-9 * whole.norm());
}

TEST(Triangulation, TilesStarShapedPolygons) {
  for (int corners = 4; corners < 60; ++corners) {
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(testing::Message() << corners << " corners, seed " << seed);
      expect_tiled(star_shaped(corners, seed));
    }
  }
}

TEST(Triangulation, TilesASpiral) {
  for (const Eigen::Index steps : {20, 50, 51, 200, 1000}) expect_tiled(spiral(steps));
}

TEST(Triangulation, TilesPolygonsOfManyCorners) {
  expect_tiled(star_shaped(101, 1));
  expect_tiled(star_shaped(3000, 2));
  expect_tiled(comb(2000));
}

/// All that the corners of a large polygon lie on is a line, or one point.
TEST(Triangulation, EndsOnDegeneratePolygonsOfManyCorners) {
  for (const double height : {0.0, 1e-320, 1e-15}) {
    PolygonSoup soup = comb(200);
    soup.positions.col(1) *= height;
    EXPECT_EQ(triangulate(soup).rows(), 400);
    soup.positions *= 0;
    EXPECT_EQ(triangulate(soup).rows(), 400);
  }
}

TEST(Triangulation, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW((void)triangulate(spiral(200), source.get_token()), Cancelled);
}

/// Copies of a square with vertices of their own have the same diagonal, wherever they begin.
TEST(Triangulation, OfASquareDoesNotDependOnItsFirstCorner) {
  Positions square(4, 3);
  square << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  for (int turn = 0; turn < 20; ++turn) {
    const Eigen::AngleAxisd rotation(turn, Eigen::Vector3d(1, 2, turn).normalized());
    const Positions turned = square * rotation.toRotationMatrix();
    for (const auto& corners : {std::vector<std::int32_t>{0, 1, 2, 3},
                                {1, 2, 3, 0},
                                {2, 3, 0, 1},
                                {3, 0, 1, 2},
                                {3, 2, 1, 0},
                                {0, 3, 2, 1}}) {
      const Triangles triangles = triangulate(soup_of(turned, {corners}));
      for (const auto& t : triangles.rowwise()) {
        EXPECT_TRUE((t.array() == 0).any() && (t.array() == 2).any()) << turn;
      }
    }
  }
}

TEST(Triangulation, TilesAPolygonWithACollinearCorner) {
  Positions positions(5, 3);
  positions << 0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 0, 3, 0;
  expect_tiled(soup_of(positions, {{0, 1, 2, 3, 4}}));
}

TEST(Triangulation, TilesAPolygonWithAHoleAndItsBridge) {
  Positions positions(8, 3);
  positions << 0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 1, 1, 0, 1, 3, 0, 3, 3, 0, 3, 1, 0;
  expect_tiled(soup_of(positions, {{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}}));
}

TEST(Triangulation, EndsOnDegeneratePolygons) {
  Positions point = Positions::Zero(12, 3);
  Positions line = Positions::Zero(12, 3);
  Positions bow = Positions::Zero(12, 3);
  for (int i = 0; i < 12; ++i) {
    line(i, 0) = i * 5 % 12;
    bow.row(i) << std::cos(5.0 * i), std::sin(5.0 * i), 0;  // a star that crosses itself
  }
  for (const Positions& positions : {point, line, bow}) {
    const PolygonSoup soup =
        soup_of(positions, {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, {0, 1, 2, 3}, {0, 1, 0, 1, 0}});
    EXPECT_EQ(triangulate(soup).rows(), 10 + 2 + 2);
  }
}

TEST(Triangulation, SkipsCornersThatRepeatTheOneBefore) {
  const Positions positions = cube().positions;
  const Triangles triangles =
      triangulate(soup_of(positions, {{0, 0, 1, 2, 2, 0}, {3}, {4, 5}, {}, {1, 2, 3}}));
  Triangles expected(4, 3);
  expected << 0, 1, 2, 3, 3, 3, 4, 5, 4, 1, 2, 3;
  EXPECT_EQ(triangles, expected);
}

TEST(Triangulation, KeepsASurfaceManifoldWhereTwoQuadrilateralsShareTwoEdges) {
  // A pyramid whose apex (4) two quadrilaterals share: both would like the diagonal 0-2 best.
  Positions positions(5, 3);
  positions << 0, 0, 0, 5, -1, 0, 1, 0, 0, 5, 1, 0, 0.5, 0, 3;
  positions.row(1) << 0.5, -5, 0;
  positions.row(3) << 0.5, 5, 0;
  const CleanSurface result =
      clean(soup_of(positions, {{0, 1, 2, 4}, {4, 2, 3, 0}, {0, 3, 2, 1}}), {});
  EXPECT_EQ(result.surface.positions.rows(), 5);
  EXPECT_EQ(result.surface.triangles.rows(), 6);
  EXPECT_EQ(result.changes.duplicate_faces_dropped, 0);
  expect_closed_outward_manifold(result.surface);
}

}  // namespace
}  // namespace curveskel::triangulate_laws
