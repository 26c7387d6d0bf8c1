// Laws of surfaces with many components: none is lost, and none makes work for another.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include <curveskel/extract.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/topology.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"
#include "tests/soups.hpp"

namespace curveskel::crowd_laws {
namespace {

using shapes::Shape;

/// Boxes of one size on a jittered grid, each turned as it likes.
Shape crowd(int components) {
  shapes::Random random(3);
  const int side = static_cast<int>(std::ceil(std::cbrt(components)));
  const Shape box = shapes::box({1, 1.5, 3}, 3);
  std::vector<Shape> parts;
  for (int c = 0; c < components; ++c) {
    const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
    const int layer = c / (side * side);
    const Eigen::Vector3d cell(c % side, c / side % side, layer);
    const Eigen::Vector3d jitter(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    parts.push_back(
        shapes::translated(shapes::rotated(box, axis, random.uniform(0, 3)), 5 * cell + jitter));
  }
  return shapes::together("crowd", parts);
}

/// Few working vertices each, as components of crowds ten times as large have.
ExtractOptions quick() {
  ExtractOptions options;
  options.least_resolution = 100;
  return options;
}

TEST(Crowd, OfEqualComponentsHasNoSpecks) {
  const int components = 12000;  // each has less than 1e-4 of the area of all
  const PolygonSoup soup = soup_of(crowd(components).surface);
  const RepairedSurface repaired = repair(soup, {}, {});
  EXPECT_EQ(repaired.repairs.specks_dropped, 0);
  EXPECT_EQ(topology(repaired.surface).components(), components);
}

TEST(Crowd, HasASkeletonForEachComponent) {
  const Shape shape = crowd(150);
  const Extraction found = extract(shape.surface, quick(), {});
  EXPECT_EQ(found.certificate.components, 150);
  EXPECT_TRUE(found.certificate.topology_correct());
  EXPECT_EQ(found.certificate.inside_fraction, 1);
  ASSERT_EQ(found.components.size(), 150U);
}

/// Each of 496 cubes had 43 nodes, as if it were alone.
TEST(Crowd, HasFewNodesForEachOfItsSmallParts) {
  const auto nodes_each = [](int components) {
    const Extraction found = extract(crowd(components).surface, {}, {});
    EXPECT_TRUE(found.certificate.correct());
    return double(found.skeleton.nodes.rows()) / components;
  };
  EXPECT_GT(nodes_each(1), 20);
  EXPECT_LE(nodes_each(216), 5);
}

TEST(Crowd, IsTheSameForAnyNumberOfThreads) {
  const Shape shape = crowd(60);
  std::vector<CurveSkeleton> found;
  for (const int threads : {1, 2, 3}) {
    ExtractOptions options = quick();
    options.threads = threads;
    found.push_back(extract(shape.surface, options, {}).skeleton);
  }
  for (const std::size_t other : {1U, 2U}) {
    EXPECT_EQ(found[0].nodes, found[other].nodes);
    EXPECT_EQ(found[0].edges, found[other].edges);
    EXPECT_EQ(found[0].radii, found[other].radii);
    EXPECT_EQ(found[0].node_of_vertex, found[other].node_of_vertex);
  }
}

TEST(Crowd, IsTheSkeletonsOfItsComponentsOneAfterTheOther) {
  const Shape shape = crowd(20);
  const CurveSkeleton whole = extract(shape.surface, quick(), {}).skeleton;
  Eigen::Index nodes = 0;
  Eigen::Index edges = 0;
  for (const Component& part : split_components(shape.surface, topology(shape.surface))) {
    const CurveSkeleton alone = extract(part.surface, quick(), {}).skeleton;
    ASSERT_LE(nodes + alone.nodes.rows(), whole.nodes.rows());
    ASSERT_LE(edges + alone.edges.rows(), whole.edges.rows());
    EXPECT_EQ(whole.nodes.middleRows(nodes, alone.nodes.rows()), alone.nodes);
    const auto numbers = whole.edges.middleRows(edges, alone.edges.rows()).array();
    EXPECT_TRUE((numbers - static_cast<int>(nodes) == alone.edges.array()).all());
    nodes += alone.nodes.rows();
    edges += alone.edges.rows();
  }
  EXPECT_EQ(nodes, whole.nodes.rows());
  EXPECT_EQ(edges, whole.edges.rows());
}

/// The number of times that an extraction says how far it is: the more it has to do, the more.
int reports(int components) {
  int count = 0;
  Monitor monitor;
  monitor.progress = [&](std::string_view, double) { ++count; };
  ExtractOptions options = quick();
  options.threads = 1;
  (void)extract(crowd(components).surface, options, monitor);
  return count;
}

TEST(Crowd, TwiceAsLargeIsTwiceTheWork) {
  const int twenty = reports(20);
  EXPECT_GT(twenty, 20);
  EXPECT_LT(reports(40), 2.3 * twenty);
  EXPECT_LT(reports(80), 4.6 * twenty);
}

}  // namespace
}  // namespace curveskel::crowd_laws
