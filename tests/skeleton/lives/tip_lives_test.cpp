// Laws of lives: the tips that a person sees, whatever the surface's size, place and triangles.
#include <curveskel/lives.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/lives/geodesic_distance.hpp"

namespace curveskel::life_laws {
namespace {

struct Known {
  std::string name;
  std::size_t tips;  // with a life of 1 or more
};

/// Of the catalogue.
const std::vector<Known>& known() {
  static const std::vector<Known> all{{"tube", 2},  {"arc", 2},     {"s", 2},      {"helix", 2},
                                      {"y", 3},     {"x", 4},       {"star", 7},   {"h", 4},
                                      {"torus", 0}, {"rings-5", 0}, {"ladder", 0}, {"sphere", 0}};
  return all;
}

Surface surface_of(const std::string& name) {
  for (const shapes::CatalogueEntry& entry : shapes::catalogue()) {
    if (entry.name == name) return entry.make().surface;
  }
  ADD_FAILURE() << name;
  return {};
}

std::vector<TipLife> clear_tips(const Surface& surface) {
  std::vector<TipLife> lives = tip_lives(surface);
  std::erase_if(lives, [](const TipLife& life) { return life.life < 1; });
  return lives;
}

/// Along edges; slow.
std::vector<double> distances_along_edges(const Surface& surface, int from) {
  const auto count = static_cast<std::size_t>(surface.positions.rows());
  std::vector<std::vector<int>> neighbours(count);
  for (const auto& t : surface.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) neighbours[idx(t[k])].push_back(t[(k + 1) % 3]);
  }
  std::vector<double> distance(count, std::numeric_limits<double>::infinity());
  std::set<std::pair<double, int>> front{{distance[idx(from)] = 0, from}};
  while (!front.empty()) {
    const int v = front.extract(front.begin()).value().second;
    for (const int next : neighbours[idx(v)]) {
      const double found =
          distance[idx(v)] + (surface.positions.row(next) - surface.positions.row(v)).norm();
      if (found >= distance[idx(next)]) continue;
      distance[idx(next)] = found;
      front.emplace(found, next);
    }
  }
  return distance;
}

// A wave that came back, across needles, to a step that was over ended there.
TEST(GeodesicDistances, AreNotLongerThanWaysAlongEdges) {
  for (const double shear : {0.0, 2.0, 20.0}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      SCOPED_TRACE(testing::Message() << "shear " << shear << " seed " << seed);
      Surface surface = shapes::noisy(shapes::box({8, 4, 1}, 8), 0.15, seed).surface;
      surface.positions.col(0) += shear * surface.positions.col(1);
      const Eigen::VectorXf found = GeodesicDistance(surface).from(0);
      const std::vector<double> along = distances_along_edges(surface, 0);
      for (std::size_t v = 0; v < along.size(); ++v) {
        EXPECT_LE(found[static_cast<Eigen::Index>(v)], 1.03 * along[v]) << "at " << v;
      }
    }
  }
}

TEST(TipLives, AreTheTipsOfKnownShapes) {
  for (const Known& one : known()) {
    EXPECT_EQ(clear_tips(surface_of(one.name)).size(), one.tips) << one.name;
  }
}

TEST(TipLives, FollowNeitherSizeNorPlace) {
  for (const Known& one : known()) {
    const Surface surface = surface_of(one.name);
    Surface moved = surface;
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    moved.positions =
        (1e-3 * surface.positions * turn.transpose()).rowwise() + Eigen::RowVector3d(0.5, -2, 7);
    const auto before = clear_tips(surface);
    const auto after = clear_tips(moved);
    ASSERT_EQ(before.size(), after.size()) << one.name;
    for (std::size_t k = 0; k < before.size(); ++k) {
      EXPECT_NEAR(std::log(before[k].life / after[k].life), 0, 0.12) << one.name;
    }
  }
}

TEST(TipLives, AreOrderedAndHangTogether) {
  for (const Known& one : known()) {
    const std::vector<TipLife> lives = tip_lives(surface_of(one.name));
    ASSERT_FALSE(lives.empty());
    std::size_t eldest = 0;
    for (std::size_t k = 0; k < lives.size(); ++k) {
      if (k > 0) {
        EXPECT_GE(lives[k - 1].life, lives[k].life);
      }
      EXPECT_GE(lives[k].birth, lives[k].death);
      EXPECT_GE(lives[k].area, 0);
      EXPECT_LE(lives[k].area, 0.5 + 1e-9);
      if (lives[k].parent < 0) {
        ++eldest;
        continue;
      }
      ASSERT_LT(static_cast<std::size_t>(lives[k].parent), lives.size());
      EXPECT_GE(lives[static_cast<std::size_t>(lives[k].parent)].birth, lives[k].birth);
    }
    EXPECT_EQ(eldest, 1U) << one.name;
  }
}

/// About the length of the limb over its radius where it begins.
TEST(TipLives, GrowWithTheLengthOfALimb) {
  double before = 0;
  for (const double length : {2.0, 4.0, 8.0}) {
    CurveSkeleton graph;
    graph.nodes.resize(4, 3);
    graph.nodes << 0, 0, 0, 12, 0, 0, -12, 0, 0, 0, 1.5 + length, 0;
    graph.edges.resize(3, 2);
    graph.edges << 0, 1, 0, 2, 0, 3;
    graph.radii = Eigen::Vector4d(1.5, 1.5, 1.5, 0.8);
    const Surface surface = shapes::tube_union("t", graph, {}).surface;
    const auto lives = tip_lives(surface);
    double life = 0;  // of the limb in the middle
    for (const TipLife& one : lives) {
      const Eigen::RowVector3d tip = surface.positions.row(one.vertex);
      if (std::abs(tip.x()) < 2 && tip.y() > 1) life = std::max(life, one.life);
    }
    EXPECT_GT(life, 1.4 * before) << length;
    before = life;
  }
}

TEST(TipLives, OptionsAreNamed) {
  const Surface torus = shapes::torus(3, 1, 12).surface;
  for (const LifeOptions& wrong :
       {LifeOptions{.samples = 2}, LifeOptions{.least_height = -1}, LifeOptions{.threads = -1},
        LifeOptions{.least_height = std::numeric_limits<double>::quiet_NaN()}}) {
    EXPECT_THROW((void)tip_lives(torus, wrong), Error);
  }
}

TEST(TipLives, AreTheSameOnAnyNumberOfThreads) {
  const Surface surface = surface_of("star");
  LifeOptions one;
  one.threads = 1;
  LifeOptions more;
  more.threads = 5;
  const auto a = tip_lives(surface, one);
  const auto b = tip_lives(surface, more);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].life, b[k].life);
}

}  // namespace
}  // namespace curveskel::life_laws
