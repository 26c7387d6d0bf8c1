#include <curveskel/advanced/tree.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include "tests/surface/tree_subjects.hpp"

namespace curveskel::tree_laws {
namespace {

using namespace tree_subjects;

TEST(SurfaceTree, NearestIsWhatTryingEveryTriangleFinds) {
  for (const auto& [name, surface] : all_shapes()) {
    SCOPED_TRACE(name);
    const SurfaceTree tree(surface);
    const double diagonal = bounding_box_diagonal(surface.positions);
    const double tolerance = 1e-12 * (diagonal + surface.positions.cwiseAbs().maxCoeff());
    Points points(surface);
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = points.next();
      const auto nearest = tree.nearest(p);
      const double expected = brute_distance(surface, p);
      ASSERT_NEAR(nearest.distance, expected, tolerance);
      ASSERT_NEAR((nearest.point - p).norm(), expected, tolerance);
      const int f = nearest.triangle;
      const Vector3d on_triangle = closest_in_triangle(
          nearest.point, corner(surface, f, 0), corner(surface, f, 1), corner(surface, f, 2));
      ASSERT_NEAR((on_triangle - nearest.point).norm(), 0, 100 * tolerance);
    }
  }
}

TEST(SurfaceTree, NearestHonoursTheLimitAndServesFarPoints) {
  const Surface surface = sphere(12, 0.3);
  const SurfaceTree tree(surface);
  Points points(surface);
  for (int i = 0; i < 200; ++i) {
    const Vector3d p = points.next();
    const double distance = tree.nearest(p).distance;
    EXPECT_EQ(tree.nearest(p, distance * 0.999).triangle, -1);
    EXPECT_EQ(tree.nearest(p, distance * 1.001).distance, distance);
    const Vector3d far = p * 1e6;
    EXPECT_NEAR(tree.nearest(far).distance / brute_distance(surface, far), 1, 1e-12);
  }
}

TEST(SurfaceTree, RaysHitWhereTheWindingNumberChanges) {
  for (const auto& [name, surface] : all_shapes()) {
    SCOPED_TRACE(name);
    const SurfaceTree tree(surface);
    const double diagonal = bounding_box_diagonal(surface.positions);
    Points points(surface);
    int hits = 0;
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = points.next();
      const auto face = i * 7 % static_cast<int>(surface.triangles.rows());
      const Vector3d d =
          ((corner(surface, face, 0) + corner(surface, face, 1) + corner(surface, face, 2)) / 3 - p)
              .normalized();
      const double start = std::round(winding_number(surface, p));
      const auto hit = tree.ray(p, d);
      const double step = 1e-6 * diagonal;
      if (hit.triangle < 0) {
        ASSERT_EQ(start, 0);
        continue;
      }
      ++hits;
      ASSERT_LT(tree.nearest(p + hit.distance * d).distance,
                1e-12 * (diagonal + surface.positions.cwiseAbs().maxCoeff()));
      EXPECT_EQ(std::round(winding_number(surface, p + (hit.distance - step) * d)), start);
      EXPECT_NE(std::round(winding_number(surface, p + (hit.distance + step) * d)), start);
      EXPECT_EQ(tree.ray(p, d, hit.distance * (1 - 1e-9)).triangle, -1);
      EXPECT_EQ(tree.ray(p, d, hit.distance * (1 + 1e-9)).triangle, hit.triangle);
    }
    EXPECT_GT(hits, 5);
  }
}

TEST(SurfaceTree, NoRaySlipsThroughSharedEdgesAndVertices) {
  for (const Vector3d& offset : {Vector3d(0, 0, 0), Vector3d(1e3, -7e3, 3e3)}) {
    for (const Surface& shape : {sphere(16), sphere(12, 0.1), unit_cube()}) {
      const Surface surface = placed(shape, 1, offset);
      const SurfaceTree tree(surface);
      const Vector3d centre = surface.positions.colwise().mean();
      for (int f = 0; f < surface.triangles.rows(); ++f) {
        for (int k = 0; k < 3; ++k) {
          const Vector3d a = corner(surface, f, k);
          const Vector3d b = corner(surface, f, (k + 1) % 3);
          for (const double t : {0.0, 0.5, 0.25, 0.1}) {
            const Vector3d target = a + t * (b - a);
            const auto hit = tree.ray(centre, (target - centre).normalized());
            ASSERT_GE(hit.triangle, 0);
            ASSERT_NEAR(hit.distance, (target - centre).norm(), 1e-9 * (1 + offset.norm()));
            const Vector3d outside = centre + 5 * (target - centre);
            ASSERT_GE(tree.ray(outside, (centre - outside).normalized()).triangle, 0);
          }
        }
      }
    }
  }
}

TEST(SurfaceTree, RaysInAPlaneAreRays) {
  for (const auto& [name, surface] : all_shapes()) {
    SCOPED_TRACE(name);
    const SurfaceTree tree(surface);
    const double diagonal = bounding_box_diagonal(surface.positions);
    Points points(surface);
    for (int i = 0; i < 100; ++i) {
      const Vector3d p = points.next();
      const Vector3d n = (points.next() - p).normalized();
      const Vector3d u = n.unitOrthogonal();
      std::vector<Vector3d> directions(12);
      for (int k = 0; k < 12; ++k) {
        directions[k] = std::cos(pi * k / 6) * u + std::sin(pi * k / 6) * n.cross(u);
      }
      std::vector<double> distances(directions.size());
      for (const double limit : {0.1 * diagonal, infinity}) {
        tree.rays_in_plane(p, n, directions, limit, distances);
        for (std::size_t k = 0; k < directions.size(); ++k) {
          ASSERT_EQ(distances[k], tree.ray(p, directions[k], limit).distance);
        }
      }
    }
  }
}

TEST(SurfaceTree, NearAPlaneAreAllTrianglesThatItCrosses) {
  for (const auto& [name, surface] : all_shapes()) {
    SCOPED_TRACE(name);
    const SurfaceTree tree(surface);
    Points points(surface);
    std::size_t found = 0;
    std::size_t crossed = 0;
    for (int i = 0; i < 40; ++i) {
      const Vector3d p = points.next();
      const Vector3d n = (points.next() - p).normalized();
      const std::vector<int> near = tree.near_plane(p, n);
      ASSERT_TRUE(std::is_sorted(near.begin(), near.end()));
      ASSERT_EQ(std::adjacent_find(near.begin(), near.end()), near.end());
      found += near.size();
      for (int f = 0; f < surface.triangles.rows(); ++f) {
        int above = 0;
        for (int k = 0; k < 3; ++k) above += (corner(surface, f, k) - p).dot(n) >= 0 ? 1 : 0;
        if (above == 0 || above == 3) continue;
        ++crossed;
        ASSERT_TRUE(std::binary_search(near.begin(), near.end(), f));
      }
    }
    const auto all = static_cast<std::size_t>(surface.triangles.rows());
    // Leaves hold four: of a fine surface a plane comes near few that it misses.
    if (all > 1000) {
      ASSERT_LT(found, 8 * crossed + 4000);
    }
  }
}

TEST(SurfaceTree, ComesNearWhereALineIsNearest) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).matrix();
  for (const auto& [name, surface] : all_shapes()) {
    SCOPED_TRACE(name);
    const SurfaceTree whole(surface);
    const double diagonal = bounding_box_diagonal(surface.positions);
    const Vector3d away = diagonal * Vector3d(5, 6, 7);
    const SurfaceTree tree = whole.in_frame(turn, away, 3);
    Points points(surface);
    int asked = 0;
    for (int i = 0; i < 400; ++i) {
      const Vector3d from = turn * points.next() * 3 + away;
      const Vector3d far = turn * points.next() * 3 + away;
      const Vector3d to = from + (far - from) / (1 << (i % 8));
      const double length = (to - from).norm();
      if (tree.ray(from, (to - from) / length, length).triangle >= 0) continue;
      constexpr int samples = 200;
      double nearest = infinity;
      for (int k = 0; k <= samples; ++k) {
        const Vector3d place = from + double(k) / samples * (to - from);
        nearest = std::min(nearest, tree.nearest(place).distance);
      }
      ASSERT_TRUE(tree.comes_near(from, to, nearest + 1e-9 * diagonal));
      const double less = nearest - 0.5 * length / samples;
      if (less <= 1e-9 * diagonal) continue;
      ASSERT_FALSE(tree.comes_near(from, to, less - 1e-9 * diagonal));
      ++asked;
    }
    EXPECT_GT(asked, 30);
  }
}

TEST(SurfaceTree, InsideIsANonZeroWindingNumber) {
  for (const auto& [name, surface] : all_shapes()) {
    SCOPED_TRACE(name);
    const SurfaceTree tree(surface);
    Points points(surface);
    int inside = 0;
    for (int i = 0; i < 400; ++i) {
      const Vector3d p = points.next();
      const bool expected = std::abs(winding_number(surface, p)) > 0.5;
      inside += static_cast<int>(expected);
      ASSERT_EQ(tree.inside(p), expected);
      const double radius = tree.inscribed_radius(p);
      ASSERT_EQ(radius > 0, expected);
      ASSERT_EQ(std::abs(radius), tree.nearest(p).distance);
    }
    if (name != "long triangles") {
      EXPECT_GT(inside, 10);
    }
  }
}

// Nodes a few last digits below the surface had infinite radii.
TEST(SurfaceTree, ABallThatIsKnownHelpsHoweverSmall) {
  for (const auto& [name, shape] : all_shapes()) {
    const Surface& surface = shape;
    const SurfaceTree tree(surface);
    const double size = bounding_box_diagonal(surface.positions);
    std::mt19937_64 random(3);
    for (int k = 0; k < 400; ++k) {
      const auto faces = static_cast<std::uint64_t>(surface.triangles.rows());
      const auto face = static_cast<Eigen::Index>(random() % faces);
      const auto corner = [&](int c) {
        return Vector3d(surface.positions.row(surface.triangles(face, c)).transpose());
      };
      const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
      const Vector3d middle = (corner(0) + corner(1) + corner(2)) / 3;
      const double depth = size * std::pow(10.0, -(k % 16));
      const Vector3d centre = middle - depth * normal;
      const double radius = tree.inscribed_radius(centre);
      if (!(radius > 0)) continue;
      const Vector3d p = centre + 0.5 * radius * normal.unitOrthogonal();
      const double plain = tree.inscribed_radius(p);
      EXPECT_NEAR(tree.inscribed_radius(p, {centre, radius}), std::abs(plain), 1e-12 * size)
          << name;
    }
  }
}

TEST(SurfaceTree, InsideHoldsOnGridPointsThatAreAlignedWithEdges) {
  const SurfaceTree tree(unit_cube());
  for (int i = -4; i <= 12; ++i) {
    for (int j = -4; j <= 12; ++j) {
      for (int k = -4; k <= 12; ++k) {
        const Vector3d p = Vector3d(i, j, k) / 8;
        const double margin = std::min({p.x(), p.y(), p.z(), 1 - p.x(), 1 - p.y(), 1 - p.z()});
        if (margin == 0) continue;
        ASSERT_EQ(tree.inside(p), margin > 0) << p.transpose();
        if (margin > 0) {
          ASSERT_NEAR(tree.inscribed_radius(p), margin, 1e-15);
        }
      }
    }
  }
}

TEST(SurfaceTree, AnInwardSurfaceWindsToo) {
  Surface surface = sphere(8);
  surface.triangles.col(0).swap(surface.triangles.col(1));
  const SurfaceTree tree(surface);
  EXPECT_TRUE(tree.inside({0.1, 0.2, 0.3}));
  EXPECT_FALSE(tree.inside({1.1, 0.2, 0.3}));
}

TEST(SurfaceTree, TheOrderOfTheTrianglesDoesNotMatter) {
  const Surface surface = sphere(16, 0.3);
  Surface shuffled = surface;
  std::vector<int> order(static_cast<std::size_t>(surface.triangles.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.triangles.row(static_cast<Eigen::Index>(i)) = surface.triangles.row(order[i]);
  }
  const SurfaceTree tree(surface);
  const SurfaceTree other(shuffled);
  Points points(surface);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p = points.next();
    const Vector3d d = points.direction();
    EXPECT_DOUBLE_EQ(tree.inscribed_radius(p), other.inscribed_radius(p));
    EXPECT_EQ(tree.ray(p, d).distance, other.ray(p, d).distance);
    const auto ball = tree.inscribed_ball(surface.positions.row(i).transpose(), d);
    const auto same = other.inscribed_ball(surface.positions.row(i).transpose(), d);
    EXPECT_TRUE(ball.radius == same.radius || std::abs(ball.radius / same.radius - 1) < 0.006);
  }
}

TEST(SurfaceTree, IsTheSameFromAnyNumberOfThreads) {
  const Surface surface = sphere(120, 0.3);  // more than one thread's part
  ASSERT_GT(surface.triangles.rows(), 20000);
  const SurfaceTree alone(surface, 1);
  for (const int threads : {2, 5}) {
    const SurfaceTree tree(surface, threads);
    Points points(surface);
    for (int i = 0; i < 300; ++i) {
      const Vector3d p = points.next();
      const Vector3d d = points.direction();
      const SurfaceTree::Nearest nearest = tree.nearest(p);
      EXPECT_EQ(nearest.triangle, alone.nearest(p).triangle);
      EXPECT_EQ(nearest.distance, alone.nearest(p).distance);
      EXPECT_EQ(tree.ray(p, d).triangle, alone.ray(p, d).triangle);
      EXPECT_EQ(tree.inscribed_radius(p), alone.inscribed_radius(p));
      const Vector3d vertex = surface.positions.row(i).transpose();
      EXPECT_EQ(tree.inscribed_ball(vertex, d).radius, alone.inscribed_ball(vertex, d).radius);
    }
  }
}

TEST(SurfaceTree, DegenerateTrianglesChangeNothing) {
  const Surface surface = sphere(8, 0.2);
  Surface with = surface;
  const auto faces = surface.triangles.rows();
  with.triangles.conservativeResize(faces + 40, 3);
  for (Eigen::Index i = 0; i < 40; ++i) {
    const auto corners = surface.triangles.row(i);
    with.triangles.row(faces + i) << corners[0], corners[1], i % 2 == 0 ? corners[0] : corners[1];
  }
  const SurfaceTree tree(surface);
  const SurfaceTree other(with);
  Points points(surface);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p = points.next();
    EXPECT_DOUBLE_EQ(tree.inscribed_radius(p), other.inscribed_radius(p));
    const Vector3d d = points.direction();
    EXPECT_EQ(tree.ray(p, d).distance, other.ray(p, d).distance);
  }
}

TEST(SurfaceTree, OneTriangleAndManyCoincidentOnesWork) {
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const std::size_t copies : {1UL, 5UL, 1000UL}) {
    const SurfaceTree tree(surface_of(points, std::vector<std::array<int, 3>>(copies, {0, 1, 2})));
    EXPECT_EQ(tree.nearest({0.25, 0.25, 2}).distance, 2);
    EXPECT_EQ(tree.ray({0.25, 0.25, 2}, {0, 0, -1}).distance, 2);
    EXPECT_EQ(tree.ray({0.25, 0.25, 2}, {0, 0, 1}).triangle, -1);
  }
}

}  // namespace
}  // namespace curveskel::tree_laws
