// Laws of surfaces with many components: none is lost, and none makes work for another.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

#include <curveskel/advanced/measures.hpp>
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

/// The nodes of each part, by the map of its vertices.
std::vector<int> nodes_of(const std::vector<shapes::AssortedPart>& parts,
                          const CurveSkeleton& skeleton) {
  std::vector<int> counts;
  Eigen::Index vertex = 0;
  for (const shapes::AssortedPart& part : parts) {
    const Eigen::Index vertices = part.shape.surface.positions.rows();
    const auto its = skeleton.node_of_vertex.segment(vertex, vertices);
    const int first = its.minCoeff();
    const int last = its.maxCoeff();
    counts.push_back(last - first + 1);
    vertex += vertices;
  }
  return counts;
}

/// Straight parts need no more than 5. A ribbon is a chain of flat cells, and thin enough that its
/// curve may have to bend with each: it has fewer than two nodes a cell.
int most_nodes(const shapes::AssortedPart& part) {
  constexpr int straight = 5;
  constexpr int cells_of_ribbon = 24;
  return part.kind == shapes::PartKind::ribbon ? 2 * cells_of_ribbon : straight;
}

/// Boxes, balls, rods, sheets and ribbons, thin and thick: none longer than 4 % of the whole.
TEST(Crowd, OfAssortedPartsHasFewNodesForEach) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const auto parts = shapes::assorted_parts(391, seed);
    std::vector<Shape> shapes_of_all;
    shapes_of_all.reserve(parts.size());
    for (const auto& part : parts) shapes_of_all.push_back(part.shape);
    const Extraction found = extract(shapes::together("assorted", shapes_of_all).surface);
    EXPECT_TRUE(found.certificate.topology_correct());
    EXPECT_TRUE(found.certificate.inside_enough);
    ASSERT_EQ(found.components.size(), parts.size());
    const std::vector<int> nodes = nodes_of(parts, found.skeleton);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      EXPECT_GE(nodes[i], 1);
      EXPECT_LE(nodes[i], most_nodes(parts[i]))
          << "kind " << int(parts[i].kind) << ", size " << parts[i].size << ", thickness "
          << parts[i].thickness;
    }
  }
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

/// The same surface, its vertices and triangles numbered from the other end.
Surface reversed(const Surface& surface) {
  Surface turned = surface;
  turned.triangles.array() =
      static_cast<int>(surface.positions.rows()) - 1 - turned.triangles.array();
  turned.positions = surface.positions.colwise().reverse();
  turned.triangles = turned.triangles.colwise().reverse().eval();
  return turned;
}

/// Each component's skeleton hangs on the component and on its share of the whole alone.
TEST(Crowd, HasTheSameSkeletonsInAnyOrder) {
  const Shape shape = crowd(20);
  const CurveSkeleton one = extract(shape.surface, quick(), {}).skeleton;
  const CurveSkeleton other = extract(reversed(shape.surface), quick(), {}).skeleton;
  ASSERT_EQ(one.nodes.rows(), other.nodes.rows());
  EXPECT_EQ(one.edges.rows(), other.edges.rows());
  const double tolerance = 1e-6 * bounding_box_diagonal(shape.surface.positions);
  for (const auto& node : one.nodes.rowwise()) {
    EXPECT_LT((other.nodes.rowwise() - node).rowwise().norm().minCoeff(), tolerance);
  }
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
