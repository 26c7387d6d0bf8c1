// Prominence must not depend on how finely the surface is cut into triangles.
#include "skeleton/embed/branches/prominence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "meshes/shapes.hpp"

namespace curveskel::prominence_laws {
namespace {

const InscribedBalls none;

constexpr double far_beyond = 100;

/// From the vertex that is farthest in the direction `outwards` towards the origin, among the
/// vertices on that side.
double prominence_towards(const Surface& surface, const Eigen::Vector3d& outwards) {
  int apex = 0;
  const auto height = [&](int v) { return surface.positions.row(v).dot(outwards); };
  for (int v = 1; v < surface.positions.rows(); ++v) {
    if (height(v) > height(apex)) apex = v;
  }
  const WorkingSurface working(surface, none);
  ProminenceSweep prominence(working);
  const auto is_own = [&](int v) { return height(v) > 0; };
  return prominence(Eigen::Vector3d::Zero(), apex, is_own, far_beyond).prominence;
}

TEST(Prominence, IsAboutOneForTheCornerOfABox) {
  for (const int cells : {12, 24, 48}) {
    const auto box = shapes::box(Eigen::Vector3d::Ones(), cells);
    const Eigen::Vector3d centre = 0.5 * (box.surface.positions.colwise().minCoeff() +
                                          box.surface.positions.colwise().maxCoeff());
    Surface centred = box.surface;
    centred.positions.rowwise() -= centre.transpose();
    const Eigen::Vector3d corner = centred.positions.colwise().maxCoeff();
    int apex = 0;
    for (int v = 1; v < centred.positions.rows(); ++v) {
      if (centred.positions.row(v).dot(corner) > centred.positions.row(apex).dot(corner)) {
        apex = v;
      }
    }
    const auto in_the_octant = [&](int v) { return centred.positions.row(v).minCoeff() > 0; };
    const WorkingSurface working(centred, none);
    ProminenceSweep prominence(working);
    const double found =
        prominence(Eigen::Vector3d::Zero(), apex, in_the_octant, far_beyond).prominence;
    EXPECT_LT(found, 1.15) << cells << " cells";
  }
}

TEST(Prominence, GrowsWithTheLengthOfALimb) {
  double before = 1.15;
  for (const double length : {4.0, 8.0, 16.0}) {
    const auto limb = shapes::tube("limb", shapes::straight(length), shapes::constant(1), 24);
    const double found = prominence_towards(limb.surface, Eigen::Vector3d::UnitX());
    EXPECT_GT(found, before) << "length " << length;
    before = found;
  }
}

TEST(Prominence, HardlyDependsOnTheTriangles) {
  const auto limb = [](int sides) {
    return shapes::tube("limb", shapes::straight(4), shapes::constant(1), sides);
  };
  const double fine = prominence_towards(limb(96).surface, Eigen::Vector3d::UnitX());
  for (const int sides : {12, 24, 48}) {
    EXPECT_NEAR(prominence_towards(limb(sides).surface, Eigen::Vector3d::UnitX()), fine,
                0.05 * fine)
        << sides << " sides";
  }
}

TEST(Prominence, IsTheSameInTheNextSweep) {
  const auto limb = shapes::tube("limb", shapes::straight(6), shapes::constant(1), 24);
  const WorkingSurface working(limb.surface, none);
  ProminenceSweep prominence(working);
  const auto anything = [](int) { return true; };
  const double first = prominence({-3, 0, 0}, 0, anything, 1.5).prominence;
  EXPECT_EQ(prominence({-3, 0, 0}, 0, anything, 1.5).prominence, first);
}

TEST(Prominence, IsZeroWhereNothingIsItsOwn) {
  const auto limb = shapes::tube("limb", shapes::straight(6), shapes::constant(1), 24);
  const WorkingSurface working(limb.surface, none);
  ProminenceSweep prominence(working);
  EXPECT_EQ(prominence(
                {0, 0, 0}, 0, [](int) { return false; }, far_beyond)
                .prominence,
            0);
}

}  // namespace
}  // namespace curveskel::prominence_laws
