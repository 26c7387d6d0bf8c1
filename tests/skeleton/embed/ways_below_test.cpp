// Just below a surface there is a way from each point inside to each other, unless the surface goes
// through itself all round.
#include "skeleton/embed/contain/ways_below.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <stop_token>
#include <vector>

#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/error.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel::ways_below_laws {
namespace {

Surface of_unit_size(const Surface& surface) {
  return {surface.positions / bounding_box_diagonal(surface.positions), surface.triangles};
}

/// Asked every half a thousandth of D.
bool stays_inside(const SurfaceTree& tree, const std::vector<Point>& line) {
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const int steps = 1 + static_cast<int>((line[k + 1] - line[k]).norm() / 5e-4);
    for (int s = 0; s <= steps; ++s) {
      if (!tree.inside(line[k] + double(s) / steps * (line[k + 1] - line[k]))) return false;
    }
  }
  return true;
}

double length_of(const std::vector<Point>& line) {
  double length = 0;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) length += (line[k + 1] - line[k]).norm();
  return length;
}

/// A figure of eight in the xy plane.
Eigen::Vector3d eight(double t) {
  const double angle = 2 * std::numbers::pi * t;
  return {3 * std::sin(angle), 1.5 * std::sin(2 * angle), 0};
}

std::vector<shapes::Shape> family() {
  std::vector<shapes::Shape> all;
  all.push_back(shapes::torus(3, 1, 12));
  all.push_back(shapes::tube("trefoil", shapes::trefoil(1), shapes::constant(0.2), 8));
  all.push_back(shapes::tube("helix", shapes::helix(1, 0.2, 3), shapes::constant(0.03), 6));
  all.push_back(shapes::box({1, 1, 0.002}, 20));
  all.push_back(shapes::sieve(3));
  return all;
}

TEST(WaysBelow, StayInsideOnAnyShape) {
  for (const shapes::Shape& shape : family()) {
    const Surface surface = of_unit_size(shape.surface);
    const SurfaceTree tree(surface);
    const InscribedBalls balls = inscribed_balls(surface, tree, 1);
    WaysBelow ways(surface, tree);
    shapes::Random random(1);
    for (int pair = 0; pair < 30; ++pair) {
      const auto any = [&] {
        return Point(balls.centres.row(static_cast<int>(random.index(balls.centres.rows()))));
      };
      const Point from = any();
      const Point to = any();
      const auto way = ways.between(from, to);
      ASSERT_TRUE(way) << shape.name << ", pair " << pair;
      std::vector<Point> line{from};
      line.insert(line.end(), way->begin(), way->end());
      line.push_back(to);
      EXPECT_TRUE(stays_inside(tree, line)) << shape.name << ", pair " << pair;
    }
  }
}

// The tube's own sheets cross each other in the middle of the eight. Right below one of them there
// may be no inside, so that a way has to go round.
TEST(WaysBelow, GoRoundPlacesWhereTheSurfaceGoesThroughItself) {
  const Surface whole = shapes::tube("eight", eight, shapes::constant(0.5), 12).surface;
  const Surface surface = of_unit_size(whole);
  const SurfaceTree tree(surface);
  WaysBelow ways(surface, tree);
  const double size = 1 / bounding_box_diagonal(whole.positions);
  for (const double t : {0.01, 0.02, 0.05}) {  // before and behind the crossing
    const Point from = size * eight(-t);
    const Point to = size * eight(t);
    const auto way = ways.between(from, to);
    ASSERT_TRUE(way) << t;
    std::vector<Point> line{from};
    line.insert(line.end(), way->begin(), way->end());
    line.push_back(to);
    EXPECT_TRUE(stays_inside(tree, line)) << t;
  }
}

/// Round a ring there are as many as one likes; the second goes the other way.
TEST(WaysBelow, AreAsGoodAsIsWanted) {
  const Surface surface = of_unit_size(shapes::torus(3, 1, 12).surface);
  const SurfaceTree tree(surface);
  HomologyGuard handles(surface);
  WaysBelow ways(surface, tree);
  const double radius = 3 / bounding_box_diagonal(shapes::torus(3, 1, 12).surface.positions);
  const Point from(radius, 0, 0);
  const Point to(0, radius, 0);
  std::vector<std::vector<Point>> offered;
  const auto whole = [&](const std::vector<Point>& way) {
    std::vector<Point> line{from};
    line.insert(line.end(), way.begin(), way.end());
    line.push_back(to);
    return line;
  };
  const auto way = ways.between(from, to, handles, [&](const std::vector<Point>& one) {
    offered.push_back(whole(one));
    return offered.size() == 2;
  });
  ASSERT_TRUE(way);
  EXPECT_EQ(whole(*way), offered.back());
  EXPECT_FALSE(handles.homologous(offered.front(), offered.back()));
  for (const auto& line : offered) EXPECT_TRUE(stays_inside(tree, line));
  EXPECT_LT(length_of(offered.front()), length_of(offered.back()));
  EXPECT_FALSE(ways.between(from, to, handles, [](const std::vector<Point>&) { return false; }));
}

TEST(WaysBelow, AreNoneBetweenComponents) {
  const shapes::Shape two = shapes::linked_rings(3, 0.5, 8);
  const Surface surface = of_unit_size(two.surface);
  const SurfaceTree tree(surface);
  const InscribedBalls balls = inscribed_balls(surface, tree, 1);
  WaysBelow ways(surface, tree);
  const Point first = balls.centres.row(0);
  const Point last = balls.centres.row(balls.centres.rows() - 1);
  EXPECT_FALSE(ways.between(first, last));
}

TEST(WaysBelow, StopWhenAsked) {
  const Surface surface = of_unit_size(shapes::torus(3, 1, 12).surface);
  const SurfaceTree tree(surface);
  const InscribedBalls balls = inscribed_balls(surface, tree, 1);
  std::stop_source source;
  source.request_stop();
  WaysBelow ways(surface, tree, source.get_token());
  const Point first = balls.centres.row(0);
  const Point other = balls.centres.row(balls.centres.rows() / 2);
  EXPECT_THROW((void)ways.between(first, other), Cancelled);
}

}  // namespace
}  // namespace curveskel::ways_below_laws
