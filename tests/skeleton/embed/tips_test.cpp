// Branches end where a person would end them: ahead, in the middle, and not in a corner.
#include "skeleton/embed/ends/tips.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::tips_laws {
namespace {

constexpr double reach = 1.5;
constexpr double gap = 1.15;

/// One arc along these points, the end of interest last.
SkeletonGraph arc_along(const std::vector<Point>& line) {
  SkeletonGraph graph;
  graph.nodes = {{line.front(), {0}}, {line.back(), {0}}};
  graph.arcs.push_back({0, 1, {line.begin() + 1, line.end() - 1}, {0}});
  for (Node& node : graph.nodes) node.arcs = {0};
  return graph;
}

std::vector<Point> along_x(double from, double to, double step) {
  std::vector<Point> line;
  for (double x = from; x < to; x += step) line.emplace_back(x, 0, 0);
  return line;
}

/// A neck of radius 0.5 that a head of radius 2 about x = 4 sits on.
shapes::Shape head_on_neck() {
  const auto radius = [](double t) {
    const double x = 12 * t - 6;
    return x > 2.1 ? std::sqrt(std::max(0.05, 4 - (x - 4) * (x - 4))) : 0.5;
  };
  return shapes::tube("head", shapes::straight(12), radius, 48);
}

TEST(Tips, GoOnFromTheNeckIntoTheHead) {
  const SurfaceTree tree(head_on_neck().surface);
  for (const double end : {0.5, 1.0, 1.5, 2.0, 2.5}) {
    SkeletonGraph graph = arc_along(along_x(-5, end, 0.2));
    shape_tips(graph, tree, reach, gap);
    const Point tip = graph.place(1);
    EXPECT_GT(tree.inscribed_radius(tip), 1.5) << "from " << end;
    EXPECT_LT(std::hypot(tip.y(), tip.z()), 0.1) << "from " << end;
  }
}

/// The end of a limb may be any number of radii off.
TEST(Tips, GoOnAlongAThinLimb) {
  const SurfaceTree tree(
      shapes::tube("limb", shapes::straight(1), shapes::constant(0.004), 24).surface);
  SkeletonGraph graph = arc_along(along_x(-0.1, 0.1, 0.002));
  shape_tips(graph, tree, reach, gap);
  EXPECT_LT(graph.place(0).x(), -0.5 + 1.5 * 0.004);
  EXPECT_GT(graph.place(1).x(), 0.5 - 1.5 * 0.004);
}

/// Whatever way the last of it went within the ball at the end of a blunt limb.
TEST(Tips, ThatCurlIntoACornerAreStraightened) {
  const SurfaceTree tree(
      shapes::tube("limb", shapes::straight(12), shapes::constant(1), 48).surface);
  for (const double angle : {0.0, 60.0, 90.0, 120.0}) {
    const double turn = angle * std::numbers::pi / 180;
    auto line = along_x(-4, 4.41, 0.2);
    for (int k = 1; k <= 4; ++k) {
      line.emplace_back(4.4 + 0.2 * k * std::cos(turn), 0.2 * k * std::sin(turn), 0);
    }
    SkeletonGraph graph = arc_along(line);
    shape_tips(graph, tree, reach, gap);
    const Point tip = graph.place(1);
    EXPECT_GT(tip.x(), 4.7) << angle << " degrees";
    EXPECT_LT(std::hypot(tip.y(), tip.z()), 0.15) << angle << " degrees";
  }
}

// Its ball narrows so evenly on the way into the corner that no place sees the rest as blunt.
TEST(Tips, InTheCornerOfAWideEndComeBack) {
  Surface wide = shapes::tube("limb", shapes::straight(12), shapes::constant(1), 48).surface;
  wide.positions.col(1) *= 1.5;
  const SurfaceTree tree(wide);
  auto line = along_x(-4, 4.91, 0.2);
  const Point bend(4.9, 0, 0);
  for (int k = 0; k <= 8; ++k) line.push_back(bend + 0.21 * k * Point(0.6, 0.8, 0));
  ASSERT_GT((line.back() - bend).norm(), reach * tree.inscribed_radius(bend));
  ASSERT_GT(tree.inscribed_radius(line.back()), 0);
  SkeletonGraph graph = arc_along(line);
  shape_tips(graph, tree, reach, gap);
  const Point tip = graph.place(1);
  EXPECT_GT(tip.x(), 4.7);
  EXPECT_LT(std::hypot(tip.y(), tip.z()), 0.3);
}

/// A limb of half-width 1 in y and `thickness` in z, along x from -6 to 6.
Surface limb(double thickness) {
  Surface limb = shapes::tube("limb", shapes::straight(12), shapes::constant(1), 48).surface;
  limb.positions.col(2) *= thickness;
  return limb;
}

// The last of the curve leads to the tip, so it says nothing about where the limb goes.
TEST(Tips, InACornerMoveIntoTheMiddle) {
  for (const double thickness : {1.0, 0.7}) {
    const SurfaceTree tree(limb(thickness));
    for (const double off : {-0.5, 0.2, 0.4}) {
      auto line = along_x(-4, 4.21, 0.2);
      for (int k = 1; k <= 5; ++k) line.emplace_back(4.2 + 0.2 * k, 0.2 * k * off, 0);
      SkeletonGraph graph = arc_along(line);
      const auto headings = tip_headings(graph, tree);
      ASSERT_EQ(headings.size(), 2U);
      const double least = 0.95 * tree.inscribed_radius(graph.place(1));
      for (int round = 0; round < 30; ++round) {
        centre_tips(graph, tree, headings);
        ASSERT_GE(tree.inscribed_radius(graph.place(1)), least);
      }
      const Point tip = graph.place(1);
      EXPECT_LT(std::hypot(tip.y(), tip.z()), 0.05) << off << ", thickness " << thickness;
      EXPECT_GT(tip.x(), 5) << off << ", thickness " << thickness;
    }
  }
}

// Of a curve without junctions both ends are tips; of a ring none is.
TEST(Tips, LookOutward) {
  const SurfaceTree tree(limb(1));
  const SkeletonGraph stick = arc_along(along_x(-5, 5.01, 0.2));
  for (const TipHeading& tip : tip_headings(stick, tree)) {
    const Point& position = stick.place(tip.node);
    EXPECT_NEAR(tip.direction.x(), position.x() < 0 ? -1 : 1, 1e-12);
    EXPECT_EQ(tip.radius, tree.inscribed_radius(position));
  }
  SkeletonGraph ring;
  ring.nodes = {{Point(1, 0, 0), {0, 0}}};
  ring.arcs.push_back({0, 0, {Point(0, 0.5, 0), Point(-1, 0, 0)}, {0}});
  EXPECT_TRUE(tip_headings(ring, tree).empty());
}

}  // namespace
}  // namespace curveskel::tips_laws
