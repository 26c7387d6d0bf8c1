// Where there is no other way inside, there is one just below the surface.
#include "skeleton/embed/contain/below_surface.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/homology/homology_guard.hpp"

namespace curveskel::below_surface_laws {
namespace {

std::vector<std::pair<const char*, Surface>> surfaces() {
  std::vector<std::pair<const char*, Surface>> all{
      {"tube", shapes::tube("tube", shapes::straight(2), shapes::constant(0.3), 12).surface},
      {"helix",
       shapes::tube("helix", shapes::helix(1, 1.2, 1.5), shapes::constant(0.2), 9).surface},
      {"torus", shapes::torus(1, 0.3, 14).surface}};
  all.push_back({"flat torus", all.back().second});
  all.back().second.positions.col(2) *= 0.05;
  for (auto& [name, surface] : all) {
    surface.positions /= bounding_box_diagonal(surface.positions);
  }
  return all;
}

TEST(BelowSurface, StepsLieInsideAndMeetNoSurface) {
  for (const auto& [name, surface] : surfaces()) {
    SCOPED_TRACE(name);
    const SurfaceTree tree(surface);
    const InscribedBalls none;
    const WorkingSurface working(surface, none);
    const BelowSurface below(working);
    for (Eigen::Index t = 0; t < surface.triangles.rows(); t += 3) {
      const auto way = below.step(surface.triangles(t, 0), surface.triangles(t, 1));
      for (std::size_t i = 0; i < way.size(); ++i) {
        EXPECT_GT(tree.inscribed_radius(way[i]), 0);
        EXPECT_TRUE(i == 0 || !crosses(tree, way[i - 1], way[i]));
      }
    }
  }
}

TEST(BelowSurface, StepsJoin) {
  for (const auto& [name, surface] : surfaces()) {
    const InscribedBalls none;
    const WorkingSurface working(surface, none);
    const BelowSurface below(working);
    for (Eigen::Index t = 0; t < surface.triangles.rows(); t += 5) {
      const auto first = below.step(surface.triangles(t, 0), surface.triangles(t, 1));
      const auto second = below.step(surface.triangles(t, 1), surface.triangles(t, 2));
      EXPECT_EQ(first.back(), second.front()) << name;
    }
  }
}

TEST(BelowSurface, RoundAVertexLiesInsideAndBeginsWhereItsStepsDo) {
  for (const auto& [name, surface] : surfaces()) {
    SCOPED_TRACE(name);
    const SurfaceTree tree(surface);
    const InscribedBalls none;
    const WorkingSurface working(surface, none);
    const BelowSurface below(working);
    for (Eigen::Index t = 0; t < surface.triangles.rows(); t += 5) {
      const int vertex = surface.triangles(t, 0);
      const auto around = below.around(vertex);
      const auto valence = (surface.triangles.array() == vertex).count();
      EXPECT_EQ(around.size(), 2 * static_cast<std::size_t>(valence) - 1);
      EXPECT_EQ(around.front(), below.step(vertex, surface.triangles(t, 1)).front());
      for (std::size_t i = 0; i < around.size(); ++i) {
        EXPECT_GT(tree.inscribed_radius(around[i]), 0);
        EXPECT_TRUE(i == 0 || !crosses(tree, around[i - 1], around[i]));
      }
    }
  }
}

}  // namespace
}  // namespace curveskel::below_surface_laws
