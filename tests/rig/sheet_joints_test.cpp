// Laws of joints in sheets: wings of one layer of triangles.
#include <curveskel/rig_polygons.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "meshes/shapes.hpp"
#include "tests/rig/plan_subjects.hpp"
#include "tests/soups.hpp"

namespace curveskel::sheet_joint_laws {
namespace {

constexpr double half_body = 0.5;
constexpr double span = 3;  // of a wing

/// A long body along z, and a wing on each side, of a quad for each half.
PolygonSoup flier() {
  PolygonSoup soup = soup_of(shapes::ellipsoid({half_body, half_body, 2}, 3).surface);
  for (const double side : {1.0, -1.0}) {
    const auto first = static_cast<std::int32_t>(soup.positions.rows());
    soup.positions.conservativeResize(first + 6, 3);
    for (int i = 0; i < 3; ++i) {
      const double x = side * (half_body + 0.5 * span * i);
      soup.positions.row(first + 2 * i) << x, 0.1 * i, -0.4;
      soup.positions.row(first + 2 * i + 1) << x, 0.1 * i, 0.4;
    }
    append(soup, {first, first + 2, first + 3, first + 1});
    append(soup, {first + 2, first + 4, first + 5, first + 3});
  }
  return soup;
}

/// Joints beyond the body's sides, on the left and on the right.
std::pair<int, int> joints_beside(const Rig& rig) {
  std::pair<int, int> count{0, 0};
  for (const auto& joint : rig.joints.rowwise()) {
    if (std::abs(joint.x()) <= half_body + 0.2 * span) continue;
    ++(joint.x() > 0 ? count.first : count.second);
  }
  return count;
}

TEST(SheetJoints, AWingOfOneLayerHasJoints) {
  const PolygonSoup soup = flier();
  const PolygonsRig found = rig_polygons(soup);
  const auto [left, right] = joints_beside(found.character.rig);
  EXPECT_GE(left, 2);
  EXPECT_EQ(left, right);
  ASSERT_TRUE(found.certificate);
  EXPECT_TRUE(found.certificate->curve_like);
  // A wing's tip moves with the wing's joints alone.
  const SkinWeights& weights = found.character.rig.weights;
  for (Eigen::Index v = 0; v < soup.positions.rows(); ++v) {
    if (std::abs(soup.positions(v, 0)) < half_body + 0.9 * span) continue;
    for (SkinWeights::InnerIterator it(weights, v); it; ++it) {
      if (it.value() < 0.1F) continue;
      EXPECT_GT(soup.positions(v, 0) * found.character.rig.joints(it.col(), 0), 0);
    }
  }
}

TEST(SheetJoints, WithoutAThicknessTheWingFollowsTheBody) {
  RigPolygonsOptions options;
  options.repair.least_sheet = 0;
  const PolygonsRig found = rig_polygons(flier(), {}, options);
  const auto [left, right] = joints_beside(found.character.rig);
  EXPECT_EQ(left + right, 0);
}

/// Banners from the shoulders down to the ground, one on each side.
PolygonSoup with_banners(const Surface& surface) {
  PolygonSoup soup = soup_of(surface);
  for (const double side : {1.0, -1.0}) {
    const auto first = static_cast<std::int32_t>(soup.positions.rows());
    soup.positions.conservativeResize(first + 6, 3);
    for (int i = 0; i < 3; ++i) {
      const double y = 14.5 - 7.2 * i;
      soup.positions.row(first + 2 * i) << side * 3.2, y, -2;
      soup.positions.row(first + 2 * i + 1) << side * 4.8, y, -2.2;
    }
    append(soup, {first, first + 2, first + 3, first + 1});
    append(soup, {first + 2, first + 4, first + 5, first + 3});
  }
  return soup;
}

TEST(SheetJoints, SheetsAreNoLegsOfAHuman) {
  const PolygonSoup soup = with_banners(human().surface);
  const PolygonsRig found = rig_polygons(soup);
  EXPECT_EQ(found.character.plan.plan, BodyKind::humanoid) << found.character.plan.reason;
  EXPECT_TRUE(found.character.plan.missing.empty());
  const auto& joints = found.character.rig.joints;
  EXPECT_TRUE((joints.col(2).array() < -1.5).any());  // in a banner
}

}  // namespace
}  // namespace curveskel::sheet_joint_laws
