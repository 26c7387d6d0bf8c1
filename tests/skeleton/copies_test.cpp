// Laws of copies: one of a kind is extracted, and the others have a curve as good.
#include "skeleton/pipeline/copies.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/certificate.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/topology.hpp>
#include <curveskel/tries.hpp>
#include "meshes/shapes.hpp"
#include "surface/mesh/overlaps.hpp"

namespace curveskel::copies_laws {
namespace {

constexpr double room = 100;  // in which the copies stand

/// Turned at random, somewhere, and as a file with so many decimals has it.
Surface copy_of(const Surface& kind, double scale, double decimals, std::mt19937& draw) {
  const auto random = [&] { return double(draw()) / double(std::mt19937::max()); };
  const Eigen::Vector3d axis(random() - 0.5, random() - 0.5, random() - 0.5);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(6 * random(), axis.normalized()).matrix();
  const Eigen::RowVector3d place(room * random(), room * random(), room * random());
  Surface copy = kind;
  copy.positions = (scale * kind.positions * turn.transpose()).rowwise() + place;
  const double unit = std::pow(10, -decimals);
  copy.positions = (copy.positions / unit).array().round().matrix() * unit;
  return copy;
}

Surface mirrored(Surface surface) {
  surface.positions.col(0) *= -1;
  surface.triangles.col(1).swap(surface.triangles.col(2));
  return surface;
}

std::vector<Surface> kinds() {
  Surface longer = shapes::ellipsoid({1, 0.5, 0.25}, 1).surface;
  longer.positions.col(0) *= 1.1;
  return {shapes::ellipsoid({1, 0.5, 0.25}, 1).surface, longer, shapes::box({1, 2, 0.3}, 1).surface,
          shapes::cone(0.5, 2, 7).surface};
}

/// So many copies of each kind in turn.
Surface scene_of(const std::vector<Surface>& kinds, int copies, double decimals) {
  std::mt19937 draw(4);
  std::vector<shapes::Shape> all;
  for (int k = 0; k < copies; ++k) {
    for (const Surface& kind : kinds) {
      const double scale = 1 + 0.1 * double(k % 3 - 1);
      all.emplace_back();
      all.back().surface = copy_of(kind, scale, decimals, draw);
    }
  }
  return shapes::together("copies", all).surface;
}

Parts apart(const Surface& surface) {
  Topology counted = topology(surface);
  auto components = split_components(surface, counted);
  auto overlaps = overlaps_of(surface, counted, {});
  return {std::move(counted), std::move(components), std::move(overlaps)};
}

std::set<std::size_t> firsts_in(const Surface& surface) {
  const Parts whole = apart(surface);
  std::vector<std::size_t> asked(whole.components.size());
  std::iota(asked.begin(), asked.end(), 0);
  const auto firsts = firsts_of_kind(parts_of(whole, {}), asked);
  return {firsts.begin(), firsts.end()};
}

// The number of curves that are made is that of the kinds, however many copies there are.
TEST(Copies, EachKindIsMadeOnce) {
  for (const int copies : {1, 20, 200}) {
    for (const double decimals : {3.0, 6.0, 12.0}) {
      EXPECT_EQ(firsts_in(scene_of(kinds(), copies, decimals)), (std::set<std::size_t>{0, 1, 2, 3}))
          << copies << " copies with " << decimals << " decimals";
    }
  }
}

TEST(Copies, MirrorImagesAndOtherSizesAreOfAnotherKind) {
  Surface skew = shapes::ellipsoid({1, 0.5, 0.25}, 1).surface;
  skew.positions.col(0) += 0.3 * skew.positions.col(1).cwiseAbs2() + 0.2 * skew.positions.col(2);
  const Surface larger{2 * skew.positions, skew.triangles};
  EXPECT_EQ(firsts_in(scene_of({skew, mirrored(skew), larger}, 5, 9)),
            (std::set<std::size_t>{0, 1, 2}));
}

// Half a thousand parts and more take their curves over from the first of their kind; of fewer each
// is made by itself.
TEST(Copies, HaveCurvesAsGoodAsTheirOwn) {
  constexpr int copies = 150;
  const Extraction by_themselves = extract(scene_of(kinds(), copies / 2, 3));
  const Extraction found = extract(scene_of(kinds(), copies, 3));
  EXPECT_TRUE(found.certificate.topology_correct());
  EXPECT_EQ(found.certificate.inside_fraction, 1);
  EXPECT_EQ(found.certificate.tips, 2 * by_themselves.certificate.tips);
  EXPECT_NEAR(found.certificate.tube_share, by_themselves.certificate.tube_share, 0.02);
  EXPECT_EQ(found.skeleton.nodes.rows(), 2 * by_themselves.skeleton.nodes.rows());
  EXPECT_GT(found.skeleton.radii.minCoeff(), 0);
  for (int component = 0; component < 4 * copies; ++component) {
    EXPECT_TRUE(is_kept(found.history, try_as_asked, component)) << component;
  }
}

/// Those that the first is the first of, and that take its curve over.
std::pair<int, int> copies_and_taken_over(const Surface& scene) {
  const Parts whole = apart(scene);
  const std::vector<Part> parts = parts_of(whole, {});
  std::vector<std::size_t> asked(parts.size());
  std::iota(asked.begin(), asked.end(), 0);
  const std::vector<std::size_t> firsts = firsts_of_kind(parts, asked);
  TryLog log;
  const ComponentResult made = component_result(parts.front(), {}, {}, nullptr, log, -1);
  int copies = 0;
  int taken_over = 0;
  for (std::size_t k = 1; k < parts.size(); ++k) {
    if (firsts[k] != 0) continue;
    ++copies;
    if (result_of_copy(parts.front(), made, parts[k])) ++taken_over;
  }
  return {copies, taken_over};
}

// The curves of thin leaves lie among the vertices of each as among those of the first, so that
// none is made by itself, although the last digits of a file leave the vertices apart.
TEST(Copies, OfThinLeavesStayInside) {
  constexpr int leaves = 200;
  for (const double thickness : {0.0004, 0.0008, 0.0016}) {
    for (const double decimals : {3.7, 4.0}) {
      SCOPED_TRACE(testing::Message() << thickness << " thick, " << decimals << " decimals");
      std::mt19937 draw(9);
      const Surface leaf = shapes::ellipsoid({0.04, 0.02, thickness}, 1).surface;
      std::vector<shapes::Shape> all(leaves);
      for (shapes::Shape& one : all) one.surface = copy_of(leaf, 1, decimals, draw);
      const Surface scene = shapes::together("leaves", all).surface;
      EXPECT_EQ(copies_and_taken_over(scene), std::pair(leaves - 1, leaves - 1));
    }
  }
}

// Nothing else goes side by side where frames are shown one after the other.
TEST(Copies, AreTheSameWhereTheRunIsWatched) {
  const Surface scene = scene_of(kinds(), 150, 3);
  const Extraction found = extract(scene);
  Monitor watching;
  int frames = 0;
  watching.frame = [&](const Frame& /*frame*/) { ++frames; };
  const Extraction watched = extract(scene, {}, watching);
  EXPECT_GT(frames, 0);
  EXPECT_EQ(watched.skeleton.nodes, found.skeleton.nodes);
  EXPECT_EQ(watched.skeleton.edges, found.skeleton.edges);
  EXPECT_EQ(watched.skeleton.radii, found.skeleton.radii);
  EXPECT_EQ(watched.skeleton.node_of_vertex, found.skeleton.node_of_vertex);
  ASSERT_EQ(watched.history.size(), found.history.size());
  for (std::size_t k = 0; k < found.history.size(); ++k) {
    EXPECT_EQ(watched.history[k].component, found.history[k].component) << k;
    EXPECT_EQ(watched.history[k].part_of, found.history[k].part_of) << k;
  }
}

}  // namespace
}  // namespace curveskel::copies_laws
