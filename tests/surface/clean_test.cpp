#include "surface/clean.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "meshes/shapes.hpp"
#include "surface/measures.hpp"
#include "surface/topology.hpp"
#include "tests/soups.hpp"

namespace curveskel::clean_laws {
namespace {

std::string refusal(const PolygonSoup& soup) {
  try {
    (void)clean(soup, {});
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "";
}

// ---- Triangulation ------------------------------------------------------------------------------

/// A polygon that winds once round the origin at changing distance, in a plane of any direction.
PolygonSoup star_shaped(int corners, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(
      6 * unit(), Eigen::Vector3d(unit() - 0.5, unit() - 0.5, unit() - 0.5).normalized()));
  PolygonSoup soup;
  soup.positions.resize(corners, 3);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * EIGEN_PI * i / corners;
    const double radius = 0.2 + unit();
    const Eigen::Vector3d flat(radius * std::cos(angle), radius * std::sin(angle), 3);
    soup.positions.row(i) = (turn * flat).transpose();
    soup.corners.push_back(i);
  }
  soup.offsets = {0, corners};
  return soup;
}

/// The strip between two turns of a spiral: every ear clipper's worst friend.
PolygonSoup spiral(Eigen::Index steps) {
  PolygonSoup soup;
  soup.positions.resize(2 * steps, 3);
  for (Eigen::Index i = 0; i < steps; ++i) {
    const double angle = 0.3 * static_cast<double>(i);
    const double radius = 1 + 0.1 * angle;
    soup.positions.row(i) << radius * std::cos(angle), radius * std::sin(angle), 0;
    soup.positions.row(2 * steps - 1 - i) << (radius - 0.3) * std::cos(angle),
        (radius - 0.3) * std::sin(angle), 0;
  }
  for (std::int32_t i = 0; i < 2 * steps; ++i) soup.corners.push_back(i);
  soup.offsets = {0, 2 * steps};
  return soup;
}

Eigen::Vector3d vector_area(const PolygonSoup& soup) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < soup.corners.size(); ++i) {
    const Eigen::Vector3d a = soup.positions.row(soup.corners[i]);
    const Eigen::Vector3d b = soup.positions.row(soup.corners[(i + 1) % soup.corners.size()]);
    sum += a.cross(b) / 2;
  }
  return sum;
}

/// Triangles that all face the polygon's way and whose areas add up to its area tile it.
void expect_tiled(const PolygonSoup& soup) {
  const Eigen::Vector3d whole = vector_area(soup);
  const Triangles triangles = triangulate(soup);
  ASSERT_EQ(triangles.rows(), static_cast<Eigen::Index>(soup.corners.size()) - 2);
  double sum = 0;
  for (const auto& t : triangles.rowwise()) {
    const Eigen::Vector3d a = soup.positions.row(t(0));
    const Eigen::Vector3d b = soup.positions.row(t(1));
    const Eigen::Vector3d c = soup.positions.row(t(2));
    const Eigen::Vector3d area = (b - a).cross(c - a) / 2;
    EXPECT_GT(area.dot(whole), -1e-12 * whole.squaredNorm());
    sum += area.norm();
  }
  EXPECT_NEAR(sum, whole.norm(), 1e-9 * whole.norm());
}

TEST(Triangulation, TilesStarShapedPolygons) {
  for (int corners = 4; corners < 60; ++corners) {
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(testing::Message() << corners << " corners, seed " << seed);
      expect_tiled(star_shaped(corners, seed));
    }
  }
}

TEST(Triangulation, TilesASpiral) { expect_tiled(spiral(200)); }

TEST(Triangulation, TilesAPolygonWithACollinearCorner) {
  Positions positions(5, 3);
  positions << 0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 0, 3, 0;
  expect_tiled(soup_of(positions, {{0, 1, 2, 3, 4}}));
}

TEST(Triangulation, TilesAPolygonWithAHoleAndItsBridge) {
  Positions positions(8, 3);
  positions << 0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 1, 1, 0, 1, 3, 0, 3, 3, 0, 3, 1, 0;
  expect_tiled(soup_of(positions, {{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}}));
}

TEST(Triangulation, EndsOnDegeneratePolygons) {
  Positions point = Positions::Zero(12, 3);
  Positions line = Positions::Zero(12, 3);
  Positions bow = Positions::Zero(12, 3);
  for (int i = 0; i < 12; ++i) {
    line(i, 0) = i * 5 % 12;
    bow.row(i) << std::cos(5.0 * i), std::sin(5.0 * i), 0;  // a star that crosses itself
  }
  for (const Positions& positions : {point, line, bow}) {
    const PolygonSoup soup =
        soup_of(positions, {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, {0, 1, 2, 3}, {0, 1, 0, 1, 0}});
    EXPECT_EQ(triangulate(soup).rows(), 10 + 2 + 2);
  }
}

TEST(Triangulation, SkipsCornersThatRepeatTheOneBefore) {
  const Positions positions = cube().positions;
  const Triangles triangles =
      triangulate(soup_of(positions, {{0, 0, 1, 2, 2, 0}, {3}, {4, 5}, {}, {1, 2, 3}}));
  Triangles expected(4, 3);
  expected << 0, 1, 2, 3, 3, 3, 4, 5, 4, 1, 2, 3;
  EXPECT_EQ(triangles, expected);
}

TEST(Triangulation, KeepsASurfaceManifoldWhereTwoQuadrilateralsShareTwoEdges) {
  // A pyramid whose apex (4) two quadrilaterals share: both would like the diagonal 0-2 best.
  Positions positions(5, 3);
  positions << 0, 0, 0, 5, -1, 0, 1, 0, 0, 5, 1, 0, 0.5, 0, 3;
  positions.row(1) << 0.5, -5, 0;
  positions.row(3) << 0.5, 5, 0;
  const CleanSurface result =
      clean(soup_of(positions, {{0, 1, 2, 4}, {4, 2, 3, 0}, {0, 3, 2, 1}}), {});
  EXPECT_EQ(result.surface.positions.rows(), 5);
  EXPECT_EQ(result.surface.triangles.rows(), 6);
  EXPECT_EQ(result.changes.duplicate_faces_dropped, 0);
  expect_closed_outward_manifold(result.surface);
}

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

TEST(Refusing, ThinSurfacesIsNotDone) {
  shapes::Shape thin = shapes::ellipsoid({1, 2, 3}, 2);
  thin.surface.positions.col(2) *= 1e-7;
  EXPECT_EQ(clean(soup_of(thin.surface), {}).surface.triangles, thin.surface.triangles);
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

// ---- Real files ---------------------------------------------------------------------------------

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> result(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      result.emplace_back();
    } else if (c != '\r') {
      result.back() += c;
    }
  }
  return result;
}

struct IndexRow {
  std::string file;
  long vertices = -1;
  long faces = -1;
  std::size_t components = 0;
  bool closed_orientable_manifold = false;
  bool consistently_oriented = false;
  double signed_volume = 0;
  std::vector<int> genus;  ///< per component, ascending
};

std::vector<IndexRow> index_rows() {
  std::ifstream file(std::string(CURVESKEL_SHARED_MESHES) + "/INDEX.csv");
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = fields(line);
  std::vector<IndexRow> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> values = fields(line);
    const auto value = [&](const std::string& name) {
      const auto column = std::find(names.begin(), names.end(), name) - names.begin();
      return values.at(static_cast<std::size_t>(column));
    };
    IndexRow row;
    row.file = value("file");
    if (!value("vertices").empty()) {
      row.vertices = std::stol(value("vertices"));
      row.faces = std::stol(value("faces"));
      row.components = std::stoul(value("components"));
    }
    row.closed_orientable_manifold =
        value("closed") == "y" && value("manifold") == "y" && value("orientable") == "y";
    if (row.closed_orientable_manifold) {
      std::istringstream list(value("genus"));
      for (int g = 0; list >> g;) row.genus.push_back(g);
      std::sort(row.genus.begin(), row.genus.end());
      row.consistently_oriented = value("consistently_oriented") == "y";
      if (row.consistently_oriented) row.signed_volume = std::stod(value("signed_volume"));
    }
    rows.push_back(row);
  }
  return rows;
}

class SharedMeshesCleaned : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_ / "INDEX.csv")) GTEST_SKIP() << "no folder " << folder_;
    rows_ = index_rows();
  }
  [[nodiscard]] CleanSurface cleaned(const std::string& file) const {
    return clean(read_polygons(folder_ / file, {}), {});
  }
  std::filesystem::path folder_ = CURVESKEL_SHARED_MESHES;
  std::vector<IndexRow> rows_;
};

TEST_F(SharedMeshesCleaned, AreReadWithTheVerticesAndFacesOfTheIndex) {
  int checked = 0;
  for (const IndexRow& row : rows_) {
    // Without counts, without faces, or with numbers that are none: refused, see the read test.
    if (row.faces <= 0 || row.file.find("nan-") != std::string::npos ||
        row.file.find("inf-") != std::string::npos) {
      continue;
    }
    const PolygonSoup soup = read_polygons(folder_ / row.file, {});
    EXPECT_EQ(soup.positions.rows(), row.vertices) << row.file;
    EXPECT_EQ(soup.offsets.size() - 1, static_cast<std::size_t>(row.faces)) << row.file;
    ++checked;
  }
  EXPECT_GT(checked, 80);
}

TEST_F(SharedMeshesCleaned, ThatAreClosedKeepTheirComponentsAndGenus) {
  int checked = 0;
  for (const IndexRow& row : rows_) {
    const bool flat = row.file.find("collinear") != std::string::npos ||
                      row.file.find("coincident") != std::string::npos ||
                      row.file.find("flattened") != std::string::npos;
    if (!row.closed_orientable_manifold || flat || row.file.find("nan-") != std::string::npos ||
        row.file.find("inf-") != std::string::npos) {
      continue;
    }
    SCOPED_TRACE(row.file);
    const CleanSurface result = cleaned(row.file);
    EXPECT_EQ(result.surface.positions.rows() + result.changes.isolated_vertices_dropped,
              row.vertices);
    EXPECT_EQ(result.changes.vertices_merged, 0);
    const Topology counts = topology(result.surface);
    std::vector<int> genus = counts.genus;
    std::sort(genus.begin(), genus.end());
    EXPECT_EQ(genus.size(), row.components);
    EXPECT_EQ(genus, row.genus);
    if (row.consistently_oriented) {
      EXPECT_EQ(result.changes.faces_flipped, 0);
      if (row.components == 1) {
        EXPECT_EQ(result.changes.components_turned, row.signed_volume < 0 ? 1 : 0);
      }
      // The volume inside a bent polygon depends on its diagonals, which are not the index's.
      if (row.components == 1 && result.changes.polygons_triangulated == 0) {
        EXPECT_NEAR(volume(result.surface), std::abs(row.signed_volume),
                    1e-5 * std::abs(row.signed_volume));
      }
    }
    ++checked;
  }
  EXPECT_GT(checked, 50);
}

struct Mended {
  const char* file;
  Eigen::Index vertices;
  int components;
};

TEST_F(SharedMeshesCleaned, ThatAreSoupsOrDoubledAreMended) {
  for (const Mended& mended :
       {Mended{"format-binary-starts-with-solid.stl", 620, 1},
        Mended{"format-two-solids-ascii.stl", 1240, 2}, Mended{"soup-gears-19k.stl", 9723, 7},
        Mended{"unwelded-spot.obj", 829, 1}, Mended{"doublesided.ply", 829, 1},
        Mended{"duplicate-faces.ply", 829, 1}, Mended{"degenerate-repeated-index.off", 829, 1},
        Mended{"nonmanifold-vertex-cow-3k.obj", 2904, 1},
        Mended{"nonmanifold-hourglass.obj", 24, 2}, Mended{"uvseam-cut-camel-2k.obj", 1790, 1}}) {
    SCOPED_TRACE(mended.file);
    const CleanSurface result = cleaned(std::string("defects/") + mended.file);
    EXPECT_EQ(result.surface.positions.rows(), mended.vertices);
    EXPECT_EQ(topology(result.surface).components(), mended.components);
    EXPECT_FALSE(result.changes.lines.empty());
    expect_closed_outward_manifold(result.surface);
  }
}

TEST_F(SharedMeshesCleaned, ThatEncloseNothingAreRefused) {
  for (const char* name : {"all-vertices-coincident.off",
                           "collinear.off",
                           "concave-ngon.obj",
                           "flattened.ply",
                           "messy-office-chair.obj",
                           "nonmanifold-dragon-23k.ply",
                           "nonmanifold-fan3.obj",
                           "nonmanifold-hole.ply",
                           "nonorientable-klein.off",
                           "nonorientable-moebius-quads.obj",
                           "nonorientable-shark-15parts.ply",
                           "one-quad.obj",
                           "one-triangle.off",
                           "open-bunny-scan-36k.ply",
                           "open-elephant-106-holes.off",
                           "open-rangescan-44k.ply",
                           "polygons-suzanne-open.obj",
                           "sheet-plane.off",
                           "soup-spider-ascii.stl",
                           "tjunctions.ply",
                           "tristrips-hippo-23k.ply",
                           "two-triangles.off",
                           "unwelded-jittered.ply"}) {
    expect_said(refusal(read_polygons(folder_ / "defects" / name, {})), {name, "needed"});
  }
}

}  // namespace
}  // namespace curveskel::clean_laws
