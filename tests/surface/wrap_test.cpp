// Laws of wraps: what they span and follow, what they leave out, and when they end.
#include "surface/repair/wrap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/certificate.hpp>
#include <curveskel/repair.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"
#include "surface/repair/close_surface.hpp"
#include "surface/repair/join_soup.hpp"
#include "surface/repair/wrap_solid.hpp"
#include "tests/soups.hpp"
#include "tests/surface/repair_subjects.hpp"

namespace curveskel::wrap_laws {
namespace {

TEST(Wrapping, WrapsWhatHasGapsEverywhere) {
  const shapes::Shape ring = shapes::torus(3, 1, 24);
  const PolygonSoup soup = shrunk_apart(ring.surface, 0.05);
  const RepairedSurface result = repair(soup, {}, {});
  expect_closed_outward_manifold(result.surface);
  EXPECT_EQ(topology(result.surface).components(), 1);
  EXPECT_EQ(genus_of(result.surface), 1);
  EXPECT_NEAR(volume(result.surface), volume(ring.surface), 0.1 * volume(ring.surface));
  EXPECT_EQ(result.repairs.faces_wrapped, ring.surface.triangles.rows());
  EXPECT_GT(result.repairs.wrap_distance, 0);
  EXPECT_LT(result.repairs.wrap_distance, 0.02);
  ASSERT_EQ(result.repairs.lines.size(), 1U);
  expect_said(result.repairs.lines[0], {"wrapped"});
  EXPECT_EQ(used_but_dropped(soup, result), 0);
  const double diagonal = bounding_box_diagonal(soup.positions);
  for (Eigen::Index v = 0; v < soup.positions.rows(); ++v) {
    const auto mapped = result.surface.positions.row(result.vertex_of_input[v]);
    ASSERT_LT((mapped - soup.positions.row(v)).norm(), 0.03 * diagonal);
  }
}

RepairedSurface wrapped_whole(const PolygonSoup& soup, double wrap_gap = 0) {
  RepairOptions options;
  options.wrap = Wrapping::all;
  options.wrap_gap = wrap_gap;
  return repair(soup, options, {});
}

TEST(Wrapping, WrapsAllThatOverlapsIntoOneBodyIfAsked) {
  const auto ball = shapes::ellipsoid({1, 1, 1}, 4);
  const auto pair = shapes::together("pair", {ball, shapes::translated(ball, {1.2, 0, 0})}).surface;
  EXPECT_EQ(topology(repair(soup_of(pair), {}, {}).surface).components(), 2);
  const RepairedSurface result = wrapped_whole(soup_of(pair));
  expect_closed_outward_manifold(result.surface);
  EXPECT_EQ(topology(result.surface).components(), 1);
  EXPECT_EQ(genus_of(result.surface), 0);
  EXPECT_TRUE(result.repairs.wrapped_as_asked);
  EXPECT_EQ(result.repairs.faces_wrapped, pair.triangles.rows());
  ASSERT_EQ(result.repairs.lines.size(), 1U);
  expect_said(result.repairs.lines[0], {"wrapped, as asked"});
  ASSERT_EQ(result.vertex_of_input.size(), pair.positions.rows());
  EXPECT_GE(result.vertex_of_input.minCoeff(), 0);
}

TEST(Wrapping, AWrapSpansGapsThatAreNarrowerThanItsWrapGap) {
  const auto box = shapes::box({1, 1, 1}, 8);
  const auto pair = shapes::together("pair", {box, shapes::translated(box, {1.1, 0, 0})}).surface;
  const double gap = 0.1 / bounding_box_diagonal(pair.positions);
  EXPECT_EQ(topology(wrapped_whole(soup_of(pair), 0.4 * gap).surface).components(), 2);
  const RepairedSurface one = wrapped_whole(soup_of(pair), 3 * gap);
  EXPECT_EQ(topology(one.surface).components(), 1);
  EXPECT_EQ(one.repairs.wrap_gap, 3 * gap);
}

TEST(Wrapping, ASpeckFarAwayDoesNotSetTheScaleOfAWrap) {
  const auto ball = shapes::ellipsoid({1, 1, 1}, 4);
  const auto speck = shapes::translated(shapes::ellipsoid({0.003, 0.003, 0.003}, 1), {500, 0, 0});
  const auto soup = soup_of(shapes::together("pair", {ball, speck}).surface);
  const RepairedSurface result = wrapped_whole(soup);
  EXPECT_EQ(topology(result.surface).components(), 1);
  EXPECT_NEAR(volume(result.surface), volume(ball.surface), 0.05 * volume(ball.surface));
  EXPECT_EQ(result.repairs.specks_dropped, 1);
  EXPECT_EQ(result.vertex_of_input[soup.positions.rows() - 1], -1);
}

TEST(Wrapping, WhatAWrapLeavesOutIsCountedAndMovesNothing) {
  const auto ball = shapes::ellipsoid({1, 1, 1}, 4);
  const auto soup = soup_of(ball.surface);
  PolygonSoup with_sheet = soup;
  const auto first = static_cast<std::int32_t>(soup.positions.rows());
  with_sheet.positions.conservativeResize(first + 4, 3);
  with_sheet.positions.bottomRows(4) = Positions{{4, -1, -1}, {4, 1, -1}, {4, 1, 1}, {4, -1, 1}};
  append(with_sheet, {first, first + 1, first + 2});
  append(with_sheet, {first, first + 2, first + 3});
  const RepairedSurface result = wrapped_whole(with_sheet);
  EXPECT_EQ(result.repairs.sheets_dropped, 1);
  for (int v = 0; v < 4; ++v) EXPECT_EQ(result.vertex_of_input[first + v], -1);
  EXPECT_GE(result.vertex_of_input[0], 0);
}

TEST(Wrapping, TheDistanceOfAWrapIsThatOfWhatItSpans) {
  const auto ball = shapes::ellipsoid({1, 1, 1}, 4);
  const auto pair = shapes::together("pair", {ball, shapes::translated(ball, {2.05, 0, 0})});
  const double diagonal = bounding_box_diagonal(pair.surface.positions);
  const RepairedSurface result = wrapped_whole(soup_of(pair.surface), 0.2);
  EXPECT_EQ(topology(result.surface).components(), 1);
  EXPECT_GT(result.repairs.wrap_distance * diagonal, 0.05);  // the tent between the two
  EXPECT_LT(result.repairs.wrap_mean_distance, result.repairs.wrap_distance / 2);
}

TEST(Wrapping, RefusesToWrapWhatHasNoInside) {
  auto sheet = with_polygons(soup_of(shapes::box({1, 1, 1}, 4).surface),
                             [](std::size_t p) { return p < 2; });
  sheet.positions.row(sheet.corners[0]).array() += 0.01;  // no flat drawing, which is told at once
  try {
    (void)wrapped_whole(sheet);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    expect_said(error.what(), {"--wrap-gap", "Solidify"});
  }
}

TEST(Wrapping, WhatNoWrapEnclosesButHasAnInsideIsToBeRepairedWithout) {
  try {
    (void)wrapped_whole(open_tube(), 0.04);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    expect_said(error.what(), {"leave --wrap all out"});
  }
}

TEST(Wrapping, RefusesAWrapThatIsTooLargeAndNamesTheNarrowestWrapGap) {
  const Surface torus = shapes::torus(3, 1, 24).surface;
  const double diagonal = bounding_box_diagonal(torus.positions);
  double named = 0;
  try {
    (void)wrapped_whole(soup_of(torus), 1e-6);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    expect_said(error.what(), {"vertices", "1e-06"});
    const std::string option = "--wrap-gap ";
    const std::string message = error.what();
    named = std::stod(message.substr(message.find(option) + option.size()));
  }
  std::stop_source stop;
  stop.request_stop();
  Monitor monitor;
  monitor.stop = stop.get_token();
  WrapBudget budget;
  EXPECT_THROW((void)wrap(torus, {named * diagonal, 0.001}, budget, monitor), Cancelled)
      << "begins";
  EXPECT_THROW((void)wrap(torus, {0.9 * named * diagonal, 0.001}, budget, monitor), Error);
}

TEST(Wrapping, AWrapEndsWithItsBudget) {
  const Surface torus = shapes::torus(3, 1, 24).surface;
  WrapBudget none{100};  // less than the area alone takes
  EXPECT_THROW((void)wrap(torus, {0.1, 0.01}, none, {}), WrapTooLarge);
  EXPECT_EQ(none.vertices, 100);
  WrapBudget enough;
  (void)wrap(torus, {1, 0.01}, enough, {});
  const std::int64_t needed = WrapBudget().vertices - enough.vertices;
  WrapBudget less{needed - 10};
  EXPECT_THROW((void)wrap(torus, {1, 0.01}, less, {}), WrapTooLarge);
}

/// Triangles anywhere in a cube, each as large as the cube.
PolygonSoup loose_triangles(int count) {
  shapes::Random random(1);
  PolygonSoup soup;
  soup.positions.resize(Eigen::Index{3} * count, 3);
  for (double& x : soup.positions.reshaped()) x = random.uniform(0, 1);
  soup.offsets = {0};
  for (int t = 0; t < count; ++t) append(soup, {3 * t, 3 * t + 1, 3 * t + 2});
  return soup;
}

/// As a wider wrap has told.
TEST(Wrapping, AWrapThatWouldNotEndWithItsBudgetIsNotBegun) {
  const Surface ball = shapes::ellipsoid({1, 1, 1}, 3).surface;
  const WrapOptions options{0.2, 0.01};
  int reports = 0;
  Monitor monitor;
  monitor.progress = [&](std::string_view, double) { ++reports; };
  WrapBudget budget{10000};
  const Surface wrapped = wrap(ball, options, budget, monitor);
  EXPECT_GT(reports, 0);
  const double told = vertices_for_expected(wrapped, ball, 0.2 / extent_of_faces(ball));
  EXPECT_NEAR(told * area(ball) / (0.2 * 0.2), double(wrapped.positions.rows()), 1e-6);
  reports = 0;
  budget = {wrapped.positions.rows() - 1, told};
  EXPECT_THROW((void)wrap(ball, options, budget, monitor), WrapTooLarge);
  EXPECT_EQ(reports, 0);
}

// The narrowest gap would take 136,000 vertices, and minutes.
TEST(Wrapping, ASoupIsWrappedWithinTheBudgetAndSaysWhatTheWrapFollows) {
  const RepairedSurface result = repair(loose_triangles(50), {}, {});
  expect_closed_outward_manifold(result.surface);
  EXPECT_LT(result.surface.positions.rows(), budget_of_needed_wraps.vertices);
  EXPECT_LT(result.repairs.wrap_followed, wrap_followed_needed);
  const RepairedSurface close = repair(shrunk_apart(shapes::torus(3, 1, 24).surface, 0.05), {}, {});
  EXPECT_GT(close.repairs.wrap_followed, 0.95);
}

TEST(Wrapping, AWrapSaysHowFarItIs) {
  const Surface torus = shapes::torus(3, 1, 24).surface;
  std::vector<double> fractions;
  Monitor monitor;
  monitor.progress = [&](std::string_view, double fraction) { fractions.push_back(fraction); };
  WrapBudget budget;
  (void)wrap(torus, {0.25, 0.01}, budget, monitor);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1);
  const auto is_between = [](double fraction) { return fraction > 0.1 && fraction < 0.9; };
  EXPECT_GT(std::count_if(fractions.begin(), fractions.end(), is_between), 5);
}

TEST(Wrapping, WrapsNothingIfItMayNot) {
  RepairOptions options;
  options.wrap = Wrapping::never;
  const PolygonSoup soup = shrunk_apart(shapes::torus(3, 1, 24).surface, 0.05);
  EXPECT_THROW((void)repair(soup, options, {}), Error);
}

}  // namespace
}  // namespace curveskel::wrap_laws
