#include "surface/resample/canonical.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>

#include <curveskel/advanced/measures.hpp>
#include "meshes/random.hpp"
#include "tests/surfaces.hpp"

namespace curveskel::canonical_laws {
namespace {

using Change = std::function<Surface(Surface)>;

struct NamedChange {
  const char* name;
  Change change;
};

Surface turned(Surface surface, std::uint64_t seed) {
  shapes::Random random(seed);
  const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
  surface.positions *= q.normalized().toRotationMatrix();
  return surface;
}

const std::vector<NamedChange>& motions() {
  static const std::vector<NamedChange> all = {
      {"scaled by 1e-6",
       [](Surface s) {
         s.positions *= 1e-6;
         return s;
       }},
      {"scaled by 1e6",
       [](Surface s) {
         s.positions *= 1e6;
         return s;
       }},
      {"translated by 100 D",
       [](Surface s) {
         const double far = 100 * bounding_box_diagonal(s.positions) / std::sqrt(3.0);
         s.positions.rowwise() += Eigen::RowVector3d(far, -far, far);
         return s;
       }},
      {"rotated", [](Surface s) { return turned(std::move(s), 1); }},
      {"rotated otherwise", [](Surface s) { return turned(std::move(s), 2); }},
      {"mirrored",
       [](Surface s) {
         s = turned(std::move(s), 3);
         s.positions.col(0) *= -1;
         s.triangles.col(1).swap(s.triangles.col(2));
         return s;
       }},
  };
  return all;
}

using Step = std::array<std::int64_t, 3>;

// The vertices' places in canonical steps, sorted: a symmetric shape may lie in any of its poses.
std::vector<Step> places(const Canonical& canonical) {
  std::vector<Step> result;
  for (const auto& row : canonical.surface.positions.rowwise()) {
    const Eigen::RowVector3d steps = row / canonical_step;
    result.push_back({std::llround(steps.x()), std::llround(steps.y()), std::llround(steps.z())});
  }
  std::sort(result.begin(), result.end());
  return result;
}

void expect_same_after_motions(const std::vector<NamedSurface>& surfaces) {
  std::size_t compared = 0;
  std::size_t differing = 0;
  for (const auto& [name, surface] : surfaces) {
    const Canonical original = canonical_form(surface);
    const std::vector<Step> expected = places(original);
    for (const auto& [what, change] : motions()) {
      const Canonical moved = canonical_form(change(surface));
      std::vector<Step> difference;
      std::ranges::set_difference(places(moved), expected, std::back_inserter(difference));
      if (difference.empty()) {
        EXPECT_TRUE(moved.surface.triangles == original.surface.triangles) << name << ' ' << what;
      }
      compared += expected.size();
      differing += difference.size();
    }
  }
  // Noise of 1e-14 D meets a rounding border once in 4e6 coordinates.
  EXPECT_LE(differing, compared / 1'000'000);
}

TEST(Canonical, ScaledMovedAndTurnedFamiliesAreTheSame) { expect_same_after_motions(families()); }

TEST(Canonical, ScaledMovedAndTurnedRealSurfacesAreTheSame) {
  expect_same_after_motions(real_surfaces());
}

TEST(Canonical, RenumberedCopyIsTheSameToTheLastBit) {
  for (const auto* surfaces : {&families(), &real_surfaces()}) {
    for (const auto& [name, surface] : *surfaces) {
      const Canonical original = canonical_form(surface);
      const Canonical other = canonical_form(
          shapes::renumbered({.name = name, .surface = surface, .axis = {}}, 7).surface);
      EXPECT_TRUE(original.surface.positions == other.surface.positions) << name;
      EXPECT_TRUE(original.surface.triangles == other.surface.triangles) << name;
    }
  }
}

TEST(Canonical, TheWayBackLeadsToTheModel) {
  for (const auto* surfaces : {&families(), &real_surfaces()}) {
    for (const auto& [name, surface] : *surfaces) {
      const Surface moved = motions()[2].change(turned(surface, 3));
      const Canonical canonical = canonical_form(moved);
      const Positions back = canonical.to_model(canonical.surface.positions);
      double farthest = 0;
      for (int v = 0; v < back.rows(); ++v) {
        EXPECT_EQ(canonical.vertex_of_input(canonical.input_of_vertex(v)), v);
        farthest = std::max(
            farthest, (back.row(v) - moved.positions.row(canonical.input_of_vertex(v))).norm());
      }
      EXPECT_LT(farthest, canonical_step * canonical.scale) << name;
      EXPECT_LT((canonical.rotation.transpose() * canonical.rotation - Eigen::Matrix3d::Identity())
                    .norm(),
                1e-14)
          << name;
      const Surface there{back, canonical.to_model(canonical.surface.triangles)};
      EXPECT_NEAR(volume(there), volume(moved), 1e-5 * std::pow(canonical.scale, 3)) << name;
    }
  }
}

TEST(Canonical, FacesAreThoseOfTheInputSortedSmallestVertexFirst) {
  for (const auto& [name, surface] : families()) {
    const Canonical canonical = canonical_form(surface);
    std::vector<std::array<int, 3>> expected;
    for (const auto& row : surface.triangles.rowwise()) {
      const bool is_mirrored = canonical.rotation.determinant() < 0;
      std::array<int, 3> face = {canonical.vertex_of_input(row(0)),
                                 canonical.vertex_of_input(row(is_mirrored ? 2 : 1)),
                                 canonical.vertex_of_input(row(is_mirrored ? 1 : 2))};
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      expected.push_back(face);
    }
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(static_cast<std::size_t>(canonical.surface.triangles.rows()), expected.size());
    for (std::size_t f = 0; f < expected.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(canonical.surface.triangles(static_cast<Eigen::Index>(f), k),
                  expected[f][static_cast<std::size_t>(k)])
            << name;
      }
    }
  }
}

TEST(Canonical, NeighboursInSpaceAreNeighboursInMemory) {
  for (const auto& [name, surface] : families()) {
    const Surface canonical = canonical_form(surface).surface;
    double length = 0;
    for (Eigen::Index v = 1; v < canonical.positions.rows(); ++v) {
      length += (canonical.positions.row(v) - canonical.positions.row(v - 1)).norm();
    }
    const auto count = static_cast<double>(canonical.positions.rows());
    EXPECT_LT(length / count, 4 * std::sqrt(area(canonical) / count)) << name;
  }
}

}  // namespace
}  // namespace curveskel::canonical_laws
