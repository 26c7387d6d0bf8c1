#include "viewer/model/defects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "meshes/shapes.hpp"
#include "viewer/render/scene_colours.hpp"

namespace curveskel::viewer::defects_laws {
namespace {

std::vector<Surface> family() {
  return {shapes::torus(3, 1, 10).surface, shapes::linked_rings(2, 0.7, 8).surface};
}

/// The faces that share an edge with `face`.
std::vector<int> neighbours_of(const Surface& surface, int face) {
  std::vector<int> found;
  const std::set<int> corners{surface.triangles(face, 0), surface.triangles(face, 1),
                              surface.triangles(face, 2)};
  for (int other = 0; other < static_cast<int>(surface.triangles.rows()); ++other) {
    int shared = 0;
    for (const int vertex : surface.triangles.row(other)) shared += corners.contains(vertex);
    if (shared == 2) found.push_back(other);
  }
  return found;
}

Surface without(const Surface& surface, int face) {
  Surface rest = surface;
  const Eigen::Index last = surface.triangles.rows() - 1;
  rest.triangles.row(face) = surface.triangles.row(last);
  rest.triangles.conservativeResize(last, 3);
  return rest;
}

TEST(Defects, AClosedSurfaceHasNone) {
  for (const Surface& surface : family()) EXPECT_TRUE(defects_of(surface).none());
}

TEST(Defects, OfLooseTrianglesAreThoseOfTheirSurface) {
  for (const Surface& surface : family()) {
    Surface loose{Positions(3 * surface.triangles.rows(), 3), surface.triangles};
    for (Eigen::Index i = 0; i < 3 * surface.triangles.rows(); ++i) {
      loose.positions.row(i) = surface.positions.row(surface.triangles(i / 3, i % 3));
      loose.triangles(i / 3, i % 3) = static_cast<int>(i);
    }
    EXPECT_TRUE(defects_of(loose).none());
  }
}

TEST(Defects, AMissingFaceLeavesItsNeighboursOpen) {
  for (const Surface& surface : family()) {
    const auto last = static_cast<int>(surface.triangles.rows()) - 1;
    const Defects found = defects_of(without(surface, last));
    EXPECT_EQ(found.open, neighbours_of(surface, last));
    EXPECT_TRUE(found.non_manifold.empty() && found.flipped.empty() && found.degenerate.empty());
  }
}

TEST(Defects, AFaceThatIsThereTwiceIsNonManifold) {
  for (const Surface& surface : family()) {
    Surface twice = surface;
    const auto count = static_cast<int>(surface.triangles.rows());
    twice.triangles.conservativeResize(count + 1, 3);
    twice.triangles.row(count) = surface.triangles.row(0);
    std::vector<int> expected = neighbours_of(surface, 0);
    expected.insert(expected.end(), {0, count});
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(defects_of(twice).non_manifold, expected);
  }
}

TEST(Defects, AFlippedFaceIsNamedWithItsNeighbours) {
  for (const Surface& surface : family()) {
    Surface flipped = surface;
    flipped.triangles.row(5) = surface.triangles.row(5).reverse();
    std::vector<int> expected = neighbours_of(surface, 5);
    expected.push_back(5);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(defects_of(flipped).flipped, expected);
  }
}

TEST(Defects, AFaceWithoutAreaIsDegenerate) {
  for (const Surface& surface : family()) {
    Surface thin = surface;
    const int count = static_cast<int>(surface.triangles.rows());
    thin.triangles.conservativeResize(count + 1, 3);
    thin.triangles.row(count) << 0, 0, 1;
    EXPECT_EQ(defects_of(thin).degenerate, std::vector<int>{count});
  }
}

TEST(Defects, AreRedAndNothingElseIs) {
  for (const Surface& surface : family()) {
    Highlights highlights;
    highlights.failed_faces = {3};
    const std::vector<Rgba> colours = surface_colours(surface, {}, {}, highlights);
    ASSERT_EQ(colours.size(), static_cast<std::size_t>(surface.positions.rows()));
    const std::set<int> corners{surface.triangles(3, 0), surface.triangles(3, 1),
                                surface.triangles(3, 2)};
    const Rgba plain = rgba(palette_of(Theme::light).surface);
    for (std::size_t v = 0; v < colours.size(); ++v) {
      EXPECT_EQ(colours[v] != plain, corners.contains(static_cast<int>(v)));
    }
  }
}

}  // namespace
}  // namespace curveskel::viewer::defects_laws
