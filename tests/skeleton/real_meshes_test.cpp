// The properties that skeletons of real surfaces must have, mesh by mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/coarsen.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/extract_repaired.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/topology.hpp>
#include "surface/resample/canonical.hpp"
#include "tests/real_surfaces.hpp"
#include "tests/skeleton/shortfalls.hpp"
#include "tests/soups.hpp"

namespace curveskel::real_meshes_laws {
namespace {

constexpr std::array known{
    // It goes on into the wings, in which no curve is central: docs/quality.md has both where both
    // run, .21 and .23.
    Shortfall{"twirl-5k.off", "centredness behind CGAL's", 0.133},
    // Its legs go on to the heels; .098 and .103 where both run.
    Shortfall{"diplodocus-24k.ply", "centredness behind CGAL's", 0.006},
    // Behind by a hair.
    Shortfall{"botijo-41k.ply", "reach behind CGAL's", 0.001},
    // Bends are drawn inwards by up to half a width where the last places are solved for: on a
    // plate,
    // in the arms of the mother, and by a hair in the legs.
    Shortfall{"cad-129110-5k.obj", "centredness behind CGAL's", 0.02},
    Shortfall{"fertility-12k.ply", "reach behind CGAL's", 0.004},
    // In five places where its surface meets itself no way through the inside is found.
    Shortfall{"neuron-722817260-18k.ply", "outside", 0.0005},
};

/// A row of cgal_baseline.csv: what `evaluate` says of CGAL's mean curvature flow skeleton. Each
/// figure is the median of five runs, between which they vary by up to 5 %.
using Baseline = std::map<std::string, double>;

std::optional<Baseline> baseline_of(const std::string& mesh) {
  std::ifstream table(std::filesystem::path(CURVESKEL_SOURCE_DIR) /
                      "tests/skeleton/cgal_baseline.csv");
  std::string line;
  std::getline(table, line);
  const auto columns = fields(line);
  const std::string file = std::filesystem::path(mesh).filename().string();
  while (std::getline(table, line)) {
    const auto cells = fields(line);
    if (cells.empty() || std::filesystem::path(cells[0]).filename() != file) continue;
    Baseline row;
    for (std::size_t c = 1; c < std::min(cells.size(), columns.size()); ++c) {
      char* end = nullptr;
      const double value = std::strtod(cells[c].c_str(), &end);
      if (*end == '\0') row[columns[c]] = value;
    }
    return row;
  }
  return std::nullopt;
}

class RealMesh : public testing::TestWithParam<std::string> {
 protected:
  struct Case {
    Surface surface;
    Topology topology;
    Extraction extraction;
  };
  static const Case& made() {
    static std::map<std::string, Case> cases;
    const auto [found, is_new] = cases.try_emplace(GetParam());
    if (is_new) {
      Case& fresh = found->second;
      fresh.surface = clean(read_polygons(real_surface(GetParam()).value(), {}), {}).surface;
      fresh.topology = topology(fresh.surface);
      fresh.extraction = extract(fresh.surface, {}, {});
    }
    return found->second;
  }
  static const CurveSkeleton& skeleton() { return made().extraction.skeleton; }
  static const Certificate& certificate() { return made().extraction.certificate; }
  static void expect(std::string_view property, double found, double wanted) {
    expect_at_most(known, GetParam(), property, found, wanted);
  }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(RealMesh);

TEST_P(RealMesh, HasTheComponentsAndCyclesOfItsSurface) {
  int genus = 0;
  for (const int g : made().topology.genus) genus += g;
  const GraphTopology found = graph_topology(skeleton());
  EXPECT_EQ(found.components, made().topology.components());
  EXPECT_EQ(found.cycle_rank, genus);
}

TEST_P(RealMesh, HasEachComponentsCyclesInItsOwnPart) {
  // The sum alone would let one part lend a cycle to another.
  const Topology& surface = made().topology;
  std::vector<int> part_of_node(static_cast<std::size_t>(skeleton().nodes.rows()), -1);
  for (Eigen::Index v = 0; v < skeleton().node_of_vertex.size(); ++v) {
    int& part = part_of_node[static_cast<std::size_t>(skeleton().node_of_vertex[v])];
    EXPECT_TRUE(part == -1 || part == surface.component_of_vertex[v]) << "vertex " << v;
    part = surface.component_of_vertex[v];
  }
  // Nodes without a vertex lie on a branch: they are of the part that their edges lead to.
  for (bool changed = true; changed;) {
    changed = false;
    for (Eigen::Index e = 0; e < skeleton().edges.rows(); ++e) {
      int& a = part_of_node[static_cast<std::size_t>(skeleton().edges(e, 0))];
      int& b = part_of_node[static_cast<std::size_t>(skeleton().edges(e, 1))];
      changed = changed || (a < 0) != (b < 0);
      if (a < 0) a = b;
      if (b < 0) b = a;
    }
  }
  std::vector<int> cycles(static_cast<std::size_t>(surface.components()), 1);
  for (const int part : part_of_node) {
    ASSERT_GE(part, 0);
    --cycles[static_cast<std::size_t>(part)];
  }
  for (Eigen::Index e = 0; e < skeleton().edges.rows(); ++e)
    ++cycles[static_cast<std::size_t>(
        part_of_node[static_cast<std::size_t>(skeleton().edges(e, 0))])];
  EXPECT_EQ(cycles, surface.genus);
}

TEST_P(RealMesh, LiesInside) { expect("length outside", 1 - certificate().inside_fraction, 1e-3); }

TEST_P(RealMesh, HasNoSpur) { expect("spurs", certificate().spurs, 0); }

TEST_P(RealMesh, HasEveryVertexInOneNode) {
  const Eigen::VectorXi& node_of_vertex = skeleton().node_of_vertex;
  ASSERT_EQ(node_of_vertex.size(), made().surface.positions.rows());
  EXPECT_GE(node_of_vertex.minCoeff(), 0);
  EXPECT_LT(node_of_vertex.maxCoeff(), skeleton().nodes.rows());
}

TEST_P(RealMesh, HasTheDistancesToTheSurfaceAsRadii) {
  const SurfaceTree tree(made().surface);
  const double tolerance = 4 * canonical_step * bounding_box_diagonal(made().surface.positions);
  ASSERT_EQ(skeleton().radii.size(), skeleton().nodes.rows());
  for (Eigen::Index i = 0; i < skeleton().nodes.rows(); ++i) {
    const double distance = tree.inscribed_radius(skeleton().nodes.row(i));
    EXPECT_NEAR(skeleton().radii[i], std::max(0.0, distance), tolerance) << "node " << i;
  }
}

// A choice that hangs on the last bits of a file is a cliff: the same shape, two skeletons.
TEST_P(RealMesh, KeepsItsGraphWhenTheLastBitsChange) {
  Surface rounded = made().surface;
  const double size = bounding_box_diagonal(rounded.positions);
  for (double& coordinate : rounded.positions.reshaped()) {
    coordinate += 1e-12 * size * std::sin(1e9 * coordinate / size);
  }
  const GraphTopology was = graph_topology(skeleton());
  const GraphTopology is = graph_topology(extract(rounded, {}, {}).skeleton);
  EXPECT_EQ(is.tips, was.tips);
  EXPECT_EQ(is.junctions, was.junctions);
}

TEST_P(RealMesh, CoversAsMuchAsCgal) {
  const auto cgal = baseline_of(GetParam());
  if (!cgal) GTEST_SKIP() << "no row in tests/cgal_baseline.csv";
  expect("coverage behind CGAL's", cgal->at("coverage") - certificate().coverage, 1e-5);
}

TEST_P(RealMesh, IsAsCentredAsCgal) {
  const auto cgal = baseline_of(GetParam());
  if (!cgal) GTEST_SKIP() << "no row in tests/cgal_baseline.csv";
  expect("centredness behind CGAL's",
         certificate().centredness_median - cgal->at("centredness_median"), 1e-5);
}

TEST_P(RealMesh, ReachesAsFarAsCgal) {
  const auto cgal = baseline_of(GetParam());
  if (!cgal) GTEST_SKIP() << "no row in tests/cgal_baseline.csv";
  expect("reach behind CGAL's", certificate().reach - cgal->at("reach"), 1e-5);
}

std::string identifier(const testing::TestParamInfo<std::string>& entry) {
  std::string name = entry.param;
  const auto is_other = [](unsigned char c) { return std::isalnum(c) == 0; };
  std::replace_if(name.begin(), name.end(), is_other, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Listed, RealMesh, testing::ValuesIn(closed_real_surfaces()), identifier);

// A short leaf is no spur as long as it can be prolonged: a thumb was lost that way.
TEST(RealMeshes, KeepEveryLimbAndFinger) {
  for (const auto& [name, tips] :
       {std::pair{"humanoid-10k.ply", 7}, std::pair{"armadillo-43k.ply", 18}}) {
    const auto file = real_surface(name);
    if (!file && !collection_folder()) continue;
    const Surface surface = clean(read_polygons(file.value(), {}), {}).surface;
    EXPECT_GE(extract(surface, {}, {}).certificate.tips, tips) << name;
  }
}

// Protrusions are judged by the surface, not by where the surgery happened to cut it: with the same
// foot cut elsewhere the jug lost it at each of these.
TEST(RealMeshes, KeepTheirTipsWithFewerVertices) {
  for (const auto& [name, tips] : {std::pair{"spot-3k.obj", 9}, std::pair{"botijo-41k.ply", 5}}) {
    const auto file = real_surface(name);
    if (!file && !collection_folder()) continue;
    const Surface surface = clean(read_polygons(file.value(), {}), {}).surface;
    for (const int share : {1, 2, 4}) {
      CoarsenOptions options;
      options.target_vertices = static_cast<int>(surface.positions.rows()) / share;
      EXPECT_EQ(extract(coarsen(surface, options, {}).surface, {}, {}).certificate.tips, tips)
          << name << ", 1 / " << share << " of the vertices";
    }
  }
}

// Between the balls of vertices far apart a curve had no way: a horse's ran outside of its belly.
TEST(RealMeshes, StayInsideHoweverFewTheirVertices) {
  for (const char* name : {"quaternius-horse-1k.ply", "quaternius-trex-1k.ply"}) {
    const Surface surface =
        clean(read_polygons(real_surface("rigs/" + std::string(name)).value(), {}), {}).surface;
    for (const int share : {2, 3, 4, 5}) {
      CoarsenOptions options;
      options.target_vertices = static_cast<int>(surface.positions.rows()) / share;
      const Extraction made = extract(coarsen(surface, options, {}).surface, {}, {});
      EXPECT_TRUE(made.certificate.inside_enough)
          << name << ", 1 / " << share << " of the vertices: " << made.certificate.inside_fraction;
    }
  }
}

// This neuron's surface meets itself: some steps from one ball to the next lead outside, and where
// the cheapest chain took one of them, 0.2 % of the curve was.
TEST(RealMeshes, StayInsideWhereTheyMeetThemselves) {
  const auto file = real_surface("neuron-722817260-18k.ply");
  ASSERT_TRUE(file);
  const Extraction found = extract(repair(read_polygons(*file, {}), {}, {}).surface, {}, {});
  EXPECT_TRUE(found.certificate.inside_enough);
  expect_at_most(known, "neuron-722817260-18k.ply", "outside",
                 1 - found.certificate.inside_fraction, 1e-5);
  EXPECT_TRUE(found.certificate.topology_correct());
  EXPECT_FALSE(is_kept(found.history, try_faired));
}

// With fewer working vertices the same neuron's curve left it. It was faired, then wrapped, and the
// wrap, which took 20 s, had a tenth of its tips.
TEST(RealMeshes, ThatLeaveTheirCoarseSurfaceAreMadeAgainFromAllVertices) {
  const auto file = real_surface("neuron-722817260-18k.ply");
  ASSERT_TRUE(file);
  ExtractOptions options;
  options.resolution = 6500;
  const RepairedSurface repaired = repair(read_polygons(*file, {}), {}, {});
  const RepairedExtraction found = extract_repaired(repaired, {}, options, {});
  EXPECT_FALSE(found.repaired_again);
  EXPECT_TRUE(found.extraction.certificate.correct());
  EXPECT_TRUE(is_kept(found.extraction.history, try_all_vertices));
  EXPECT_GT(found.extraction.certificate.tips, 100);
}

// The tip in a blunt muzzle was in one of its corners, 0.1 D off, and the way into a head went
// through a cheek, beside the hollow of the mouth, 0.04 D off.
TEST(RealMeshes, ThatAreTheirOwnMirrorImagesHaveSkeletonsThatAre) {
  for (const auto& [name, axis] :
       {std::pair{"spot-3k.obj", 0}, std::pair{"rigs/quaternius-horse-1k.ply", 0},
        std::pair{"rigs/cesium-man-2k.ply", 1},
        std::pair{"rigs/makehuman-body-13k-quads.obj", 0}}) {
    const auto file = real_surface(name);
    if (!file && !collection_folder()) continue;
    const Surface surface = clean(read_polygons(file.value(), {}), {}).surface;
    const CurveSkeleton curve = extract(surface, {}, {}).skeleton;
    CurveSkeleton mirrored = curve;
    auto across = mirrored.nodes.col(axis);
    across = across.maxCoeff() + across.minCoeff() - across.array();
    const double diagonal = bounding_box_diagonal(surface.positions);
    EXPECT_LT(hausdorff_distance(curve, mirrored, diagonal / 400), 1e-3 * diagonal) << name;
  }
}

// A horse had one ear, and a scorpion's hind legs met beside the trunk on one side alone.
TEST(RealMeshes, ThatAreMirrorImagesHaveAsManyBranchesOnBothSides) {
  for (const char* name : {"characters/fox-horse.glb", "scorpion-6k.obj"}) {
    const auto file = real_surface(name);
    if (!file && !collection_folder()) continue;
    const Surface surface = repair(read_polygons(file.value(), {}), {}, {}).surface;
    const CurveSkeleton curve = extract(surface, {}, {}).skeleton;
    const double middle =
        0.5 * (surface.positions.col(0).maxCoeff() + surface.positions.col(0).minCoeff());
    const double aside = 0.01 * bounding_box_diagonal(surface.positions);
    std::vector<int> degrees(static_cast<std::size_t>(curve.nodes.rows()), 0);
    for (const auto& edge : curve.edges.rowwise()) {
      for (const int node : edge) ++degrees[static_cast<std::size_t>(node)];
    }
    std::map<int, int> left;  // by degree
    std::map<int, int> right;
    for (std::size_t node = 0; node < degrees.size(); ++node) {
      const double x = curve.nodes(static_cast<Eigen::Index>(node), 0) - middle;
      if (degrees[node] == 2 || std::abs(x) < aside) continue;
      ++(x > 0 ? left : right)[degrees[node]];
    }
    EXPECT_GT(left[1], 2) << name;
    EXPECT_EQ(left, right) << name;
  }
}

// No branch led to the waist, so one leg turned back to it and left its own rim alone.
TEST(RealMeshes, CutOffAtWaistAndThighsReachAllThree) {
  PolygonSoup figure = read_polygons(real_surface("humanoid-10k.ply").value(), {});
  const auto heights = figure.positions.col(1);
  const double least = heights.minCoeff();
  const double height = heights.maxCoeff() - least;
  const auto aside = figure.positions.col(2);
  const double half_width = (aside.maxCoeff() - aside.minCoeff()) / 2;
  const double middle = (aside.maxCoeff() + aside.minCoeff()) / 2;
  for (const double thighs : {0.15, 0.25, 0.32}) {
    SCOPED_TRACE(thighs);
    PolygonSoup shorts;
    shorts.positions = figure.positions;
    shorts.offsets = {0};
    for (std::size_t f = 0; f + 1 < figure.offsets.size(); ++f) {
      const std::vector<std::int32_t> corners(figure.corners.begin() + figure.offsets[f],
                                              figure.corners.begin() + figure.offsets[f + 1]);
      const double place = (figure.positions(corners, 1).mean() - least) / height;
      const double off = std::abs(figure.positions(corners, 2).mean() - middle) / half_width;
      if (place > thighs && place < 0.55 && off < 0.5) append(shorts, corners);
    }
    const RepairedSurface repaired = repair(shorts, {}, {});
    ASSERT_EQ(repaired.rims.size(), 3U);
    ExtractOptions options;
    options.rims = repaired.rims;
    const Extraction found = extract(repaired.surface, options, {});
    EXPECT_EQ(found.certificate.tips, 3);
    EXPECT_EQ(found.certificate.spurs, 0);
    for (const auto& rim : repaired.rims) {
      const Eigen::RowVector3d centre =
          repaired.surface.positions(rim, Eigen::all).colwise().mean();
      const auto away = (found.skeleton.nodes.rowwise() - centre).rowwise().norm();
      EXPECT_LT(away.minCoeff(), 0.02 * height);
    }
  }
}

// The way to a rim left the body between the places that were asked about.
TEST(RealMeshes, CutThroughInTheMiddleStayInsideOnTheWayToTheirRims) {
  PolygonSoup figure = read_polygons(real_surface("humanoid-10k.ply").value(), {});
  Eigen::Index axis = 0;
  const Eigen::RowVector3d low = figure.positions.colwise().minCoeff();
  const Eigen::RowVector3d high = figure.positions.colwise().maxCoeff();
  (high - low).maxCoeff(&axis);
  const double middle = (low[axis] + high[axis]) / 2;
  PolygonSoup halves;
  halves.positions = figure.positions;
  halves.offsets = {0};
  for (std::size_t f = 0; f + 1 < figure.offsets.size(); ++f) {
    const std::vector<std::int32_t> corners(figure.corners.begin() + figure.offsets[f],
                                            figure.corners.begin() + figure.offsets[f + 1]);
    const Eigen::VectorXd places = figure.positions(corners, axis);
    if (places.minCoeff() > middle || places.maxCoeff() < middle) append(halves, corners);
  }
  const RepairedSurface repaired = repair(halves, {}, {});
  ASSERT_EQ(repaired.rims.size(), 6U);
  ExtractOptions options;
  options.rims = repaired.rims;
  const Certificate found = extract(repaired.surface, options, {}).certificate;
  EXPECT_TRUE(found.topology_correct());
  EXPECT_EQ(found.inside_fraction, 1);
  EXPECT_EQ(found.spurs, 0);
}

TEST(RealMeshes, AreThere) {
  const auto collection = collection_folder();
  std::cout << "[ SURFACES ] meshes/free"
            << (collection ? " and " + collection->string() : std::string(" alone")) << '\n';
  EXPECT_GE(closed_real_surfaces().size(), collection ? 30U : 5U);
}

}  // namespace
}  // namespace curveskel::real_meshes_laws
