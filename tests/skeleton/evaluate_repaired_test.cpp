// Laws of the certificate against surfaces that cross themselves: what was extracted from a wrap is
// held against one, and nothing that can be judged as it is gets wrapped.
#include <curveskel/evaluate_repaired.hpp>

#include <gtest/gtest.h>

#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/extract_repaired.hpp>
#include <curveskel/topology.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/pipeline/failing_components.hpp"
#include "surface/mesh/crosses_itself.hpp"
#include "tests/soups.hpp"

namespace curveskel::evaluate_repaired_laws {
namespace {

using shapes::Shape;

/// A limb whose vertices were moved by nearly its radius.
Shape turned_inside_out() {
  const Shape tube = shapes::tube("limb", shapes::straight(4), shapes::constant(0.06), 12);
  return shapes::noisy(tube, 0.05, 1);
}

RepairedSurface given(const Shape& shape) { return repair(soup_of(shape.surface), {}, {}); }

TEST(EvaluateRepaired, AgreesWithTheExtractionFromAWrap) {
  const Shape ball = shapes::translated(shapes::ellipsoid({1, 1, 2}, 4), {0, 0, 6});
  for (const Shape& shape :
       {turned_inside_out(), shapes::together("two", {ball, turned_inside_out()})}) {
    SCOPED_TRACE(shape.name);
    const RepairedSurface repaired = given(shape);
    const RepairedExtraction made = extract_repaired(repaired, {}, {}, {});
    ASSERT_TRUE(made.repaired_again && made.extraction.certificate.correct());
    EXPECT_FALSE(evaluate(repaired.surface, made.extraction.skeleton, {}, {}).correct());
    const RepairedEvaluation found =
        evaluate_repaired(repaired, {}, made.extraction.skeleton, {}, {});
    ASSERT_TRUE(found.repaired_again);
    EXPECT_TRUE(found.certificate.correct());
    EXPECT_EQ(found.repaired_again->repairs.components_wrapped, 1);
    RepairOptions never;
    never.wrap = Wrapping::never;
    const RepairedEvaluation as_it_is =
        evaluate_repaired(repaired, never, made.extraction.skeleton, {}, {});
    EXPECT_FALSE(as_it_is.repaired_again);
    EXPECT_FALSE(as_it_is.certificate.correct());
  }
}

TEST(EvaluateRepaired, FindsNoWrapToExcuseAWrongSkeleton) {
  // A wide enough wrap of this ring is a disc, and a tree would do for it.
  const Shape ring = shapes::torus(1, 0.9, 32);
  const RepairedSurface repaired = given(ring);
  CurveSkeleton tree = extract(repaired.surface, {}, {}).skeleton;
  tree.edges.conservativeResize(tree.edges.rows() - 1, Eigen::NoChange);
  const RepairedEvaluation found = evaluate_repaired(repaired, {}, tree, {}, {});
  EXPECT_FALSE(found.repaired_again);
  EXPECT_FALSE(found.certificate.topology_correct());
}

// The budget of wraps was divided among no components.
TEST(EvaluateRepaired, AnEdgeFarFromAllComponentsNeedsNoWrap) {
  const RepairedSurface repaired =
      given(shapes::tube("limb", shapes::straight(4), shapes::constant(0.3), 12));
  CurveSkeleton skeleton = extract(repaired.surface, {}, {}).skeleton;
  const auto nodes = static_cast<int>(skeleton.nodes.rows());
  skeleton.nodes.conservativeResize(nodes + 2, Eigen::NoChange);
  skeleton.nodes.bottomRows(2) << 50, 50, 50, 51, 50, 50;
  skeleton.edges.conservativeResize(skeleton.edges.rows() + 1, Eigen::NoChange);
  skeleton.edges.bottomRows(1) << nodes, nodes + 1;
  skeleton.radii.resize(0);
  skeleton.lives.resize(0);
  const RepairedEvaluation found = evaluate_repaired(repaired, {}, skeleton, {}, {});
  EXPECT_FALSE(found.repaired_again);
  EXPECT_FALSE(found.certificate.correct());
}

TEST(EvaluateRepaired, RefusesASkeletonInAnotherUnit) {
  const RepairedSurface repaired =
      given(shapes::tube("limb", shapes::straight(4), shapes::constant(0.3), 12));
  CurveSkeleton skeleton = extract(repaired.surface, {}, {}).skeleton;
  for (const double unit : {1e6, 1e100, 1e300}) {
    CurveSkeleton other = skeleton;
    other.nodes *= unit;
    EXPECT_THROW((void)evaluate_repaired(repaired, {}, other, {}, {}), Error);
  }
  skeleton.nodes *= 1000;
  EXPECT_FALSE(evaluate_repaired(repaired, {}, skeleton, {}, {}).certificate.correct());
}

TEST(EvaluateRepaired, GivesPiecesToTheSmallestThatHoldsThem) {
  const Shape within = shapes::ellipsoid({0.2, 0.2, 0.4}, 3);
  const Shape around = shapes::ellipsoid({1, 1, 2}, 4);
  const Shape beside = shapes::translated(shapes::torus(1, 0.3, 24), {4, 0, 0});
  const Shape all = shapes::together("three", {around, within, beside});
  const Topology counted = topology(all.surface);
  const CurveSkeleton skeleton = extract(all.surface, {}, {}).skeleton;
  const auto by_map = component_by_map(skeleton, counted);
  EXPECT_EQ(component_by_place(skeleton, split_components(all.surface, counted)), by_map);
  EXPECT_EQ(std::vector<int>(by_map).front(), 0);
  EXPECT_EQ(by_map.back(), 2);
}

/// A crowd of boxes apart from each other, each with its piece: 10^11 pairs that need no look.
TEST(EvaluateRepaired, APieceAsksOnlyComponentsThatItsBoxMeets) {
  constexpr int side = 68;
  constexpr int count = side * side * side;
  Component cube;
  cube.surface = shapes::translated(shapes::ellipsoid({0.3, 0.3, 0.3}, 0), {0, 0, 0}).surface;
  std::vector<Component> parts(count, cube);
  CurveSkeleton skeleton;
  skeleton.nodes.resize(Eigen::Index{2} * count, 3);
  skeleton.edges.resize(count, 2);
  for (int c = 0; c < count; ++c) {
    const Eigen::Vector3i cell(c % side, c / side % side, c / side / side);
    const Eigen::RowVector3d place = cell.cast<double>().transpose();
    parts[idx(c)].surface.positions.rowwise() += place;
    const Eigen::Index piece = 7919L * c % count;
    skeleton.nodes.row(2 * piece) = place;
    skeleton.nodes.row(2 * piece + 1) = place + Eigen::RowVector3d(0, 0, 0.1);
    skeleton.edges.row(piece) << static_cast<int>(2 * piece), static_cast<int>(2 * piece + 1);
  }
  const std::vector<int> found = component_by_place(skeleton, parts);
  for (int c = 0; c < count; ++c) {
    const Eigen::Index piece = 7919L * c % count;
    ASSERT_EQ(found[idx(2 * piece)], c);
    ASSERT_EQ(found[idx(2 * piece + 1)], c);
  }
}

TEST(CrossesItself, IsWhatNoiseOrAnotherPartDoesAndNothingElse) {
  for (const auto& entry : shapes::catalogue()) {
    const Shape shape = entry.make();
    EXPECT_FALSE(crosses_itself(shape.surface)) << shape.name;
  }
  EXPECT_TRUE(crosses_itself(turned_inside_out().surface));
  const Shape ball = shapes::ellipsoid({1, 1, 2}, 3);
  const Shape other = shapes::translated(ball, {0.7, 0, 0});
  EXPECT_TRUE(crosses_itself(shapes::together("two", {ball, other}).surface));
}

}  // namespace
}  // namespace curveskel::evaluate_repaired_laws
