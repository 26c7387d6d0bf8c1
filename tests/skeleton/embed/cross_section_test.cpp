// The middle of a limb, seen from a point in it.
#include "skeleton/embed/place/cross_section.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <curveskel/advanced/tree.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::cross_section_laws {
namespace {

constexpr double half_length = 5;
const Point along = Point::UnitX();

/// A tube along x, half as wide in y as 1 and in z as `half_thickness`.
Surface flat_bar(double half_thickness) {
  Surface bar =
      shapes::tube("bar", shapes::straight(2 * half_length), shapes::constant(1), 80).surface;
  bar.positions.col(2) *= half_thickness;
  return bar;
}

const auto all_own = [](int) { return true; };
const auto none_own = [](int) { return false; };

TEST(CrossSection, HasItsCentreOnARoundTubesAxisToFirstOrder) {
  const SurfaceTree tree(flat_bar(1));
  for (const double off : {0.01, 0.05, 0.1}) {
    const Point p(0.3, off, -off / 2);
    const double radius = tree.inscribed_radius(p);
    for (const Point& centre : {cross_section_centre(tree, p, along, radius),
                                flat_cross_section(tree, p, along, radius, all_own).centre}) {
      EXPECT_LT((centre - Point(0.3, 0, 0)).norm(), 2 * off * off + 1e-3) << off;
    }
  }
}

// Rays that are cut say nothing about where the edges of a flat limb are.
TEST(CrossSection, OfAFlatLimbLiesBetweenItsEdges) {
  for (const double thickness : {0.02, 0.05, 0.2}) {
    const SurfaceTree tree(flat_bar(thickness));
    for (const double off : {-0.6, 0.6}) {
      Point p(0.1, off, 0);
      for (int step = 0; step < 1000 && std::abs(p.y()) > 0.05; ++step) {
        const double radius = tree.inscribed_radius(p);
        const auto [next, width] = flat_cross_section(tree, p, along, radius, all_own);
        ASSERT_LE((next - p).norm(), 0.5 * width + 1e-12);
        ASSERT_LT(width, 1);                                // that of a round limb
        ASSERT_LT((next - p).norm(), 2 * std::abs(p.y()));  // not to and fro
        p = next;
      }
      EXPECT_LE(std::abs(p.y()), 0.05) << "half as thick as " << thickness << ", from " << off;
      EXPECT_LT(std::abs(p.z()), 0.1 * thickness);
    }
  }
}

TEST(CrossSection, IsAsWideAsARoundLimbsRadius) {
  const SurfaceTree tree(flat_bar(1));
  const Point p(0.3, 0, 0);
  const double radius = tree.inscribed_radius(p);
  EXPECT_NEAR(flat_cross_section(tree, p, along, radius, all_own).width, 1, 0.01);
}

TEST(CrossSection, LeavesOutWhatBelongsToOtherLimbs) {
  const SurfaceTree tree(flat_bar(0.05));
  const Point p(0.1, 0.5, 0.01);
  const double radius = tree.inscribed_radius(p);
  const Point plain = cross_section_centre(tree, p, along, radius);
  EXPECT_EQ(flat_cross_section(tree, p, along, radius, none_own).centre, plain);
  // One of the two edges is not enough.
  const Surface bar = flat_bar(0.05);
  const auto far_half = [&](int triangle) {
    return bar.positions(bar.triangles(triangle, 0), 1) < 0;
  };
  EXPECT_LT(std::abs(flat_cross_section(tree, p, along, radius, far_half).centre.y() - plain.y()),
            1e-12);
}

TEST(CrossSection, IsThePointItselfOutside) {
  const SurfaceTree tree(flat_bar(1));
  const Point p(0, 0, 2);
  EXPECT_EQ(cross_section_centre(tree, p, along, tree.inscribed_radius(p)), p);
  EXPECT_EQ(flat_cross_section(tree, p, along, tree.inscribed_radius(p), all_own).centre, p);
}

}  // namespace
}  // namespace curveskel::cross_section_laws
