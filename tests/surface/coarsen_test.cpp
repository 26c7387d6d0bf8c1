#include <curveskel/advanced/coarsen.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/topology.hpp>
#include "tests/volumes.hpp"

namespace curveskel::coarsen_laws {
namespace {

// A tube of the given radius round a closed curve of radius 1 + 0.2 cos(5 u), genus 1.
Surface ring(int rings, int sides, double radius) {
  Surface surface;
  surface.positions.resize(Eigen::Index{rings} * sides, 3);
  surface.triangles.resize(Eigen::Index{2} * rings * sides, 3);
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sides; ++j) {
      const double u = 2 * std::numbers::pi * i / rings;
      const double v = 2 * std::numbers::pi * j / sides;
      const double out = 1 + 0.2 * std::cos(5 * u) + radius * std::cos(v);
      surface.positions.row(i * sides + j) << out * std::cos(u), out * std::sin(u),
          radius * std::sin(v);
      const int a = i * sides + j;
      const int b = (i + 1) % rings * sides + j;
      const int c = (i + 1) % rings * sides + (j + 1) % sides;
      const int d = i * sides + (j + 1) % sides;
      surface.triangles.row(Eigen::Index{2} * a) << a, b, c;
      surface.triangles.row(Eigen::Index{2} * a + 1) << a, c, d;
    }
  }
  return surface;
}

// As volumes have it: needles beside every round face.
Surface needles() {
  const auto field = [](const Eigen::Vector3d& p) { return volumes::ring(p, 1, 0.3); };
  const double noise = 0.004;
  return volumes::Volume(field, {1.5, 1.5, 0.5}, 0.04, noise).surface();
}

struct Case {
  const char* name;
  Surface surface;
  int target;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"coarse ring", ring(60, 12, 0.3), 300},
      {"fine ring", ring(400, 100, 0.3), 2000},
      {"very fine ring, first stage in parts", ring(700, 120, 0.3), 1000},
      {"thin ring", ring(2000, 8, 0.01), 9000},
  };
  return all;
}

Coarsened coarsened(const Case& from, int threads = 1) {
  return coarsen(from.surface, {.target_vertices = from.target, .threads = threads}, {});
}

TEST(Coarsen, MeetsTheTargetAndKeepsTheGenusOfEveryComponent) {
  for (const Case& each : cases()) {
    const Surface result = coarsened(each).surface;
    EXPECT_EQ(result.positions.rows(), each.target) << each.name;
    EXPECT_EQ(topology(result).genus, topology(each.surface).genus) << each.name;
  }
}

TEST(Coarsen, MeetsTheTargetAmongNeedles) {
  const Surface surface = needles();
  const Topology before = topology(surface);
  const Coarsened result = coarsen(surface, {.target_vertices = 1500});
  EXPECT_EQ(result.surface.positions.rows(), 1500);
  EXPECT_EQ(topology(result.surface).genus, before.genus);
  EXPECT_NEAR(area(result.surface) / area(surface), 1, 0.05);
}

TEST(Coarsen, EveryInputVertexEndsInOneVertexAndNoneIsLeftOver) {
  for (const Case& each : cases()) {
    const Coarsened result = coarsened(each);
    ASSERT_EQ(result.vertex_of_input.size(), each.surface.positions.rows()) << each.name;
    Eigen::VectorXi members = Eigen::VectorXi::Zero(result.surface.positions.rows());
    for (const int v : result.vertex_of_input) {
      ASSERT_TRUE(v >= 0 && v < members.size()) << each.name;
      ++members(v);
    }
    EXPECT_GT(members.minCoeff(), 0) << each.name;
  }
}

TEST(Coarsen, MergedVerticesAreNeighboursInSpace) {
  for (const Case& each : cases()) {
    const Coarsened result = coarsened(each);
    // Patches of equal area would have this radius.
    const double patch = std::sqrt(area(each.surface) / each.target / std::numbers::pi);
    for (Eigen::Index v = 0; v < result.vertex_of_input.size(); ++v) {
      EXPECT_LT(
          (each.surface.positions.row(v) - result.surface.positions.row(result.vertex_of_input(v)))
              .norm(),
          5 * patch)
          << each.name << ", vertex " << v;
    }
  }
}

TEST(Coarsen, KeepsAreaAndVolume) {
  for (const Case& each : cases()) {
    const Surface result = coarsened(each).surface;
    EXPECT_NEAR(area(result) / area(each.surface), 1, 0.02) << each.name;
    EXPECT_NEAR(volume(result) / volume(each.surface), 1, 0.03) << each.name;
  }
}

TEST(Coarsen, LeavesASmallEnoughSurfaceAlone) {
  const Surface surface = ring(60, 12, 0.3);
  const Coarsened result = coarsen(surface, {.target_vertices = 720}, {});
  EXPECT_EQ(result.surface.positions, surface.positions);
  EXPECT_EQ(result.surface.triangles, surface.triangles);
  EXPECT_EQ(result.vertex_of_input, Eigen::VectorXi::LinSpaced(720, 0, 719));
}

TEST(Coarsen, ResultDoesNotDependOnTheThreads) {
  for (const Case& each : cases()) {
    const Coarsened one = coarsened(each, 1);
    const Coarsened two = coarsened(each, 2);
    EXPECT_EQ(one.surface.positions, two.surface.positions) << each.name;
    EXPECT_EQ(one.surface.triangles, two.surface.triangles) << each.name;
    EXPECT_EQ(one.vertex_of_input, two.vertex_of_input) << each.name;
  }
}

TEST(Coarsen, StopsAboveATargetThatTheTopologyForbids) {
  const Surface result = coarsen(ring(60, 12, 0.3), {.target_vertices = 0}, {}).surface;
  EXPECT_GE(result.positions.rows(), 7);  // no torus has fewer vertices
  EXPECT_LT(result.positions.rows(), 60);
  EXPECT_EQ(topology(result).genus, std::vector<int>{1});
}

TEST(Coarsen, ARequestedStopEndsIt) {
  std::stop_source source;
  source.request_stop();
  Monitor monitor;
  monitor.stop = source.get_token();
  EXPECT_THROW((void)coarsen(cases()[2].surface, {.target_vertices = 1000}, monitor), Cancelled);
}

}  // namespace
}  // namespace curveskel::coarsen_laws
