#include <curveskel/advanced/coarsen.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/topology.hpp>

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

/// A ring as volumes leave it: a grid's vertices drawn together by twos, threes and fours to almost
/// one place, so that next to each round face there are needles.
Surface ring_of_needles(int rings, int sides) {
  Surface surface = ring(rings, sides, 0.3);
  std::mt19937 random(7);
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sides; ++j) {
      const int v = i * sides + j;
      const std::array near{(i + 1) % rings * sides + j, i * sides + (j + 1) % sides,
                            (i + rings - 1) % rings * sides + (j + 1) % sides};
      const int to = near[random() % near.size()];
      if (random() % 3 == 0) continue;
      const double left = std::pow(10.0, -1.0 - static_cast<double>(random() % 5));
      surface.positions.row(v) =
          left * surface.positions.row(v) + (1 - left) * surface.positions.row(to);
    }
  }
  return surface;
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
      {"needles", ring_of_needles(300, 100), 2000},
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
