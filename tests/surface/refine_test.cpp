#include "surface/resample/refine.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/topology.hpp>
#include "tests/surfaces.hpp"

namespace curveskel::refine_laws {
namespace {

// Every side of a triangle is once the side of another, the other way round.
bool closed(const Surface& surface) {
  std::vector<std::pair<int, int>> sides;
  std::vector<std::pair<int, int>> reversed;
  for (const auto& row : surface.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      sides.emplace_back(row(k), row((k + 1) % 3));
      reversed.emplace_back(row((k + 1) % 3), row(k));
    }
  }
  std::sort(sides.begin(), sides.end());
  std::sort(reversed.begin(), reversed.end());
  return sides == reversed && std::adjacent_find(sides.begin(), sides.end()) == sides.end();
}

TEST(Refine, EnoughVerticesButNotFarTooManyAndTheSurfaceStaysWhereItIs) {
  for (const auto* surfaces : {&families(), &real_surfaces()}) {
    for (const auto& [name, surface] : *surfaces) {
      const auto before = static_cast<int>(surface.positions.rows());
      if (before > 20000) continue;
      const int least = std::max(2000, before + 1);
      const Surface finer = refine(surface, least);
      EXPECT_GE(finer.positions.rows(), least) << name;
      EXPECT_LE(finer.positions.rows(), 2 * least) << name;
      EXPECT_TRUE(finer.positions.topRows(before) == surface.positions) << name;
      EXPECT_TRUE(closed(finer)) << name;
      EXPECT_EQ(topology(finer).genus, topology(surface).genus) << name;
      EXPECT_NEAR(area(finer) / area(surface), 1, 1e-9) << name;
      EXPECT_NEAR(volume(finer) / volume(surface), 1, 1e-9) << name;
    }
  }
}

TEST(Refine, ASurfaceWithEnoughVerticesIsLeftAlone) {
  const Surface& surface = families().front().surface;
  const Surface same = refine(surface, static_cast<int>(surface.positions.rows()));
  EXPECT_TRUE(same.positions == surface.positions);
  EXPECT_TRUE(same.triangles == surface.triangles);
}

TEST(Refine, AnythingClosedGrowsFromATetrahedron) {
  Surface tetrahedron;
  tetrahedron.positions.resize(4, 3);
  tetrahedron.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  tetrahedron.triangles.resize(4, 3);
  tetrahedron.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  const Surface finer = refine(tetrahedron, 1000);
  EXPECT_GE(finer.positions.rows(), 1000);
  EXPECT_TRUE(closed(finer));
  EXPECT_EQ(topology(finer).genus, std::vector<int>{0});
}

TEST(Refine, NeedlesOfAnyLengthAreNotCutWithoutEnd) {
  for (const double far : {1e3, 1e6, 1e12, 1e100}) {
    Surface surface = families().front().surface;
    surface.positions.row(0) << far, 0, 0;
    const int least = static_cast<int>(surface.positions.rows()) + 500;
    const Surface finer = refine(surface, least);
    EXPECT_GE(finer.positions.rows(), least) << far;
    EXPECT_LE(finer.positions.rows(), 2 * Eigen::Index{least} + surface.positions.rows()) << far;
    EXPECT_TRUE(closed(finer)) << far;
  }
}

TEST(Refine, ASurfaceWithoutAreaIsLeftAlone) {
  Surface surface = families().front().surface;
  surface.positions.setZero();
  EXPECT_EQ(refine(surface, 100000).positions.rows(), surface.positions.rows());
}

}  // namespace
}  // namespace curveskel::refine_laws
