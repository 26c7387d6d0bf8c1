// Laws of repair: what was whole before the damage is whole after the repair.
#include <curveskel/repair.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <random>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/certificate.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"
#include "surface/mesh/lids.hpp"
#include "surface/read/placed_vertices.hpp"
#include "surface/repair/close_surface.hpp"
#include "tests/soups.hpp"
#include "tests/surface/repair_subjects.hpp"

namespace curveskel::repair_laws {
namespace {

using Position = Eigen::RowVector3d;

// ---- Over shapes --------------------------------------------------------------------------------

class AnyShape : public testing::TestWithParam<shapes::Shape> {
 protected:
  [[nodiscard]] const shapes::Shape& shape() const { return GetParam(); }
  void expect_the_shape(const RepairedSurface& result, double volume_tolerance) const {
    expect_closed_outward_manifold(result.surface);
    EXPECT_EQ(topology(result.surface).components(), shape().components);
    EXPECT_EQ(genus_of(result.surface), shape().genus);
    const double wanted = volume(shape().surface);
    EXPECT_NEAR(volume(result.surface), wanted, volume_tolerance * wanted);
  }
};

TEST_P(AnyShape, IsLeftAloneWhenWhole) {
  const RepairedSurface result = repair(soup_of(shape().surface), {}, {});
  EXPECT_EQ(result.surface.positions, shape().surface.positions);
  EXPECT_EQ(result.surface.triangles, shape().surface.triangles);
  EXPECT_TRUE(result.repairs.lines.empty());
}

TEST_P(AnyShape, IsWholeAgainAfterLosingFaces) {
  const PolygonSoup whole = soup_of(shape().surface);
  std::mt19937 random(7);
  const PolygonSoup damaged = with_polygons(whole, [&](std::size_t) { return random() % 40 != 0; });
  const RepairedSurface result = repair(damaged, {}, {});
  expect_the_shape(result, 0.02);
  EXPECT_GT(result.repairs.holes_closed, 0);
  EXPECT_EQ(used_but_dropped(damaged, result), 0);
  EXPECT_EQ(result.rims.size(), static_cast<std::size_t>(result.repairs.holes_closed));
}

TEST_P(AnyShape, IsWholeAgainAfterLosingVerticesThatHaveNoPlace) {
  PolygonSoup soup = soup_of(shape().surface);
  const Eigen::Index vertices = soup.positions.rows();
  std::int64_t lost = 0;
  for (Eigen::Index v = 17; v < vertices; v += 150, ++lost) {
    soup.positions(v, v % 3) = v % 2 == 0 ? std::nan("") : HUGE_VAL;
  }
  drop_unplaced_vertices(soup, {"shape.obj", {}});
  const RepairedSurface result = repair(soup, {}, {});
  expect_the_shape(result, 0.03);
  EXPECT_EQ(result.changes.unplaced_vertices_dropped, lost);
  EXPECT_GE(result.changes.unplaced_polygons_dropped, 3 * lost);
  EXPECT_EQ(result.changes.isolated_vertices_dropped, 0);
  EXPECT_NE(result.changes.lines.front().find("NaN or infinity"), std::string::npos);
  EXPECT_EQ(used_but_dropped(soup, result), 0);
}

TEST_P(AnyShape, IsWholeAgainFromTrianglesThatNearlyMeet) {
  PolygonSoup soup = torn(soup_of(shape().surface));
  const double step = 1e-7 * bounding_box_diagonal(soup.positions);
  std::mt19937 random(3);
  for (double& x : soup.positions.reshaped()) {
    x += step * (static_cast<double>(random()) / 4294967296.0 - 0.5);
  }
  const RepairedSurface result = repair(soup, {}, {});
  expect_the_shape(result, 1e-5);
  EXPECT_EQ(result.surface.positions.rows(), shape().surface.positions.rows());
  EXPECT_EQ(used_but_dropped(soup, result), 0);
}

TEST_P(AnyShape, LosesAFinAndNothingElse) {
  PolygonSoup soup = soup_of(shape().surface);
  const auto& t = shape().surface.triangles.row(0);
  const auto tip = static_cast<std::int32_t>(soup.positions.rows());
  soup.positions.conservativeResize(tip + 1, 3);
  const Position a = soup.positions.row(t(0));
  const Position b = soup.positions.row(t(1));
  const Position c = soup.positions.row(t(2));
  soup.positions.row(tip) = a + (b - a).cross(c - a) / (b - a).norm();
  append(soup, {t(0), t(1), tip});
  const RepairedSurface result = repair(soup, {}, {});
  expect_the_shape(result, 1e-12);
  EXPECT_EQ(result.repairs.sheets_dropped, 1);
  EXPECT_EQ(result.repairs.wrap_gap, 0);
  EXPECT_EQ(result.vertex_of_input[tip], -1);
  EXPECT_EQ(result.surface.positions.rows(), shape().surface.positions.rows());
}

TEST_P(AnyShape, IsCountedOnceWhenItIsThereTwice) {
  const PolygonSoup once = soup_of(shape().surface);
  const PolygonSoup twice = together(once, once, Position::Zero());
  const RepairedSurface result = repair(twice, {}, {});
  expect_the_shape(result, 1e-12);
  EXPECT_EQ(result.repairs.copies_dropped, shape().components);
}

TEST_P(AnyShape, IsCountedOnceWhenItsCopyIsRounded) {
  const PolygonSoup once = soup_of(shape().surface);
  PolygonSoup rounded = once;
  const double size = bounding_box_diagonal(once.positions);
  for (double& coordinate : rounded.positions.reshaped()) {
    coordinate += 2e-8 * size * std::sin(1e7 * coordinate / size);
  }
  const RepairedSurface result = repair(together(once, rounded, Position::Zero()), {}, {});
  expect_the_shape(result, 1e-12);
  EXPECT_EQ(result.repairs.copies_dropped, shape().components);
  RepairOptions exactly;
  exactly.join_distance = 0;
  EXPECT_EQ(repair(together(once, rounded, Position::Zero()), exactly, {}).repairs.copies_dropped,
            0);
}

TEST_P(AnyShape, IsFoundAmongSpecks) {
  PolygonSoup soup = soup_of(shape().surface);
  const double size = 1e-3 * bounding_box_diagonal(soup.positions);
  PolygonSoup speck = soup_of(shapes::ellipsoid({size, size, size}, 0).surface);
  const double side = 3 * size;
  const Position start = soup.positions.colwise().maxCoeff();
  for (int i = 0; i < 50; ++i) {
    soup = together(soup, speck, start + Position::Constant(side * (i + 1)));
  }
  RepairOptions options;
  const RepairedSurface result = repair(soup, options, {});
  expect_the_shape(result, 1e-12);
  EXPECT_EQ(result.repairs.specks_dropped, 50);
  options.least_area = 0;
  EXPECT_EQ(topology(repair(soup, options, {}).surface).components(), shape().components + 50);
  options.components = 1;
  const RepairedSurface one = repair(soup, options, {});
  EXPECT_EQ(topology(one.surface).components(), 1);
  EXPECT_EQ(one.repairs.not_chosen, shape().components + 49);
}

INSTANTIATE_TEST_SUITE_P(Shapes, AnyShape,
                         testing::Values(shapes::torus(3, 1, 16), shapes::ellipsoid({1, 2, 3}, 3),
                                         shapes::linked_rings(3, 0.5, 14),
                                         shapes::box({1, 2, 3}, 8),
                                         shapes::algebraic_double_torus(0.1)),
                         [](const auto& entry) { return "shape" + std::to_string(entry.index); });

// ---- Damage of a kind ---------------------------------------------------------------------------

TEST(Repairing, ATubeOpenAtBothEnds) {
  const RepairedSurface result = repair(open_tube(), {}, {});
  expect_closed_outward_manifold(result.surface);
  EXPECT_EQ(genus_of(result.surface), 0);
  EXPECT_EQ(result.repairs.holes_closed, 2);
  ASSERT_EQ(result.rims.size(), 2U);
  for (const auto& rim : result.rims) {
    EXPECT_EQ(rim.size(), 24U);
    for (const std::int32_t v : rim) {
      EXPECT_NEAR(std::abs(result.surface.positions(v, 0)), 2.5, 0.15);
    }
  }
}

/// Rims lead to the faces that close their holes.
TEST(Repairing, WithoutLidsTheSurfaceIsAsItWasGiven) {
  const auto sorted_faces = [](const Surface& surface) {
    std::multiset<std::array<long, 3>> middles;
    for (const auto& t : surface.triangles.rowwise()) {
      const Position middle = 1e9 * surface.positions(t.transpose(), Eigen::all).colwise().mean();
      middles.insert({std::lround(middle.x()), std::lround(middle.y()), std::lround(middle.z())});
    }
    return middles;
  };
  for (const bool inward : {false, true}) {
    PolygonSoup soup = open_tube();
    for (std::size_t f = 0; inward && f + 1 < soup.offsets.size(); ++f) {
      std::swap(soup.corners[static_cast<std::size_t>(soup.offsets[f])],
                soup.corners[static_cast<std::size_t>(soup.offsets[f]) + 1]);
    }
    const RepairedSurface result = repair(soup, {}, {});
    const auto lids = faces_in_rims(result.surface, result.rims);
    EXPECT_EQ(std::count(lids.begin(), lids.end(), 1), result.repairs.faces_added);
    const Surface open = without_lids(result.surface, result.rims);
    EXPECT_EQ(sorted_faces(open).size(), soup.offsets.size() - 1);
    EXPECT_EQ(sorted_faces(open), sorted_faces({soup.positions, triangulate(soup)}));
    EXPECT_EQ(without_lids(result.surface, {}).triangles.rows(), 0);
  }
}

/// Two open boxes, one on the other: their rims coincide, but not the vertices within their edges.
TEST(Repairing, JoinsRimsOfDifferentVertices) {
  const auto half = [](int cells, double side) {
    PolygonSoup soup = soup_of(shapes::box({2, 2, 2}, cells).surface);
    soup.positions.col(2).array() += side;
    return with_polygons(soup,
                         [&](std::size_t p) { return std::abs(middle_of(soup, p).z()) > 1e-9; });
  };
  for (const int cells : {1, 3, 4, 7}) {
    const RepairedSurface result = repair(together(half(2, 1), half(cells, -1), {0, 0, 0}), {}, {});
    SCOPED_TRACE(cells);
    expect_closed_outward_manifold(result.surface);
    EXPECT_EQ(topology(result.surface).components(), 1);
    EXPECT_NEAR(volume(result.surface), 16, 1e-9);
    EXPECT_EQ(result.repairs.holes_closed, 0);
    EXPECT_GT(result.repairs.edges_split, 0);
  }
}

/// A speck far away must not make the distance of joining as long as a rim's edges.
TEST(Repairing, ACupBesideAFarSpeck) {
  const PolygonSoup whole = soup_of(shapes::box({2, 2, 2}, 8).surface);
  const PolygonSoup cup =
      with_polygons(whole, [&](std::size_t p) { return middle_of(whole, p).z() < 1 - 1e-9; });
  PolygonSoup speck = soup_of(shapes::box({1e-3, 1e-3, 1e-3}, 1).surface);
  const RepairedSurface alone = repair(cup, {}, {});
  const RepairedSurface beside = repair(together(cup, speck, {1e6, 0, 0}), {}, {});
  EXPECT_EQ(beside.repairs.vertices_joined, 0);
  EXPECT_EQ(beside.repairs.longest_hole, alone.repairs.longest_hole);
  EXPECT_NEAR(volume(beside.surface), 8, 1e-9);
}

/// Where floors stay, as in rigs, they make no specks of a body's fingers.
TEST(Repairing, AFloorMakesNoSpecksOfWhatABodyIsMadeOf) {
  const PolygonSoup finger = soup_of(shapes::box({0.03, 0.03, 0.03}, 1).surface);
  PolygonSoup scene = soup_of(shapes::box({2, 2, 2}, 2).surface);
  scene = together(scene, finger, {0, 0, 0.99});
  RepairOptions options;
  options.least_sheet = 0.1;
  EXPECT_EQ(repair(scene, options, {}).repairs.specks_dropped, 0);
  scene = together(scene, soup_of(shapes::box({40, 40, 0.1}, 2).surface), {0, 0, -2});
  EXPECT_EQ(repair(scene, options, {}).repairs.specks_dropped, 0);
  EXPECT_EQ(topology(repair(scene, options, {}).surface).components(), 3);
  EXPECT_EQ(repair(together(scene, finger, {0, 0, 5}), options, {}).repairs.specks_dropped, 1);
}

/// The lower half of a ball, its rim with so many teeth of random height.
PolygonSoup jagged_bowl(int teeth, double height) {
  constexpr int rows = 4;
  shapes::Random random(1);
  PolygonSoup soup;
  soup.positions.resize(Eigen::Index{rows} * teeth + 1, 3);
  soup.positions.row(0) << 0, 0, -1;
  soup.offsets = {0};
  const auto vertex = [teeth](int row, int i) { return 1 + (row - 1) * teeth + i % teeth; };
  for (int row = 1; row <= rows; ++row) {
    for (int i = 0; i < teeth; ++i) {
      const double turn = 2 * 3.14159265358979 * i / teeth;
      const double rise = row == rows ? random.uniform(-height, height) : 0;
      const double angle = 3.14159265358979 / 2 * (row / double(rows) + rise);
      soup.positions.row(vertex(row, i)) << std::sin(angle) * std::cos(turn),
          std::sin(angle) * std::sin(turn), -std::cos(angle);
      if (row == 1) {
        append(soup, {0, vertex(1, i + 1), vertex(1, i)});
      } else {
        append(soup, {vertex(row - 1, i), vertex(row - 1, i + 1), vertex(row, i + 1)});
        append(soup, {vertex(row - 1, i), vertex(row, i + 1), vertex(row, i)});
      }
    }
  }
  return soup;
}

TEST(Repairing, AHoleOfAnyLengthTakesFacesInProportion) {
  constexpr double half_ball = 2 * 3.14159265358979 / 3;
  struct Rim {
    int edges;
    double height;  // of its teeth
  };
  // Of a ragged rim that is not narrowed, CGAL's triangles cut off a tenth of the volume.
  for (const Rim& rim : {Rim{500, 0}, Rim{501, 0}, Rim{501, 0.03}, Rim{20000, 0.03}}) {
    SCOPED_TRACE(rim.edges);
    const RepairedSurface result = repair(jagged_bowl(rim.edges, rim.height), {}, {});
    expect_closed_outward_manifold(result.surface);
    EXPECT_EQ(genus_of(result.surface), 0);
    EXPECT_NEAR(volume(result.surface), half_ball, 0.06 * half_ball);
    EXPECT_EQ(result.repairs.holes_closed, 1);
    EXPECT_EQ(result.repairs.longest_hole, rim.edges);
    EXPECT_LT(result.repairs.faces_added, 3 * rim.edges + 100000);
    ASSERT_EQ(result.rims.size(), 1U);
    EXPECT_EQ(result.rims[0].size(), static_cast<std::size_t>(rim.edges));
    const bool narrowed = rim.edges > most_edges_without_rings;
    EXPECT_EQ(result.repairs.holes_narrowed, narrowed ? 1 : 0);
    ASSERT_EQ(result.repairs.lines.size(), narrowed ? 2U : 1U);
    if (narrowed) expect_said(result.repairs.lines[1], {"narrowed by rings"});
  }
}

TEST(Repairing, CountsTheVerticesThatNoFaceUses) {
  PolygonSoup soup = soup_of(shapes::torus(3, 1, 16).surface);
  soup.positions.conservativeResize(soup.positions.rows() + 5, 3);
  soup.positions.bottomRows(5).setConstant(7);
  EXPECT_EQ(repair(soup, {}, {}).changes.isolated_vertices_dropped, 5);
  const PolygonSoup open = with_polygons(soup, [](std::size_t p) { return p > 0; });
  EXPECT_EQ(repair(open, {}, {}).changes.isolated_vertices_dropped, 5);
}

TEST(Repairing, BoxesThatShareAnEdgeComeApart) {
  PolygonSoup soup = cube();
  const PolygonSoup other = cube();
  for (std::size_t p = 0; p + 1 < other.offsets.size(); ++p) {
    std::vector<std::int32_t> polygon;
    for (auto i = other.offsets[p]; i < other.offsets[p + 1]; ++i) {
      polygon.push_back(other.corners[static_cast<std::size_t>(i)]);
    }
    // The second cube stands at (1, 1, 0): its edge 0-4 is the first one's edge 2-6.
    for (std::int32_t& v : polygon) v = v == 0 ? 2 : v == 4 ? 6 : v + 8;
    append(soup, polygon);
  }
  soup.positions.conservativeResize(16, 3);
  soup.positions.bottomRows(8) = other.positions.rowwise() + Position(1, 1, 0);
  const RepairedSurface result = repair(soup, {}, {});
  expect_closed_outward_manifold(result.surface);
  EXPECT_EQ(topology(result.surface).components(), 2);
  EXPECT_EQ(result.repairs.holes_closed, 0);
  EXPECT_NEAR(volume(result.surface), 2, 1e-12);
}

// A car's body, masks and domes were refused.
TEST(Repairing, HalfOpenBodiesThatEncloseMuchAreClosed) {
  const PolygonSoup ball = soup_of(shapes::ellipsoid({1, 1, 1}, 4).surface);
  for (const double least : {0.0, 0.4, 0.6}) {  // domes of 90 down to 53 degrees
    SCOPED_TRACE(least);
    const RepairedSurface dome =
        repair(with_polygons(ball, [&](std::size_t p) { return middle_of(ball, p).z() > least; }));
    expect_closed_outward_manifold(dome.surface);
    EXPECT_EQ(dome.repairs.holes_closed, 1);
    EXPECT_EQ(dome.repairs.faces_wrapped, 0);
  }
  // A box without its floor, and windows that leave a share of three of its walls.
  const PolygonSoup box = soup_of(shapes::box({2, 1, 0.8}, 24).surface);
  for (const double window : {0.3, 0.4}) {
    SCOPED_TRACE(window);
    const RepairedSurface car = repair(with_polygons(box, [&](std::size_t p) {
      const Position middle = middle_of(box, p);
      const bool floor = middle.z() < -0.39;
      const bool side = std::abs(middle.y()) > 0.49 && std::abs(middle.x()) < 2 * window &&
                        std::abs(middle.z()) < 0.8 * window;
      return !floor && !side;
    }));
    expect_closed_outward_manifold(car.surface);
    EXPECT_EQ(car.repairs.holes_closed, 3);
    EXPECT_NEAR(volume(car.surface), 1.6, 0.1);
  }
}

TEST(Repairing, FlippedPatchesOfAnOpenSurface) {
  const shapes::Shape ball = shapes::ellipsoid({1, 2, 3}, 3);
  PolygonSoup soup = soup_of(ball.surface);
  soup = with_polygons(soup, [](std::size_t p) { return p > 3; });
  int flipped = 0;
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    if (middle_of(soup, p).x() < 0.6) continue;
    turn(soup, static_cast<std::int64_t>(p));
    ++flipped;
  }
  const RepairedSurface result = repair(soup, {}, {});
  expect_closed_outward_manifold(result.surface);
  EXPECT_GT(flipped, 0);
  EXPECT_EQ(result.changes.faces_flipped, flipped);
  EXPECT_NEAR(volume(result.surface), volume(ball.surface), 0.01 * volume(ball.surface));
}

/// A canopy of two sides in one place; single precision could not tell them apart.
TEST(Repairing, LeavesOutWhatIsThinnerThanSinglePrecision) {
  const shapes::Shape ball = shapes::ellipsoid({1, 1, 1}, 3);
  for (const double thickness : {1e-3, 1e-9}) {
    shapes::Shape canopy = shapes::torus(2, 0.6, 12);
    canopy.surface.positions.col(2) *= thickness;
    const PolygonSoup soup =
        soup_of(shapes::together("", {ball, shapes::translated(canopy, {0, 0, 3})}).surface);
    const RepairedSurface result = repair(soup, {}, {});
    EXPECT_EQ(result.repairs.sheets_dropped, thickness < 1e-8 ? 1 : 0) << thickness;
    EXPECT_EQ(topology(result.surface).components(), thickness < 1e-8 ? 1 : 2) << thickness;
  }
}

TEST(Repairing, IsTheSameForAnyNumberOfThreads) {
  const PolygonSoup soup = shrunk_apart(shapes::torus(3, 1, 24).surface, 0.05);
  const RepairedSurface one = repair(soup, {}, {}, 1);
  const RepairedSurface two = repair(soup, {}, {}, 2);
  EXPECT_EQ(one.surface.positions, two.surface.positions);
  EXPECT_EQ(one.surface.triangles, two.surface.triangles);
  EXPECT_EQ(one.vertex_of_input, two.vertex_of_input);
}

TEST(Repairing, StopsWhenAsked) {
  std::stop_source stop;
  Monitor monitor;
  monitor.stop = stop.get_token();
  monitor.progress = [&](std::string_view stage, double) {
    if (stage == "wrap") stop.request_stop();
  };
  EXPECT_THROW((void)repair(shrunk_apart(shapes::torus(3, 1, 24).surface, 0.05), {}, monitor),
               Cancelled);
}

// ---- What encloses nothing ----------------------------------------------------------------------

/// A square cut into n x n x 2 triangles, bent over a circle round the y axis by this angle.
PolygonSoup bent_square(std::int32_t n, double angle) {
  PolygonSoup soup;
  soup.positions.resize(Eigen::Index{n + 1} * (n + 1), 3);
  soup.offsets = {0};
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double x = double(i) / n - 0.5;
      const double bend = angle * x;
      soup.positions.row(Eigen::Index{i} * (n + 1) + j) << (angle > 0 ? std::sin(bend) / angle : x),
          double(j) / n, (angle > 0 ? std::cos(bend) / angle : 0);
      if (i == n || j == n) continue;
      const std::int32_t first = i * (n + 1) + j;
      append(soup, {first, first + 1, first + n + 2});
      append(soup, {first, first + n + 2, first + n + 1});
    }
  }
  return soup;
}

// Whatever plane it lies in, also after a trip through single precision, and though a wrap is asked
// for; the least bend makes it something else.
TEST(Refusing, DrawingsInAPlaneAreCalledFlat) {
  for (const Wrapping wrap : {Wrapping::needed, Wrapping::never, Wrapping::all}) {
    RepairOptions options;
    options.wrap = wrap;
    for (const double tilt : {0.0, 0.4, 1.3}) {
      SCOPED_TRACE(tilt);
      PolygonSoup drawing = bent_square(20, 0);
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(tilt, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
      drawing.positions = (drawing.positions * turn.transpose()).cast<float>().cast<double>();
      try {
        (void)repair(drawing, options, {});
        ADD_FAILURE() << "not refused";
      } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input);
        expect_said(error.what(), {"flat drawing", "encloses nothing", "thickness"});
      }
    }
  }
  EXPECT_EQ(std::string(refusal_of(bent_square(20, 0.3))).find("flat drawing"), std::string::npos);
}

TEST(Refusing, SheetsSinceTheyEncloseNothing) {
  for (const double angle : {0.0, 0.3, 0.8}) {
    SCOPED_TRACE(angle);
    expect_said(refusal_of(bent_square(20, angle)), {"encloses nothing", "thickness"});
  }
  Positions corners(3, 3);
  corners << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  expect_said(refusal_of(soup_of(corners, {{0, 1, 2}})), {"encloses nothing"});
  expect_said(refusal_of(soup_of(Positions::Ones(3, 3), {{0, 1, 2}})), {"no face"});
  expect_said(refusal_of(soup_of(corners, {{0, 1, 1}})), {"no face"});
}

}  // namespace
}  // namespace curveskel::repair_laws
