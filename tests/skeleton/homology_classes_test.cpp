#include "skeleton/homology/homology_classes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <stop_token>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/error.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/homology/homology_guard.hpp"
#include "skeleton/homology/homology_rank.hpp"
#include "skeleton/homology/linking.hpp"

namespace curveskel::homology_classes_laws {
namespace {

using Eigen::Vector3d;
using shapes::Shape;

constexpr double pi = std::numbers::pi;

/// On the core of a ring of radius 3, pushed aside by `aside`.
Vector3d on_ring(double angle, double aside = 0) {
  return {(3 + aside) * std::cos(angle), (3 + aside) * std::sin(angle), 0.3 * aside};
}

std::vector<Vector3d> arc(double from, double to, double aside = 0) {
  std::vector<Vector3d> points;
  constexpr int steps = 60;
  for (int k = 0; k <= steps; ++k) {
    points.push_back(on_ring(from + (to - from) * k / steps, aside));
  }
  return points;
}

/// The polygons as closed curves, each a component.
CurveSkeleton closed(const std::vector<std::vector<Vector3d>>& polygons) {
  CurveSkeleton skeleton;
  std::vector<std::pair<int, int>> edges;
  std::vector<Vector3d> nodes;
  for (const auto& polygon : polygons) {
    const auto first = static_cast<int>(nodes.size());
    const auto count = static_cast<int>(polygon.size());
    for (int k = 0; k + 1 < count; ++k) edges.emplace_back(first + k, first + k + 1);
    edges.emplace_back(first, first + count - 1);
    nodes.insert(nodes.end(), polygon.begin(), polygon.end());
  }
  std::sort(edges.begin(), edges.end());
  skeleton.nodes.resize(static_cast<Eigen::Index>(nodes.size()), 3);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    skeleton.nodes.row(static_cast<Eigen::Index>(n)) = nodes[n];
  }
  skeleton.edges.resize(static_cast<Eigen::Index>(edges.size()), 2);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    skeleton.edges.row(static_cast<Eigen::Index>(e)) << edges[e].first, edges[e].second;
  }
  return skeleton;
}

/// Goes two thirds round the ring and comes back beside its way there.
std::vector<Vector3d> there_and_back() {
  auto points = arc(0, 4 * pi / 3, 0.1);
  const auto back = arc(4 * pi / 3, 0, -0.1);
  points.insert(points.end(), back.begin(), back.end());
  return points;
}

std::vector<Vector3d> once_round(double aside = 0) {
  auto points = arc(0, 2 * pi, aside);
  points.pop_back();
  return points;
}

TEST(HomologyRank, IsTheGenusForTrueSkeletons) {
  for (const Shape& shape : {shapes::torus(3, 1, 12), shapes::linked_rings(3, 0.5, 12),
                             shapes::tube_union("rings", shapes::ring_chain(4, 3, 0.5), {0, 2})}) {
    EXPECT_EQ(homology_rank(shape.surface, shape.axis), shape.genus) << shape.name;
    const Shape turned = shapes::rotated(shape, {1, 2, 3}, 0.7);
    EXPECT_EQ(homology_rank(turned.surface, turned.axis), shape.genus) << shape.name;
    const Shape tiny = shapes::scaled(shape, 1e-6);
    EXPECT_EQ(homology_rank(tiny.surface, tiny.axis), shape.genus) << shape.name;
  }
}

TEST(HomologyRank, CountsNoCycleThatGoesThereAndBack) {
  const Shape ring = shapes::torus(3, 0.5, 24);
  const CurveSkeleton folded = closed({there_and_back()});
  EXPECT_EQ(homology_rank(ring.surface, folded), 0);
  EXPECT_EQ(homology_rank(ring.surface, closed({once_round()})), 1);
  const Certificate certificate = evaluate(ring.surface, folded, {}, {});
  EXPECT_EQ(certificate.cycle_rank, certificate.genus);
  EXPECT_EQ(certificate.inside_fraction, 1);
  EXPECT_FALSE(certificate.topology_correct());
}

TEST(HomologyRank, CountsAHandleOnceHoweverManyCyclesGoRoundIt) {
  const Shape ring = shapes::torus(3, 0.5, 24);
  EXPECT_EQ(homology_rank(ring.surface, closed({once_round(0.1), once_round(-0.1)})), 1);
  const Shape two =
      shapes::together("apart", {ring, shapes::translated(shapes::torus(3, 0.5, 24), {0, 0, 5})});
  EXPECT_EQ(homology_rank(two.surface, closed({once_round(0.1), once_round(-0.1)})), 1);
}

TEST(HomologyRank, TakesNestedShellsOneByOne) {
  const Shape nested =
      shapes::together("nested", {shapes::torus(3, 0.5, 24), shapes::torus(3, 0.3, 24)});
  EXPECT_EQ(homology_rank(nested.surface, closed({once_round(0.1), once_round(-0.1)})), 2);
  EXPECT_EQ(homology_rank(nested.surface, closed({once_round(0.1), there_and_back()})), 1);
}

TEST(HomologyClasses, TellTheTwoWaysRoundARingApart) {
  const Shape ring = shapes::torus(3, 0.5, 24);
  HomologyClasses classes(ring.surface);
  EXPECT_TRUE(classes.has_handles());
  EXPECT_TRUE(classes.homologous(arc(0, pi / 2, 0.2), arc(0, pi / 2, -0.2)));
  EXPECT_FALSE(classes.homologous(arc(0, pi / 2), arc(0, -3 * pi / 2)));
  EXPECT_FALSE(classes.homologous(arc(0, 2 * pi), {on_ring(0)}));
  EXPECT_TRUE(classes.homologous(there_and_back(), {on_ring(0)}));
  EXPECT_FALSE(HomologyClasses(shapes::ellipsoid({1, 1, 1}, 2).surface).has_handles());
}

TEST(HomologyGuard, StopsWhenAsked) {
  const Shape ring = shapes::torus(3, 0.5, 24);
  std::stop_source source;
  HomologyGuard guard(ring.surface, source.get_token());
  SkeletonGraph graph;
  graph.nodes = {{Point(3, 0, 0), {0}, true, {0, 0}}};
  const auto points = arc(0.2, 2 * pi - 0.2);
  graph.arcs.push_back({0, 0, {points.begin(), points.end()}, {0}});
  const SurfaceTree tree(ring.surface);
  EXPECT_TRUE(guard.restore_points(graph, graph, tree).empty());
  source.request_stop();
  EXPECT_THROW((void)guard.restore_points(graph, graph, tree), Cancelled);
  EXPECT_THROW(guard.restore_arcs(graph, graph, tree), Cancelled);
  EXPECT_THROW(guard.pull_taut(graph, tree), Cancelled);
}

/// A curve round a ring, and the same with its points moved by up to `most` any way.
std::array<SkeletonGraph, 2> before_and_after(double most, unsigned seed) {
  SkeletonGraph before;
  before.nodes = {{Point(3, 0, 0), {0}, true, {0, 0}}};
  const auto points = arc(0.2, 2 * pi - 0.2);
  before.arcs.push_back({0, 0, {points.begin(), points.end()}, {0}});
  SkeletonGraph after = before;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(-most, most);
  for (CurvePoint& point : after.arcs[0].points) {
    point = Point(point.place() + Point(part(random), part(random), part(random)));
  }
  return {before, after};
}

TEST(HomologyGuard, OwnTreeChangesNothing) {
  const Shape ring = shapes::torus(3, 0.5, 24);
  const SurfaceTree tree(ring.surface);
  HomologyGuard by_numbers(ring.surface);
  HomologyGuard by_balls(ring.surface, {}, 0, &tree);
  std::size_t restored = 0;
  for (const double most : {0.05, 0.2, 0.4, 1.0, 4.0}) {
    for (unsigned seed = 0; seed < 8; ++seed) {
      const auto [before, after] = before_and_after(most, seed);
      SkeletonGraph one = after;
      SkeletonGraph other = after;
      EXPECT_EQ(by_numbers.restore_points(before, one, tree),
                by_balls.restore_points(before, other, tree));
      EXPECT_EQ(one.polyline(one.arcs[0]), other.polyline(other.arcs[0])) << most << ", " << seed;
      if (one.polyline(one.arcs[0]) != after.polyline(after.arcs[0])) ++restored;
    }
  }
  EXPECT_GT(restored, 8U);
  EXPECT_LT(restored, 32U);
}

TEST(HomologyRank, OfCopiedLoopsNeedsNoSource) {
  const Shape ring = shapes::torus(3, 0.5, 24);
  auto source = std::make_unique<linking::SeenLoops>(ring.surface);
  linking::SeenLoops copy = *source;
  source.reset();
  EXPECT_EQ(homology_rank(copy, closed({once_round()})), 1);
}

// Long segments were kept in every cell of their box.
TEST(LinkingGrid, FindsWhatEachSegmentCrossesOver) {
  std::mt19937_64 random(7);
  const auto up_to = [&](std::uint64_t most) { return static_cast<std::int64_t>(random() % most); };
  const auto segment = [&](std::int64_t reach) {
    const linking::Seen from{up_to(1000000), up_to(1000000), static_cast<double>(up_to(100))};
    linking::Seen to{from.x + up_to(2 * reach) - reach, from.y + up_to(2 * reach) - reach,
                     static_cast<double>(up_to(100))};
    if (up_to(8) == 0) to.y = from.y;
    if (up_to(8) == 0) to.x = from.x;
    return linking::Segment{from, to};
  };
  std::vector<linking::Segment> segments;
  segments.reserve(300);
  for (int k = 0; k < 300; ++k) segments.push_back(segment(k % 2 == 0 ? 2000000 : 30000));
  linking::Grid grid(segments);
  for (int k = 0; k < 300; ++k) {
    const linking::Segment asked = segment(k % 2 == 0 ? 2000000 : 30000);
    std::vector<int> found;
    grid.crossed_by(asked, [&](int s) { found.push_back(s); });
    std::sort(found.begin(), found.end());
    std::vector<int> expected;
    for (int s = 0; s < 300; ++s) {
      if (linking::crosses_over(asked, segments[static_cast<std::size_t>(s)]))
        expected.push_back(s);
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(IndependentRows, AreThoseThatAreNoSumOfOthers) {
  IndependentRows rows;
  EXPECT_TRUE(rows.add({0b110, 1}));
  EXPECT_TRUE(rows.add({0b011, 0}));
  EXPECT_FALSE(rows.add({0b101, 1}));
  EXPECT_FALSE(rows.add({0, 0}));
  EXPECT_TRUE(rows.add({0, 1ULL << 63U}));
  EXPECT_EQ(rows.size(), 3);
}

// By rounding alone, a curve that passed an edge so near went outside of the surface given.
TEST(HomologyGuard, ALineNearerThanThatCrosses) {
  const SurfaceTree tree(shapes::box({1, 1, 1}, 4).surface);
  const Vector3d low = tree.nearest({-9, -9, -9}).point;  // a corner
  const Vector3d past = Vector3d(1, -1, 0).normalized();
  for (const double off : {1e-3, 1e-5, 1e-7}) {
    const Vector3d nearest = low + Vector3d(0, 0, 0.5) - off * Vector3d(1, 1, 0).normalized();
    const Vector3d from = nearest - 0.3 * past;
    const Vector3d to = nearest + 0.2 * past;
    EXPECT_FALSE(crosses(tree, from, to)) << off;
    EXPECT_FALSE(crosses(tree, from, to, 0.4 * off)) << off;
    EXPECT_TRUE(crosses(tree, from, to, 1.5 * off)) << off;
  }
  EXPECT_TRUE(crosses(tree, low - Vector3d(1, 1, 1), low + Vector3d(1, 1, 1)));
}

}  // namespace
}  // namespace curveskel::homology_classes_laws
