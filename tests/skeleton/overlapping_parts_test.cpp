// Laws of skeletons of parts that overlap: a merged body has one, and the record says which part
// lies in which.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <numbers>
#include <vector>

#include <curveskel/extract_repaired.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/topology.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"
#include "tests/soups.hpp"

namespace curveskel::overlapping_parts_laws {
namespace {

using shapes::Shape;

Shape at(const Shape& shape, double x, double y, double z) {
  return shapes::translated(shape, {x, y, z});
}

Shape ball(double radius) { return shapes::ellipsoid({radius, radius, radius}, 3); }

struct Merged {
  PolygonSoup soup;
  RepairedSurface repaired;
  RepairedExtraction found;
};

Merged merged(const std::vector<Shape>& parts) {
  RepairOptions options;
  options.merge_overlapping = true;
  Merged result{soup_of(shapes::together("parts", parts).surface), {}, {}};
  result.repaired = repair(result.soup, options);
  result.found = extract_repaired(result.repaired, options);
  return result;
}

/// The node of a vertex of the file.
Eigen::RowVector3d node_of(const Merged& merged, Eigen::Index vertex) {
  const CurveSkeleton& skeleton = merged.found.extraction.skeleton;
  return skeleton.nodes.row(skeleton.node_of_vertex[merged.repaired.vertex_of_input[vertex]]);
}

constexpr std::array<std::array<int, 2>, 4> corners{{{-1, -1}, {-1, 1}, {1, -1}, {1, 1}}};

/// A top and four legs that go into it.
std::vector<Shape> table() {
  std::vector<Shape> parts{shapes::box({8, 5, 0.6}, 8)};
  for (const auto& [x, y] : corners) {
    parts.push_back(at(shapes::box({0.5, 0.5, 5}, 8), 3.5 * x, 2 * y, -2.4));
  }
  return parts;
}

TEST(MergedBody, OfATableHasACurveInEachLeg) {
  std::vector<Shape> parts = table();
  const Merged result = merged(parts);
  const Extraction& extraction = result.found.extraction;
  EXPECT_TRUE(extraction.certificate.topology_correct());
  EXPECT_TRUE(extraction.certificate.inside_enough);
  ASSERT_EQ(extraction.components.size(), 1U);
  EXPECT_EQ(extraction.components.front().genus, 0);
  EXPECT_GE(extraction.certificate.tips, 4);
  const CurveSkeleton& skeleton = extraction.skeleton;
  Eigen::VectorXi degree = Eigen::VectorXi::Zero(skeleton.nodes.rows());
  for (const std::int32_t node : skeleton.edges.reshaped()) ++degree[node];
  for (const auto& [x, y] : corners) {
    const Eigen::RowVector3d foot(3.5 * x, 2 * y, -4.9);
    double nearest = 10;
    for (Eigen::Index n = 0; n < degree.size(); ++n) {
      if (degree[n] == 1) nearest = std::min(nearest, (skeleton.nodes.row(n) - foot).norm());
    }
    EXPECT_LT(nearest, 0.6);
  }
  // Each vertex of the file follows the curve of its own part, hidden in another or not.
  ASSERT_EQ(result.repaired.vertex_of_input.size(), result.soup.positions.rows());
  for (Eigen::Index v = 0; v < result.soup.positions.rows(); ++v) {
    const Eigen::RowVector3d p = result.soup.positions.row(v);
    if (p.z() >= -1) continue;
    EXPECT_LT((node_of(result, v) - p).head(2).norm(), 1);
  }
}

/// Two legs side by side: a wrap would have rungs between them, so cycles.
TEST(MergedBody, HasNoCyclesBetweenLegsSideBySide) {
  std::vector<Shape> parts{shapes::box({3, 1.5, 1.5}, 10)};
  const Shape leg =
      shapes::rotated(shapes::tube("leg", shapes::straight(5), shapes::constant(0.5), 20),
                      {0, 1, 0}, std::numbers::pi / 2);
  for (const int side : {-1, 1}) parts.push_back(at(leg, 0.51 * side, 0, -2.8));
  const Certificate found = merged(parts).found.extraction.certificate;
  EXPECT_TRUE(found.correct());
  EXPECT_EQ(found.components, 1);
  EXPECT_EQ(found.cycle_rank, 0);
  EXPECT_GE(found.tips, 2);
}

TEST(MergedBody, OfRandomPartsIsCertified) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    shapes::Random random(seed);
    std::vector<Shape> parts{ball(1.5)};
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
      const Shape limb = i % 2 == 0
                             ? shapes::tube("limb", shapes::straight(4), shapes::constant(0.3), 12)
                             : shapes::box({5, 0.6, 0.5}, 12);
      parts.push_back(shapes::rotated(at(limb, 3, 0, 0), axis, random.uniform(0, 3)));
    }
    const Merged result = merged(parts);
    EXPECT_TRUE(result.repaired.repairs.merging.apart.empty());
    EXPECT_EQ(result.found.extraction.certificate.components, 1);
    EXPECT_TRUE(result.found.extraction.certificate.correct());
  }
}

TEST(Components, SayWhatTheyLieInAndWhatTheyOverlap) {
  const std::vector<Shape> parts{ball(0.3),
                                 ball(3),
                                 at(ball(1), 2.5, 0.1, 0),
                                 at(ball(0.5), 9, 0, 0),
                                 at(ball(0.1), 0.05, 0, 0),
                                 at(ball(0.1), 0, 2, 0),
                                 at(ball(0.4), 9.05, 0.3, 0.7)};
  const Extraction found = extract(shapes::together("parts", parts).surface);
  const std::vector<int> inside{1, -1, -1, -1, 0, 1, -1};
  const std::vector<std::vector<int>> overlaps{{}, {2}, {1}, {6}, {}, {}, {3}};
  ASSERT_EQ(found.components.size(), parts.size());
  for (std::size_t c = 0; c < parts.size(); ++c) {
    EXPECT_EQ(found.components[c].inside_component, inside[c]) << c;
    EXPECT_EQ(found.components[c].overlaps, overlaps[c]) << c;
  }
}

/// Through its hole is not inside; neither is what lies in the box of a ring alone.
TEST(Components, InTheHoleOfARingAreFree) {
  const Extraction found = extract(
      shapes::together("parts", {shapes::torus(3, 0.6, 16), ball(1), at(ball(0.3), 3, 0, 0)})
          .surface);
  EXPECT_EQ(found.components[0].inside_component, -1);
  EXPECT_EQ(found.components[1].inside_component, -1);
  EXPECT_EQ(found.components[2].inside_component, 0);
  for (const ComponentRecord& one : found.components) EXPECT_TRUE(one.overlaps.empty());
}

}  // namespace
}  // namespace curveskel::overlapping_parts_laws
