// Laws of cleaning: what must come out, what touching parts become, what is refused.
#include <curveskel/clean.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/topology.hpp>
#include "meshes/shapes.hpp"
#include "tests/soups.hpp"

namespace curveskel::clean_laws {
namespace {

// ---- What must come out -------------------------------------------------------------------------

struct Given {
  std::string name;
  shapes::Shape shape;

  friend void PrintTo(const Given& given, std::ostream* out) { *out << given.name; }
};

std::vector<Given> shapes_given() {
  const std::vector<shapes::Shape> made{shapes::torus(3, 1, 12), shapes::ellipsoid({1, 2, 3}, 2),
                                        shapes::linked_rings(3, 0.5, 10), shapes::box({1, 2, 3}, 4),
                                        shapes::algebraic_double_torus(0.15)};
  const std::vector<std::string> names{"torus", "ellipsoid", "linked_rings", "box", "double_torus"};
  std::vector<Given> result;
  for (std::size_t i = 0; i < made.size(); ++i) {
    result.push_back({names[i], made[i]});
    result.push_back({names[i] + "_tiny", shapes::scaled(made[i], 1e-30)});
    result.push_back({names[i] + "_far", shapes::translated(made[i], {1e7, -1e7, 1e7})});
  }
  return result;
}

class EveryShape : public testing::TestWithParam<Given> {
 protected:
  [[nodiscard]] const Surface& given() const { return GetParam().shape.surface; }

  /// The genus, components, volume and number of vertices are those of the shape.
  void expect_the_shape(const CleanSurface& result) const {
    expect_closed_outward_manifold(result.surface);
    const Topology counts = topology(result.surface);
    EXPECT_EQ(counts.components(), GetParam().shape.components);
    int genus = 0;
    for (const int g : counts.genus) genus += g;
    EXPECT_EQ(genus, GetParam().shape.genus);
    EXPECT_EQ(result.surface.positions.rows(), given().positions.rows());
    EXPECT_NEAR(volume(result.surface), volume(given()), 1e-9 * volume(given()));
  }
  /// Every vertex of the file is where its vertex of the surface is.
  static void expect_mapped(const PolygonSoup& soup, const CleanSurface& result) {
    ASSERT_EQ(result.vertex_of_input.size(), soup.positions.rows());
    for (Eigen::Index v = 0; v < soup.positions.rows(); ++v) {
      ASSERT_GE(result.vertex_of_input(v), 0);
      ASSERT_EQ(result.surface.positions.row(result.vertex_of_input(v)), soup.positions.row(v));
    }
  }
};

TEST_P(EveryShape, IsLeftAloneWhenThereIsNothingToDo) {
  const CleanSurface result = clean(soup_of(given()), {});
  EXPECT_EQ(result.surface.positions, given().positions);
  EXPECT_EQ(result.surface.triangles, given().triangles);
  EXPECT_TRUE(result.changes.lines.empty());
  expect_closed_outward_manifold(result.surface);
}

TEST_P(EveryShape, IsMadeWholeFromTornTriangles) {
  const PolygonSoup soup = torn(soup_of(given()));
  const CleanSurface result = clean(soup, {});
  expect_the_shape(result);
  expect_mapped(soup, result);
  EXPECT_EQ(result.changes.vertices_merged, soup.positions.rows() - given().positions.rows());
}

TEST_P(EveryShape, IsMadeOutwardFromFacesOfAnyOrientation) {
  PolygonSoup soup = soup_of(given());
  for (std::int64_t f = 0; f < given().triangles.rows(); ++f) turn(soup, f);
  const CleanSurface inward = clean(soup, {});
  expect_the_shape(inward);
  EXPECT_EQ(inward.changes.components_turned, GetParam().shape.components);
  EXPECT_EQ(inward.changes.faces_flipped, 0);

  std::mt19937 random(7);
  for (std::int64_t f = 0; f < given().triangles.rows(); ++f) {
    if (random() % 3 == 0) turn(soup, f);
  }
  expect_the_shape(clean(soup, {}));
}

TEST_P(EveryShape, IsFoundAmongRepeatedFacesAndStrayVertices) {
  PolygonSoup soup = soup_of(given());
  const auto faces = given().triangles.rows();
  for (std::int64_t f = 0; f < faces; ++f) {
    const auto t = given().triangles.row(f);
    if (f % 2 == 0) append(soup, {t(1), t(2), t(0)});
    if (f % 3 == 0) append(soup, {t(0), t(2), t(1)});
    if (f % 5 == 0) append(soup, {t(0), t(2), t(2)});
  }
  soup.positions.conservativeResize(soup.positions.rows() + 2, 3);
  soup.positions.bottomRows(2).setConstant(9);
  const CleanSurface result = clean(soup, {});
  expect_the_shape(result);
  EXPECT_EQ(result.surface.triangles, given().triangles);
  EXPECT_EQ(result.changes.duplicate_faces_dropped, (faces + 1) / 2 + (faces + 2) / 3);
  EXPECT_EQ(result.changes.degenerate_faces_dropped, (faces + 4) / 5);
  EXPECT_EQ(result.changes.isolated_vertices_dropped, 2);
  EXPECT_EQ(result.vertex_of_input.tail(2), Eigen::Vector2i(-1, -1));
  EXPECT_EQ(result.changes.lines.size(), 3U);
}

TEST_P(EveryShape, TellsEachChangeThroughTheMonitor) {
  std::vector<std::string> told;
  Monitor monitor;
  monitor.note = [&](std::string_view line) { told.emplace_back(line); };
  const CleanSurface result = clean(torn(soup_of(given())), monitor);
  EXPECT_EQ(told, result.changes.lines);
  EXPECT_EQ(told.size(), 1U);
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, testing::ValuesIn(shapes_given()),
                         [](const auto& test) { return test.param.name; });

// ---- Touching parts -----------------------------------------------------------------------------

/// Of a cube's faces, all or some, copies in either order that begin at any corner.
TEST(Cleaning, KnowsPolygonsThatAreThereTwice) {
  const PolygonSoup given = cube();
  const CleanSurface once = clean(given, {});
  for (int start = 0; start < 4; ++start) {
    for (const bool reversed : {false, true}) {
      for (const std::size_t copies : {3U, 6U}) {
        PolygonSoup soup = given;
        for (std::size_t p = 0; p < copies; ++p) {
          std::vector<std::int32_t> face(given.corners.begin() + given.offsets[p],
                                         given.corners.begin() + given.offsets[p + 1]);
          std::rotate(face.begin(), face.begin() + start, face.end());
          if (reversed) std::reverse(face.begin(), face.end());
          append(soup, face);
        }
        const CleanSurface cleaned = clean(soup, {});
        EXPECT_EQ(cleaned.surface.triangles, once.surface.triangles);
        EXPECT_EQ(cleaned.changes.duplicate_faces_dropped, 2 * copies);
      }
    }
  }
}

TEST(Cleaning, LeavesCoincidentVerticesOfAWholeSurfaceApart) {
  // The second cube's corner 0 is where the first one's corner 6 is.
  const PolygonSoup soup = together(cube(), cube(), {1, 1, 1});
  const CleanSurface result = clean(soup, {});
  EXPECT_EQ(result.changes.vertices_merged, 0);
  EXPECT_EQ(result.surface.positions.rows(), 16);
  EXPECT_EQ(topology(result.surface).components(), 2);
}

TEST(Cleaning, ClosesASeamWithoutMergingCoincidentVerticesElsewhere) {
  PolygonSoup torn_cube = torn(cube());
  const CleanSurface result = clean(together(torn_cube, cube(), {1, 1, 1}), {});
  EXPECT_EQ(result.changes.vertices_merged, 24 - 8);
  EXPECT_EQ(topology(result.surface).components(), 2);
  expect_closed_outward_manifold(result.surface);
}

TEST(Cleaning, SplitsABowTieVertexIntoOnePerUmbrella) {
  PolygonSoup soup = together(together(cube(), cube(), {1, 1, 1}), cube(), {1, 1, -1});
  std::replace(soup.corners.begin(), soup.corners.end(), 8, 6);   // (1 1 1) of both
  std::replace(soup.corners.begin(), soup.corners.end(), 20, 2);  // (1 1 0) of both
  const CleanSurface result = clean(soup, {});
  EXPECT_EQ(result.changes.vertices_split_off, 2);
  EXPECT_EQ(result.surface.positions.rows(), 24);
  EXPECT_EQ(result.surface.positions.row(result.vertex_of_input(6)), soup.positions.row(6));
  EXPECT_EQ(result.vertex_of_input(8), -1);
  EXPECT_EQ(topology(result.surface).components(), 3);
  expect_closed_outward_manifold(result.surface);
  EXPECT_NEAR(volume(result.surface), 3, 1e-12);
}

TEST(Cleaning, KeepsFacesWithoutAreaThatHoldTheSurfaceTogether) {
  shapes::Shape shape = shapes::torus(3, 1, 12);
  const auto t = shape.surface.triangles.row(5);
  shape.surface.positions.row(t(0)) = shape.surface.positions.row(t(1));
  const CleanSurface result = clean(soup_of(shape.surface), {});
  EXPECT_EQ(result.surface.triangles.rows(), shape.surface.triangles.rows());
  EXPECT_EQ(result.changes.degenerate_faces_dropped, 0);
  EXPECT_EQ(result.changes.vertices_merged, 0);
}

TEST(Cleaning, DropsFacesThatMergingMakesDegenerate) {
  shapes::Shape shape = shapes::torus(3, 1, 12);
  const auto t = shape.surface.triangles.row(5);
  shape.surface.positions.row(t(0)) = shape.surface.positions.row(t(1));
  const CleanSurface result = clean(torn(soup_of(shape.surface)), {});
  EXPECT_EQ(result.surface.triangles.rows(), shape.surface.triangles.rows() - 2);
  EXPECT_EQ(result.changes.degenerate_faces_dropped, 2);
  EXPECT_EQ(topology(result.surface).genus, std::vector<int>{1});
}

TEST(Cleaning, TurnsAnInnerWallOutwardLikeAnyComponent) {
  PolygonSoup inner = cube();
  inner.positions *= 0.5;
  for (std::int64_t f = 0; f < 6; ++f) turn(inner, f);
  const CleanSurface result = clean(together(cube(), inner, {0.25, 0.25, 0.25}), {});
  EXPECT_EQ(result.changes.components_turned, 1);
  expect_closed_outward_manifold(result.surface);
}

TEST(Cleaning, TakesMinusZeroForZero) {
  PolygonSoup soup = torn(cube());
  for (Eigen::Index v = 0; v < soup.positions.rows(); v += 2) {
    for (int k = 0; k < 3; ++k) {
      if (soup.positions(v, k) == 0) soup.positions(v, k) = -0.0;
    }
  }
  EXPECT_EQ(clean(soup, {}).surface.positions.rows(), 8);
}

// ---- What is refused, and how -------------------------------------------------------------------

// Memory elsewhere was read.
TEST(Cleaning, NumbersThatAreNoVerticesAreRefused) {
  const PolygonSoup whole = cube();
  std::vector<PolygonSoup> broken(5, whole);
  broken[0].corners[7] = static_cast<std::int32_t>(whole.positions.rows());
  broken[1].corners[7] = 999999999;
  broken[2].corners[7] = -1;
  broken[3].offsets.back() += 3;
  std::swap(broken[4].offsets[1], broken[4].offsets[2]);
  for (const PolygonSoup& soup : broken) {
    const auto is_refused = [](const auto& stage) {
      try {
        stage();
      } catch (const Error& error) {
        return error.fault() == Fault::input;
      }
      return false;
    };
    EXPECT_TRUE(is_refused([&] { (void)triangulate(soup); }));
    EXPECT_TRUE(is_refused([&] { (void)clean(soup); }));
    EXPECT_TRUE(is_refused([&] { (void)repair(soup); }));
  }
}

TEST(Refusing, AnOpenSurfaceNamesTheEdgeAndCountsThemAll) {
  PolygonSoup soup = cube();
  soup.offsets.pop_back();  // without its last face, 3 0 4 7
  soup.corners.resize(20);
  soup.file = "folder/open.obj";
  expect_said(refusal(soup),
              {"folder/open.obj", "vertices 0 at (0 0 0) and 3 at (0 1 0)", "with 1 face",
               "4 edges with one face, 0 with three or more", "exactly two faces"});
}

TEST(Refusing, AnEdgeOfThreeFaces) {
  PolygonSoup soup = cube();
  soup.positions.conservativeResize(9, 3);
  soup.positions.row(8) << 0.5, 0.5, 0.5;
  append(soup, {0, 1, 8});
  expect_said(refusal(soup), {"vertices 0 at (0 0 0) and 1 at (1 0 0)", "with 3 faces",
                              "2 edges with one face, 1 with three or more"});
}

TEST(Refusing, ASheet) {
  Positions positions(4, 3);
  positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  expect_said(refusal(soup_of(positions, {{0, 1, 2, 3}})), {"with 1 face"});
  // A folded sheet is closed, and encloses nothing.
  expect_said(refusal(soup_of(positions, {{0, 1, 2}, {0, 2, 3}, {1, 0, 3}, {1, 3, 2}})),
              {"without volume"});
}

TEST(Refusing, SurfacesWithoutVolume) {
  for (const double thickness : {0.0, 1e-14}) {
    shapes::Shape flat = shapes::ellipsoid({1, 2, 3}, 2);
    flat.surface.positions.col(2) *= thickness;
    expect_said(refusal(soup_of(shapes::rotated(flat, {1, 2, 3}, 1).surface)), {"without volume"});
  }
  shapes::Shape line = shapes::ellipsoid({1, 2, 3}, 2);
  line.surface.positions.rightCols(2).setZero();
  expect_said(refusal(soup_of(line.surface)), {"without volume"});
  line.surface.positions.setConstant(0.3);
  expect_said(refusal(soup_of(line.surface)), {"without volume"});
}

TEST(Refusing, ThinSurfacesIsNotDoneUnlessSinglePrecisionTellsNoSides) {
  shapes::Shape thin = shapes::ellipsoid({1, 2, 3}, 2);
  thin.surface.positions.col(2) *= 2e-7;
  EXPECT_EQ(clean(soup_of(thin.surface), {}).surface.triangles, thin.surface.triangles);
  thin.surface.positions.col(2) *= 0.25;
  expect_said(refusal(soup_of(thin.surface)), {"without volume"});
}

TEST(Refusing, ATorusGluedToItsMirrorImage) {
  // A grid closed on itself the usual way one way, and turned over the other: a Klein bottle.
  const int n = 8;
  Positions positions(n * n, 3);
  const auto vertex = [](int i, int j) {
    return i < n ? i * n + (j % n) : (2 * n - j) % n;  // past the end of i, j runs backwards
  };
  PolygonSoup soup;
  soup.offsets.push_back(0);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      positions.row(i * n + j) << std::cos(i), std::sin(2 * j), i + 0.1 * j * j;
      append(soup, {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      append(soup, {vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  soup.positions = positions;
  expect_said(refusal(soup), {"non-orientable", "the edge between vertices"});
}

TEST(Refusing, NothingButDegenerateFaces) {
  expect_said(refusal(soup_of(cube().positions, {{0, 1, 1}, {2, 3}, {4, 4, 4, 4}})),
              {"no face with three different vertices", "3 degenerate"});
}

TEST(Cleaning, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  Monitor monitor;
  monitor.stop = source.get_token();
  EXPECT_THROW((void)clean(cube(), monitor), Cancelled);
}

}  // namespace
}  // namespace curveskel::clean_laws
