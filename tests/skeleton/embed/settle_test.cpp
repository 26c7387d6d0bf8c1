// Laws of the last places of points: on the axis, smooth, and there after few rounds.
#include "skeleton/embed/place/settle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/embed/place/spacing.hpp"
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel::settle_laws {
namespace {

SkeletonGraph wavy_arc(double radius) {
  constexpr int points = 40;
  SkeletonGraph graph;
  std::vector<CurvePoint> between;
  const auto at = [&](int i) {
    const double x = -0.4 + 0.8 * i / points;
    const double off = 0.5 * radius * std::sin(7.0 * i);
    return Point(x, off, -off);
  };
  for (int i = 1; i < points; ++i) between.emplace_back(at(i));
  graph.nodes = {{Point(-0.4, 0, 0), {0}, true, {0}}, {Point(0.4, 0, 0), {0}, true, {0}}};
  graph.arcs.push_back({0, 1, std::move(between), {0}});
  return graph;
}

SettleOptions all_own() {
  SettleOptions options;
  options.is_own = [](int, int) { return true; };
  return options;
}

double farthest_from_axis(const SkeletonGraph& graph) {
  double most = 0;
  for (const CurvePoint& point : graph.arcs.front().points) {
    most = std::max(most, std::hypot(point.place().y(), point.place().z()));
  }
  return most;
}

TEST(Settle, PutsAWavyCurveOnTheAxisOfItsTube) {
  for (const double radius : {0.01, 0.05, 0.1}) {
    const SurfaceTree tree(
        shapes::tube("tube", shapes::straight(1), shapes::constant(radius), 24).surface);
    SkeletonGraph graph = wavy_arc(radius);
    HomologyGuard guard;
    settle(graph, tree, all_own(), guard, 1);
    EXPECT_LT(farthest_from_axis(graph), 0.03 * radius) << radius;
  }
}

/// A band is as wide as the tube, whatever its thickness: so is the way to its middle.
TEST(Settle, TakesAThinBandLikeATube) {
  for (const double thickness : {0.2, 0.02, 0.002}) {
    constexpr double width = 0.1;
    Surface band = shapes::tube("band", shapes::straight(1), shapes::constant(width), 80).surface;
    band.positions.col(2) *= thickness;
    const SurfaceTree tree(band);
    SkeletonGraph graph = wavy_arc(width);
    for (CurvePoint& point : graph.arcs.front().points) {
      point = Point(point.place().x(), point.place().y(), 0);
    }
    HomologyGuard guard;
    // As often as the embedding asks for it: each time the steps are held to the radii gained.
    for (int time = 0; time < 3; ++time) settle(graph, tree, all_own(), guard, 1);
    EXPECT_LT(farthest_from_axis(graph), 0.05 * width) << thickness;
  }
}

// Where two points coincided their arc's system was singular: all goals of the arc were NaN, none
// of its points moved, and each looked for its nearest triangle in the whole surface.
TEST(Settle, CentresAnArcOfWhichTwoPointsCoincide) {
  constexpr double radius = 0.05;
  const SurfaceTree tree(
      shapes::tube("tube", shapes::straight(1), shapes::constant(radius), 24).surface);
  SkeletonGraph graph = wavy_arc(radius);
  auto& points = graph.arcs.front().points;
  const auto tenth = points.begin() + 10;
  const CurvePoint again = *tenth;
  points.insert(tenth, again);
  HomologyGuard guard;
  settle(graph, tree, all_own(), guard, 1);
  EXPECT_LT(farthest_from_axis(graph), 0.03 * radius);
}

/// Points that slide towards each other leave long gaps and never rest.
TEST(Settle, LeavesPointsWhereTheyLieAlongTheCurve) {
  const SurfaceTree tree(
      shapes::tube("cone", shapes::straight(1), shapes::tapered(0.02, 0.08), 24).surface);
  SkeletonGraph graph = wavy_arc(0.01);
  space_by_radius(graph, tree, {1.0 / 400, 1});
  std::vector<double> before;
  for (const CurvePoint& point : graph.arcs.front().points) before.push_back(point.place().x());
  HomologyGuard guard;
  settle(graph, tree, all_own(), guard, 1);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const CurvePoint& point = graph.arcs.front().points[i];
    EXPECT_NEAR(point.place().x(), before[i], 0.1 * point.radius(tree)) << i;
  }
}

TEST(Settle, GivesTheSameForAnyNumberOfThreads) {
  const SurfaceTree tree(
      shapes::tube("tube", shapes::straight(1), shapes::constant(0.05), 24).surface);
  SkeletonGraph one = wavy_arc(0.05);
  SkeletonGraph three = one;
  HomologyGuard guard;
  settle(one, tree, all_own(), guard, 1);
  settle(three, tree, all_own(), guard, 3);
  EXPECT_EQ(one.polyline(one.arcs.front()), three.polyline(three.arcs.front()));
}

}  // namespace
}  // namespace curveskel::settle_laws
