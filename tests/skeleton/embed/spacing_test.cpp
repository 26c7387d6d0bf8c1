// Laws of the points that are left on straight runs.
#include "skeleton/embed/place/spacing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/tuning.hpp"

namespace curveskel::spacing_laws {
namespace {

constexpr double thin = 0.01;  // the radius of all tubes here
constexpr double apart = 0.05;

/// Many points along a curve's middle part, t from 0.1 to 0.9.
SkeletonGraph along(const shapes::Curve& curve) {
  constexpr int pieces = 200;
  const auto at = [&](int i) -> Point { return curve(0.1 + 0.8 * i / pieces); };
  std::vector<CurvePoint> between;
  for (int i = 1; i < pieces; ++i) between.emplace_back(at(i));
  SkeletonGraph graph;
  graph.nodes = {{at(0), {0}, true, {0}}, {at(pieces), {0}, true, {0}}};
  graph.arcs.push_back({0, 1, std::move(between), {0}});
  return graph;
}

std::vector<Point> thinned(SkeletonGraph graph, const SurfaceTree& tree) {
  SpacingTuning tuning;
  thin_straight_runs(graph, tree, {tuning.least, tuning.most, apart}, tuning);
  return graph.polyline(graph.arcs.front());
}

double distance(const Point& p, const Point& from, const Point& to) {
  const Point way = to - from;
  const double share = std::clamp((p - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (p - from - share * way).norm();
}

double farthest(const std::vector<Point>& points, const std::vector<Point>& from) {
  double most = 0;
  for (const Point& p : points) {
    double nearest = 1;
    for (std::size_t i = 0; i + 1 < from.size(); ++i) {
      nearest = std::min(nearest, distance(p, from[i], from[i + 1]));
    }
    most = std::max(most, nearest);
  }
  return most;
}

TEST(StraightRuns, HavePointsAsFarApartAsTheyMay) {
  const auto line = shapes::straight(1);
  const SurfaceTree tree(shapes::tube("tube", line, shapes::constant(thin), 24).surface);
  const auto left = thinned(along(line), tree);
  for (std::size_t i = 0; i + 1 < left.size(); ++i) {
    EXPECT_LE((left[i + 1] - left[i]).norm(), apart);
  }
  EXPECT_LE(left.size(), 2 * 0.8 / apart + 1);  // halves of stretches that were too long
}

TEST(StraightRuns, KeepTheBends) {
  for (const auto& curve :
       {shapes::arc(0.3, std::numbers::pi), shapes::s_curve(1, 0.4), shapes::helix(0.2, 0.3, 2)}) {
    const SurfaceTree tree(shapes::tube("tube", curve, shapes::constant(thin), 24).surface);
    const SkeletonGraph graph = along(curve);
    const auto all = graph.polyline(graph.arcs.front());
    const auto left = thinned(graph, tree);
    EXPECT_LT(left.size(), all.size() / 2);
    EXPECT_LE(farthest(all, left), 0.11 * thin);
  }
}

TEST(StraightRuns, AreTheSameFromEitherEnd) {
  const auto curve = shapes::s_curve(1, 0.4);
  const SurfaceTree tree(shapes::tube("tube", curve, shapes::constant(thin), 24).surface);
  const auto left = thinned(along(curve), tree);
  auto back = thinned(along([&](double t) { return curve(1 - t); }), tree);
  std::reverse(back.begin(), back.end());
  ASSERT_EQ(left.size(), back.size());
  for (std::size_t i = 0; i < left.size(); ++i) EXPECT_LT((left[i] - back[i]).norm(), 0.02);
}

/// Where a chord would leave the limb its points stay, however far apart they may be.
TEST(StraightRuns, StayInsideThinSheets) {
  constexpr double hair = 2e-4;
  const auto curve = shapes::arc(0.3, std::numbers::pi);
  const SurfaceTree tree(shapes::tube("tube", curve, shapes::constant(hair), 24).surface);
  const auto left = thinned(along(curve), tree);
  for (std::size_t i = 0; i + 1 < left.size(); ++i) {
    EXPECT_GT(tree.inscribed_radius(0.5 * (left[i] + left[i + 1])), 0);
  }
}

/// Of three arcs without points between two nodes two get one, a closed arc two; a fourth arc,
/// which has points, and one between other nodes stay.
TEST(Spacing, TellsArcsBetweenTheSameNodesApart) {
  SkeletonGraph graph;
  const auto add = [&](int from, int to, const std::vector<Point>& points) {
    const int arc = static_cast<int>(graph.arcs.size());
    graph.arcs.push_back({from, to, {points.begin(), points.end()}, {0}});
    graph.nodes[static_cast<std::size_t>(from)].arcs.push_back(arc);
    graph.nodes[static_cast<std::size_t>(to)].arcs.push_back(arc);
  };
  graph.nodes = {{Point(0, 0, 0), {}}, {Point(1, 0, 0), {}}, {Point(2, 0, 0), {}}};
  add(0, 1, {});
  add(1, 0, {});
  add(0, 1, {});
  add(0, 1, {Point(0.5, 1, 0)});
  add(1, 2, {});
  add(2, 2, {});
  tell_twins_apart(graph);
  const std::vector<std::size_t> points{0, 1, 1, 1, 0, 3};
  for (std::size_t s = 0; s < points.size(); ++s) {
    EXPECT_EQ(graph.arcs[s].points.size(), points[s]) << s;
  }
}

}  // namespace
}  // namespace curveskel::spacing_laws
