// Laws of the largest balls inside a surface that touch it at a point.
#include <curveskel/advanced/tree.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <curveskel/advanced/measures.hpp>
#include "tests/surface/tree_subjects.hpp"

namespace curveskel::tree_balls_laws {
namespace {

using namespace tree_subjects;

TEST(SurfaceTree, BallsOfRoundShapesHaveTheirRadius) {
  struct Case {
    Surface surface;
    double radius;
  };
  for (const auto& [surface, radius] : {Case{sphere(48), 1.0}, Case{torus(0.25, 96, 24), 0.25}}) {
    for (const double scale : {1.0, 1e-9, 1e9}) {
      const Surface scaled = placed(surface, scale, {scale, 0, 0});
      const SurfaceTree tree(scaled);
      const Positions normals = vertex_normals(scaled);
      for (int v = 0; v < scaled.positions.rows(); v += 17) {
        const Vector3d p = scaled.positions.row(v);
        const Vector3d n = -normals.row(v).transpose();
        const auto ball = tree.inscribed_ball(p, n);
        ASSERT_NEAR(ball.radius, radius * scale, 0.02 * radius * scale);
        ASSERT_NEAR((ball.centre - p - ball.radius * n).norm(), 0, 1e-12 * scale);
      }
    }
  }
}

TEST(SurfaceTree, BallsFromTheFacesOfACubeTouchWhatTheyShould) {
  const SurfaceTree tree(unit_cube());
  std::mt19937 generator(3);
  std::uniform_real_distribution<> uniform(0.01, 0.99);
  for (int i = 0; i < 200; ++i) {
    const double x = uniform(generator);
    const double y = uniform(generator);
    // From z = 0 upward: the opposite face at 1, or a wall at the nearest side.
    const double expected = std::min({0.5, x, y, 1 - x, 1 - y});
    const auto ball = tree.inscribed_ball({x, y, 0}, {0, 0, 1});
    ASSERT_GE(ball.radius, expected * (1 - 1e-12));
    ASSERT_LE(ball.radius, expected / 0.995);
  }
}

TEST(SurfaceTree, BallsAreWhatDenseSamplingFinds) {
  constexpr double min_sine = 0.17364817766693033;
  constexpr int steps = 24;
  for (const Surface& surface : {sphere(12, 0.3), torus(0.3, 14, 9), torus(0.05, 6, 20)}) {
    const SurfaceTree tree(surface);
    int bounded = 0;
    const Positions normals = vertex_normals(surface);
    for (int v = 0; v < surface.positions.rows(); v += 3) {
      const Vector3d p = surface.positions.row(v);
      const Vector3d n = -normals.row(v).transpose();
      double sampled = std::numeric_limits<double>::infinity();
      for (int f = 0; f < surface.triangles.rows(); ++f) {
        const bool at_p = (surface.triangles.row(f).array() == v).any();
        for (int i = 0; i <= steps; ++i) {
          for (int j = 0; i + j <= steps; ++j) {
            const bool at_vertex = i == steps || j == steps || i + j == 0;
            if (at_p && !at_vertex) continue;
            const Vector3d e = (corner(surface, f, 0) * i + corner(surface, f, 1) * j +
                                corner(surface, f, 2) * (steps - i - j)) /
                                   steps -
                               p;
            const double height = n.dot(e);
            if (height < (at_vertex ? min_sine : 0.5) * e.norm() || e.norm() < 1e-9) continue;
            sampled = std::min(sampled, e.squaredNorm() / (2 * height));
          }
        }
      }
      const auto ball = tree.inscribed_ball(p, n);
      if (std::isinf(sampled)) {
        EXPECT_TRUE(std::isinf(ball.radius));
        continue;
      }
      ++bounded;
      EXPECT_LE(ball.radius, sampled * 1.05);
      EXPECT_GE(ball.radius, sampled * 0.95);
    }
    EXPECT_GT(bounded, 30);
  }
}

}  // namespace
}  // namespace curveskel::tree_balls_laws
