#include <curveskel/advanced/inscribed_balls.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>

#include <curveskel/advanced/coarsen.hpp>
#include <curveskel/error.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::inscribed_balls_laws {
namespace {

// The vertices of a coarse surface lie outside a finer, convex one. Two in three balls touched that
// from outside, were taken for wrong and replaced by what their neighbours had; on rings that were
// fine enough a third of a ring had hardly any of its own, and the skeleton went there and back.
TEST(InscribedBalls, OfACoarsenedTubeReachItsAxis) {
  const auto fine = shapes::torus(3, 0.5, 64);
  const SurfaceTree tree(fine.surface);
  CoarsenOptions options;
  options.target_vertices = 2500;
  const Surface coarse = coarsen(fine.surface, options, {}).surface;
  ASSERT_LT(8 * coarse.positions.rows(), fine.surface.positions.rows());
  const InscribedBalls balls = inscribed_balls(coarse, tree, 0);
  Eigen::Index off = 0;
  for (Eigen::Index v = 0; v < coarse.positions.rows(); ++v) {
    const Eigen::Vector3d c = balls.centres.row(v);
    const double from_axis = std::hypot(std::hypot(c.x(), c.y()) - 3, c.z());
    const double from_vertex = (c.transpose() - coarse.positions.row(v)).norm();
    off += from_axis > 0.1 || std::abs(from_vertex - balls.radii[v]) > 0.05 ? 1 : 0;
  }
  EXPECT_LT(off, coarse.positions.rows() / 50);  // a tilted normal here and there
}

TEST(InscribedBalls, StopWhenAsked) {
  const auto ring = shapes::torus(3, 0.5, 24);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(
      (void)inscribed_balls(ring.surface, SurfaceTree(ring.surface), 0, source.get_token()),
      Cancelled);
}

TEST(InscribedBalls, SmoothedCentresStayOnAnAxis) {
  const auto ring = shapes::torus(3, 0.5, 24);
  const InscribedBalls balls = inscribed_balls(ring.surface, SurfaceTree(ring.surface), 0);
  EXPECT_EQ(smoothed_centres(ring.surface, balls, 0), balls.centres);
  const Positions centres = smoothed_centres(ring.surface, balls, 3);
  for (const auto& c : centres.rowwise()) {
    EXPECT_LT(std::hypot(std::hypot(c.x(), c.y()) - 3, c.z()), 0.1);
  }
}

}  // namespace
}  // namespace curveskel::inscribed_balls_laws
