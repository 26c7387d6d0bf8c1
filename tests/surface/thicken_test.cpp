// Laws of sheets that become thin bodies.
#include <curveskel/repair.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include <curveskel/error.hpp>
#include <curveskel/topology.hpp>
#include "tests/surface/repair_subjects.hpp"

namespace curveskel::thicken_laws {
namespace {

using Position = Eigen::RowVector3d;

constexpr int across = 4;  // vertices

/// A ball of radius 1 with a bent strip of `length` beside it, on each side, from `gap` away on.
PolygonSoup winged(double length, double gap) {
  PolygonSoup soup = soup_of(shapes::ellipsoid({1, 1, 1}, 3).surface);
  constexpr int along = 9;
  for (const double side : {1.0, -1.0}) {
    const auto first = static_cast<std::int32_t>(soup.positions.rows());
    soup.positions.conservativeResize(first + across * along, 3);
    for (int i = 0; i < along; ++i) {
      for (int k = 0; k < across; ++k) {
        const double way = static_cast<double>(i) / (along - 1);
        soup.positions.row(first + across * i + k) << side * (1 + gap + length * way),
            0.2 * std::sin(3 * way), 0.25 * length * (k / (across - 1.0) - 0.5);
      }
    }
    for (std::int32_t i = 0; i + 1 < along; ++i) {
      for (std::int32_t k = 0; k + 1 < across; ++k) {
        const std::int32_t corner = first + across * i + k;
        append(soup, {corner, corner + across, corner + across + 1, corner + 1});
      }
    }
  }
  return soup;
}

RepairOptions thick(double least) {
  RepairOptions options;
  options.least_sheet = least;
  return options;
}

double volume_of(const Surface& surface, const Topology& counted, int component) {
  double sum = 0;
  for (const auto& t : surface.triangles.rowwise()) {
    if (counted.component_of_vertex[t[0]] != component) continue;
    const Position a = surface.positions.row(t[0]);
    const Position b = surface.positions.row(t[1]);
    sum += a.dot(b.cross(Position(surface.positions.row(t[2])))) / 6;
  }
  return sum;
}

TEST(Thicken, EachSheetBecomesAClosedBodyAboutItself) {
  const PolygonSoup soup = winged(3, 0.1);
  const RepairedSurface result = repair(soup, thick(0.1));
  const Topology counted = topology(result.surface);
  EXPECT_EQ(counted.components(), 3);
  EXPECT_EQ(counted.total_genus(), 0);
  EXPECT_EQ(result.repairs.sheets_thickened, 2);
  EXPECT_EQ(result.repairs.sheets_dropped, 0);
  EXPECT_EQ(used_but_dropped(soup, result), 0);
  ASSERT_EQ(result.sheets.size(), 2U);
  EXPECT_NE(counted.component_of_vertex[result.sheets[0]],
            counted.component_of_vertex[result.sheets[1]]);
  const double thickness = 0.01 * std::sqrt(3 * 0.75 * 1.1);
  for (Eigen::Index v = 0; v < soup.positions.rows(); ++v) {
    const Position moved =
        result.surface.positions.row(result.vertex_of_input[v]) - soup.positions.row(v);
    EXPECT_LT(moved.norm(), 1.5 * thickness);
  }
  for (int component = 0; component < 3; ++component) {
    EXPECT_GT(volume_of(result.surface, counted, component), 0);
  }
}

TEST(Thicken, WhatIsSmallerIsLeftOut) {
  const PolygonSoup soup = winged(3, 0.1);
  for (const double least : {0.0, 0.5}) {
    const RepairedSurface result = repair(soup, thick(least));
    EXPECT_EQ(topology(result.surface).components(), 1);
    EXPECT_EQ(result.repairs.sheets_thickened, 0);
    EXPECT_EQ(result.repairs.sheets_dropped, 2);
    EXPECT_TRUE(result.sheets.empty());
  }
}

TEST(Thicken, SheetsAreStillKnownAfterComponentsWereLeftOut) {
  RepairOptions options = thick(0.1);
  options.components = 2;
  const RepairedSurface result = repair(winged(3, 0.1), options);
  ASSERT_EQ(result.sheets.size(), 1U);
  const Topology counted = topology(result.surface);
  ASSERT_EQ(counted.components(), 2);
  const int sheet = counted.component_of_vertex[result.sheets[0]];
  EXPECT_LT(volume_of(result.surface, counted, sheet),
            volume_of(result.surface, counted, 1 - sheet));
}

/// Two triangles that share one vertex alone, and a closed flat part, have no second side.
TEST(Thicken, SheetsWithoutTwoSidesAreLeftOut) {
  PolygonSoup soup = soup_of(shapes::ellipsoid({1, 1, 1}, 3).surface);
  const auto first = static_cast<std::int32_t>(soup.positions.rows());
  soup.positions.conservativeResize(first + 4, 3);
  soup.positions.bottomRows(4) << 2, 0, 0, 4, 0, 0, 4, 1, 0, 2, 1, 0;
  append(soup, {first, first + 1, first + 2});
  append(soup, {first, first + 2, first + 3});
  append(soup, {first + 1, first, first + 3});
  append(soup, {first + 1, first + 3, first + 2});
  const RepairedSurface result = repair(soup, thick(0.1));
  EXPECT_EQ(topology(result.surface).components(), 1);
  EXPECT_EQ(result.repairs.sheets_dropped, 1);
}

/// A leaf, a paper doll: with both sides it has a curve.
TEST(Thicken, ADrawingInThePlaneIsASheet) {
  PolygonSoup soup = soup_of(Positions(0, 3), {});
  soup.positions.resize(6, 3);
  soup.positions << 0, 0, 0, 0, 1, 0, 3, 0, 0, 3, 1, 0, 6, 0, 0, 6, 1, 0;
  append(soup, {0, 2, 3, 1});
  append(soup, {2, 4, 5, 3});
  EXPECT_THROW((void)repair(soup), Error);
  const RepairedSurface result = repair(soup, thick(0.1));
  EXPECT_EQ(result.repairs.sheets_thickened, 1);
  EXPECT_EQ(topology(result.surface).components(), 1);
  EXPECT_EQ(used_but_dropped(soup, result), 0);
  RepairOptions wrapped = thick(0.1);
  wrapped.wrap = Wrapping::all;
  EXPECT_THROW((void)repair(soup, wrapped), Error);
}

TEST(Thicken, OptionsOutOfRangeAreRefused) {
  EXPECT_THROW((void)repair(winged(3, 0.1), thick(1.5)), Error);
  EXPECT_THROW((void)repair(winged(3, 0.1), thick(-0.1)), Error);
}

}  // namespace
}  // namespace curveskel::thicken_laws
