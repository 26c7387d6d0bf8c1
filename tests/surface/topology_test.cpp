#include <curveskel/topology.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace curveskel::topology_laws {
namespace {

// A ring of `rings` circles of `sides` vertices, closed on itself: genus 1.
Surface torus(int rings, int sides) {
  Surface surface;
  surface.positions.resize(Eigen::Index{rings} * sides, 3);
  surface.triangles.resize(Eigen::Index{2} * rings * sides, 3);
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sides; ++j) {
      const double u = 2 * std::numbers::pi * i / rings;
      const double v = 2 * std::numbers::pi * j / sides;
      const double ring = 3 + std::cos(v);
      surface.positions.row(i * sides + j) << ring * std::cos(u), ring * std::sin(u), std::sin(v);
      const int a = i * sides + j;
      const int b = (i + 1) % rings * sides + j;
      const int c = (i + 1) % rings * sides + (j + 1) % sides;
      const int d = i * sides + (j + 1) % sides;
      surface.triangles.row(Eigen::Index{2} * a) << a, b, c;
      surface.triangles.row(Eigen::Index{2} * a + 1) << a, c, d;
    }
  }
  return surface;
}

Surface tetrahedron() {
  Surface surface;
  surface.positions.resize(4, 3);
  surface.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  surface.triangles.resize(4, 3);
  surface.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  return surface;
}

// Vertices of the parts take turns, so no component is a contiguous range.
Surface interleaved(const Surface& first, const Surface& second) {
  const auto n = static_cast<int>(first.positions.rows());
  const auto m = static_cast<int>(second.positions.rows());
  const auto place_of_first = [m](int vertex) { return vertex + std::min(vertex, m); };
  const auto place_of_second = [n](int vertex) { return vertex + std::min(vertex + 1, n); };
  Surface both;
  both.positions.resize(n + m, 3);
  both.triangles.resize(first.triangles.rows() + second.triangles.rows(), 3);
  for (int v = 0; v < n; ++v) both.positions.row(place_of_first(v)) = first.positions.row(v);
  for (int v = 0; v < m; ++v) both.positions.row(place_of_second(v)) = second.positions.row(v);
  Eigen::Index face = 0;
  for (Eigen::Index f = 0; f < first.triangles.rows(); ++f, ++face) {
    for (int k = 0; k < 3; ++k) both.triangles(face, k) = place_of_first(first.triangles(f, k));
  }
  for (Eigen::Index f = 0; f < second.triangles.rows(); ++f, ++face) {
    for (int k = 0; k < 3; ++k) both.triangles(face, k) = place_of_second(second.triangles(f, k));
  }
  return both;
}

TEST(Topology, SphereLikeHasGenusZeroAndRingGenusOne) {
  const Topology sphere = topology(tetrahedron());
  EXPECT_EQ(sphere.components(), 1);
  EXPECT_EQ(sphere.genus, std::vector<int>{0});
  const Topology ring = topology(torus(12, 7));
  EXPECT_EQ(ring.components(), 1);
  EXPECT_EQ(ring.genus, std::vector<int>{1});
}

TEST(Topology, ComponentsAreNumberedByTheirSmallestVertex) {
  const Surface both = interleaved(torus(12, 7), tetrahedron());
  const Topology found = topology(both);
  ASSERT_EQ(found.components(), 2);
  EXPECT_EQ(found.component_of_vertex(0), 0);
  EXPECT_EQ(found.component_of_vertex(1), 1);
  EXPECT_EQ(found.genus, (std::vector<int>{1, 0}));
  EXPECT_EQ(found.vertices, (std::vector<int>{84, 4}));
  EXPECT_EQ(found.faces, (std::vector<int>{168, 4}));
}

TEST(Topology, PartsPutTogetherAgainAreTheWhole) {
  const Surface both = interleaved(torus(12, 7), tetrahedron());
  const auto parts = split_components(both, topology(both));
  ASSERT_EQ(parts.size(), 2U);
  Eigen::VectorXi seen = Eigen::VectorXi::Zero(both.positions.rows());
  Eigen::Index faces = 0;
  for (const Component& part : parts) {
    ASSERT_EQ(part.vertex_in_whole.size(), static_cast<std::size_t>(part.surface.positions.rows()));
    for (std::size_t v = 0; v < part.vertex_in_whole.size(); ++v) {
      const int whole = part.vertex_in_whole[v];
      ++seen(whole);
      EXPECT_EQ(part.surface.positions.row(static_cast<Eigen::Index>(v)),
                both.positions.row(whole));
    }
    faces += part.surface.triangles.rows();
  }
  EXPECT_TRUE((seen.array() == 1).all());
  EXPECT_EQ(faces, both.triangles.rows());
  // Faces keep their order and their corners.
  std::vector<Eigen::Index> next(parts.size(), 0);
  const Topology whole = topology(both);
  for (Eigen::Index f = 0; f < both.triangles.rows(); ++f) {
    const auto i = static_cast<std::size_t>(whole.component_of_vertex(both.triangles(f, 0)));
    const Eigen::Index row = next[i]++;
    for (int k = 0; k < 3; ++k) {
      const auto local = static_cast<std::size_t>(parts[i].surface.triangles(row, k));
      EXPECT_EQ(parts[i].vertex_in_whole[local], both.triangles(f, k));
    }
  }
}

TEST(Topology, NothingHasNoComponents) {
  EXPECT_EQ(topology(Surface{}).components(), 0);
  EXPECT_TRUE(split_components(Surface{}, Topology{}).empty());
}

}  // namespace
}  // namespace curveskel::topology_laws
