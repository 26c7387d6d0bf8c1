// Laws of components that overlap: they become one body, with the inside of all, and nothing else
// does.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/error.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/topology.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"
#include "surface/repair/open_pairs.hpp"
#include "tests/soups.hpp"

namespace curveskel::merging_laws {
namespace {

using shapes::Shape;

RepairedSurface merged(const std::vector<Shape>& parts) {
  RepairOptions options;
  options.merge_overlapping = true;
  return repair(soup_of(shapes::together("parts", parts).surface), options);
}

Shape turned(const Shape& shape, std::uint64_t seed) {
  shapes::Random random(seed);
  const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
  return shapes::rotated(shape, axis.normalized(), random.uniform(0, 3));
}

/// All by the same rotation.
std::vector<Shape> turned(std::vector<Shape> parts, std::uint64_t seed) {
  for (Shape& part : parts) part = turned(part, seed);
  return parts;
}

Shape at(const Shape& shape, double x, double y, double z) {
  return shapes::translated(shape, {x, y, z});
}

Shape ball() { return shapes::ellipsoid({1, 1, 1}, 3); }

Shape capsule() { return shapes::tube("capsule", shapes::straight(4), shapes::constant(0.5), 16); }

void expect_one_body(const RepairedSurface& result, std::size_t parts) {
  expect_closed_outward_manifold(result.surface);
  const Topology counted = topology(result.surface);
  EXPECT_EQ(counted.components(), 1);
  EXPECT_EQ(counted.total_genus(), 0);
  const Merging& merging = result.repairs.merging;
  EXPECT_EQ(merging.components, static_cast<int>(parts));
  ASSERT_EQ(merging.bodies.size(), 1U);
  EXPECT_EQ(merging.bodies.front().size() + merging.covered.size(), parts);
  EXPECT_TRUE(merging.apart.empty());
  EXPECT_FALSE(result.repairs.lines.empty());
  EXPECT_GE(result.vertex_of_input.minCoeff(), 0);
}

/// A vertex of the file that lies on the body is the body's own.
void expect_own_vertices_where_there_are(const std::vector<Shape>& parts,
                                         const RepairedSurface& result) {
  const Positions file = shapes::together("parts", parts).surface.positions;
  std::set<std::vector<double>> own;
  for (const auto& p : result.surface.positions.rowwise()) own.insert({p.x(), p.y(), p.z()});
  ASSERT_EQ(result.vertex_of_input.size(), file.rows());
  for (Eigen::Index v = 0; v < file.rows(); ++v) {
    const Eigen::RowVector3d p = file.row(v);
    if (!own.contains({p.x(), p.y(), p.z()})) continue;
    EXPECT_EQ(result.surface.positions.row(result.vertex_of_input[v]), p);
  }
}

TEST(Merging, MakesOneBodyOfTwoThatOverlap) {
  for (const Shape& one : {ball(), capsule(), shapes::box({2, 2, 2}, 4)}) {
    for (const Shape& other : {ball(), capsule(), shapes::box({3, 1, 1}, 3)}) {
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const std::vector<Shape> parts{turned(one, seed),
                                       at(turned(other, seed + 10), 0.9, 0.2, 0.1)};
        SCOPED_TRACE(one.name + ", " + other.name + ", " + std::to_string(seed));
        const RepairedSurface result = merged(parts);
        expect_one_body(result, 2);
        expect_own_vertices_where_there_are(parts, result);
        const double first = volume(parts[0].surface);
        const double second = volume(parts[1].surface);
        EXPECT_GT(volume(result.surface), std::max(first, second));
        EXPECT_LT(volume(result.surface), first + second);
      }
    }
  }
}

/// The volume of boxes along the axes is known, however both are turned.
TEST(Merging, HasTheVolumeOfTheUnion) {
  shapes::Random random(5);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Eigen::Vector3d one(random.uniform(1, 3), random.uniform(1, 3), random.uniform(1, 3));
    const Eigen::Vector3d other(random.uniform(1, 3), random.uniform(1, 3), random.uniform(1, 3));
    const Eigen::Vector3d offset(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    const Eigen::Vector3d low = (-one / 2).cwiseMax(offset - other / 2);
    const Eigen::Vector3d high = (one / 2).cwiseMin(offset + other / 2);
    const RepairedSurface result = merged(
        turned({shapes::box(one, 3), shapes::translated(shapes::box(other, 4), offset)}, seed));
    const double expected = one.prod() + other.prod() - (high - low).prod();
    EXPECT_NEAR(volume(result.surface), expected, 1e-9 * expected);
  }
}

TEST(Merging, HasTheInsideOfAllItsParts) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    shapes::Random random(seed);
    std::vector<Shape> parts;
    std::vector<SurfaceTree> trees;
    for (int i = 0; i < 12; ++i) {
      const Shape part = turned(i % 3 == 0   ? ball()
                                : i % 3 == 1 ? capsule()
                                             : shapes::box({3, 1, 0.5}, 6),
                                100 * seed + static_cast<std::uint64_t>(i));
      parts.push_back(
          at(part, random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)));
      trees.emplace_back(parts.back().surface);
    }
    const RepairedSurface result = merged(parts);
    expect_closed_outward_manifold(result.surface);
    EXPECT_TRUE(result.repairs.merging.apart.empty());
    if (result.repairs.merging.cavities_filled > 0) continue;
    const SurfaceTree whole(result.surface);
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d p(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5));
      if (whole.nearest(p).distance < 1e-6) continue;
      EXPECT_EQ(whole.inside(p), std::any_of(trees.begin(), trees.end(),
                                             [&](const auto& tree) { return tree.inside(p); }));
    }
  }
}

TEST(Merging, LeavesApartWhatDoesNotTouch) {
  const Shape ring = shapes::torus(2, 0.5, 16);
  const Shape upright =
      shapes::rotated(shapes::tube("bar", shapes::straight(6), shapes::constant(1.2), 24),
                      {0, 1, 0}, std::numbers::pi / 2);
  for (const auto& parts :
       {std::vector<Shape>{ring, upright}, std::vector<Shape>{ball(), at(ball(), 2.001, 0, 0)},
        std::vector<Shape>{shapes::linked_rings(2, 0.4, 16)}}) {
    const RepairedSurface result = merged(parts);
    const Surface given = shapes::together("parts", parts).surface;
    EXPECT_EQ(result.surface.positions, given.positions);
    EXPECT_EQ(result.surface.triangles, given.triangles);
    EXPECT_EQ(result.repairs.merging.components, 2);
    EXPECT_TRUE(result.repairs.merging.bodies.empty());
    EXPECT_TRUE(result.repairs.merging.covered.empty());
    EXPECT_TRUE(result.repairs.lines.empty());
  }
}

/// A body with two legs a hair's breadth apart: a wrap would join them.
TEST(Merging, MakesNoRungsBetweenLegs) {
  const Shape leg = shapes::rotated(capsule(), {0, 1, 0}, std::numbers::pi / 2);
  const std::vector<Shape> figure{shapes::box({3, 2, 2}, 5), at(leg, -0.505, 0, -2),
                                  at(leg, 0.505, 0, -2)};
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    expect_one_body(merged(turned(figure, seed)), 3);
  }
}

TEST(Merging, LeavesOutWhatLiesInsideAnother) {
  const Shape outer = shapes::ellipsoid({3, 3, 3}, 3);
  const std::vector<Shape> parts{ball(), outer, at(shapes::box({0.2, 0.2, 0.2}, 1), 0.3, 0, 0),
                                 at(ball(), 8, 0, 0)};
  const RepairedSurface result = merged(turned(parts, 3));
  const Merging& merging = result.repairs.merging;
  EXPECT_TRUE(merging.bodies.empty());
  EXPECT_TRUE(merging.apart.empty());
  ASSERT_EQ(merging.covered.size(), 2U);
  EXPECT_EQ(merging.covered[0].component, 0);
  EXPECT_EQ(merging.covered[0].inside, 1);
  EXPECT_EQ(merging.covered[1].component, 2);
  EXPECT_EQ(merging.covered[1].inside, 0);
  EXPECT_EQ(topology(result.surface).components(), 2);
  EXPECT_GE(result.vertex_of_input.minCoeff(), 0);
  // Their vertices follow the body round them, not the other one.
  const double outside = result.surface.positions.rows() - ball().surface.positions.rows();
  for (Eigen::Index v = 0; v < ball().surface.positions.rows(); ++v) {
    EXPECT_LT(result.vertex_of_input[v], outside);
  }
}

TEST(Merging, TakesTheInnerPartsOfABodyThatGrows) {
  // The small one lies in the union, but in neither of its parts.
  const std::vector<Shape> parts{shapes::box({4, 2, 2}, 4), at(shapes::box({4, 2, 2}, 4), 3, 0, 0),
                                 at(shapes::box({1.5, 0.5, 0.5}, 3), 1.5, 0, 0)};
  for (std::uint64_t seed = 0; seed < 3; ++seed) expect_one_body(merged(turned(parts, seed)), 3);
}

/// Either they unite, or it is said that they do not; none is lost.
TEST(Merging, OfBoxesThatTouchIsSaid) {
  const Shape box = shapes::box({2, 2, 2}, 4);
  for (const Eigen::Vector3d& offset :
       {Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(2, 0.3, 0.7), Eigen::Vector3d(2, 2, 0),
        Eigen::Vector3d(2, 2, 2), Eigen::Vector3d(2, 0.5, 0)}) {
    const RepairedSurface result = merged({box, shapes::translated(box, offset)});
    expect_closed_outward_manifold(result.surface);
    const Merging& merging = result.repairs.merging;
    EXPECT_EQ(merging.bodies.size() + merging.apart.size(), 1U);
    EXPECT_NEAR(volume(result.surface), 16, 1e-9);
    const bool share_a_face = (offset.array() == 2).count() == 1;
    EXPECT_EQ(merging.bodies.size(), share_a_face ? 1U : 0U);
    if (!share_a_face) {
      EXPECT_FALSE(merging.apart.front().why.empty());
      EXPECT_FALSE(result.repairs.lines.empty());
    }
  }
}

/// Once round one half of a figure of eight, and through its own beginning.
Shape crossing_itself() {
  const shapes::Curve eight = [](double t) -> Eigen::Vector3d {
    const double angle = std::numbers::pi * (-0.1 + 1.2 * t);
    return {3 * std::sin(angle), 3 * std::sin(angle) * std::cos(angle), 0};
  };
  return shapes::tube("eight", eight, shapes::constant(0.4), 16);
}

TEST(Merging, LeavesApartWhatCrossesItselfAndSaysSo) {
  const std::vector<Shape> parts{crossing_itself(), shapes::ellipsoid({1, 1, 1}, 3)};
  const RepairedSurface result = merged(parts);
  const Merging& merging = result.repairs.merging;
  EXPECT_TRUE(merging.bodies.empty());
  ASSERT_EQ(merging.apart.size(), 1U);
  EXPECT_EQ(merging.apart.front().component, 0);
  EXPECT_EQ(merging.apart.front().other, 1);
  EXPECT_NE(merging.apart.front().why.find("crosses itself"), std::string::npos);
  EXPECT_EQ(result.surface.positions.rows(),
            shapes::together("parts", parts).surface.positions.rows());
}

/// Six slabs round a hollow.
std::vector<Shape> hollow() {
  std::vector<Shape> slabs;
  for (const double side : {-2.0, 2.0}) {
    slabs.push_back(at(shapes::box({1, 5, 5}, 5), side, 0, 0));
    slabs.push_back(at(shapes::box({5, 1, 4.9}, 5), 0, side, 0));
    slabs.push_back(at(shapes::box({4.8, 4.9, 1}, 5), 0, 0, side));
  }
  return slabs;
}

TEST(Merging, FillsTheHollowsBetweenParts) {
  const RepairedSurface result = merged(turned(hollow(), 2));
  expect_one_body(result, 6);
  EXPECT_EQ(result.repairs.merging.cavities_filled, 1);
}

TEST(Merging, LeavesOutWhatLiesInAHollowThatItFills) {
  std::vector<Shape> parts = hollow();
  parts.push_back(ball());
  parts.push_back(at(shapes::ellipsoid({0.5, 0.5, 0.5}, 2), 0.8, 0, 0.1));  // crosses the ball
  parts.push_back(shapes::ellipsoid({0.2, 0.2, 0.2}, 2));
  const RepairedSurface result = merged(turned(parts, 2));
  const Merging& merging = result.repairs.merging;
  expect_closed_outward_manifold(result.surface);
  EXPECT_EQ(topology(result.surface).components(), 1);
  EXPECT_EQ(merging.bodies, (std::vector<std::vector<int>>{{0, 1, 2, 3, 4, 5}}));
  EXPECT_EQ(merging.covered.size(), 3U);
  EXPECT_GE(result.vertex_of_input.minCoeff(), 0);
  EXPECT_NEAR(volume(result.surface), volume(merged(turned(hollow(), 2)).surface), 1e-6);
}

/// Four bars of a frame.
TEST(Merging, CountsTheHandlesThatPartsMakeTogether) {
  std::vector<Shape> bars;
  for (const double side : {-2.0, 2.0}) {
    bars.push_back(at(shapes::box({1, 5, 1}, 5), side, 0, 0));
    bars.push_back(at(shapes::box({5, 1, 0.9}, 5), 0, side, 0));
  }
  const RepairedSurface frame = merged(turned(bars, 3));
  EXPECT_EQ(topology(frame.surface).total_genus(), 1);
  EXPECT_EQ(frame.repairs.merging.handles_made, 1);
  bars.pop_back();
  EXPECT_EQ(merged(turned(bars, 3)).repairs.merging.handles_made, 0);
}

TEST(Merging, OfManyPartsLosesNone) {
  constexpr int count = 30;
  std::vector<Shape> chain;
  chain.reserve(count);
  for (int i = 0; i < count; ++i) chain.push_back(at(ball(), 1.3 * i, 0.1 * (i % 3), 0));
  expect_one_body(merged(chain), count);
  std::vector<Shape> star{shapes::ellipsoid({3, 3, 3}, 4)};
  for (std::uint64_t i = 0; i < 30; ++i) {
    Shape ray = at(shapes::tube("ray", shapes::straight(3), shapes::constant(0.1), 8), 4, 0, 0);
    star.push_back(turned(ray, i));
  }
  expect_one_body(merged(star), 31);
}

TEST(Merging, IsTheSameInAnyNumbering) {
  const std::vector<Shape> parts{ball(), at(capsule(), 1, 0.2, 0), at(ball(), 2, 1, 0)};
  const RepairedSurface result = merged(parts);
  const Shape other = shapes::renumbered(shapes::together("parts", parts), 7);
  RepairOptions options;
  options.merge_overlapping = true;
  const RepairedSurface again = repair(soup_of(other.surface), options);
  expect_one_body(again, 3);
  EXPECT_NEAR(volume(again.surface), volume(result.surface), 1e-9);
  EXPECT_NEAR(area(again.surface), area(result.surface), 1e-9);
}

TEST(Merging, KeepsTheLargestBodiesOnly) {
  RepairOptions options;
  options.merge_overlapping = true;
  options.components = 1;
  const Shape all = shapes::together(
      "parts", {shapes::ellipsoid({1.2, 1.2, 1.2}, 3), at(ball(), 9, 0, 0), at(ball(), 10, 0, 0)});
  const RepairedSurface result = repair(soup_of(all.surface), options);
  EXPECT_EQ(topology(result.surface).components(), 1);
  EXPECT_GT(result.surface.positions.col(0).minCoeff(), 7);
}

TEST(Merging, ObeysAStop) {
  std::stop_source stop;
  stop.request_stop();
  Monitor monitor;
  monitor.stop = stop.get_token();
  RepairOptions options;
  options.merge_overlapping = true;
  const Shape all = shapes::together("parts", {ball(), at(ball(), 1, 0, 0)});
  EXPECT_THROW((void)repair(soup_of(all.surface), options, monitor), Cancelled);
}

TEST(OpenPairs, GiveTheSmallestFirstOfEqualOnes) {
  constexpr std::size_t pairs = 60;
  std::mt19937 draw(3);
  OpenPairs open(pairs);
  std::map<std::size_t, std::size_t> sizes;
  for (int step = 0; step < 2000; ++step) {
    const std::size_t pair = draw() % pairs;
    if (draw() % 3 == 0) {
      open.close(pair);
      sizes.erase(pair);
    } else {
      open.open(pair, sizes[pair] = draw() % 9);
    }
    ASSERT_EQ(open.count(), sizes.size());
    ASSERT_EQ(open.has(pair), sizes.contains(pair));
    if (sizes.empty()) continue;
    const auto smallest = std::min_element(sizes.begin(), sizes.end(),
                                           [](auto& a, auto& b) { return a.second < b.second; });
    ASSERT_EQ(open.smallest(), smallest->first);
  }
}

}  // namespace
}  // namespace curveskel::merging_laws
