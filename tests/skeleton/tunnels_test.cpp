// Handles that are holes through something solid rather than rings of it: the contraction closes
// the tunnel, not the body, so that the surgery's cycle runs along it and not round it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/topology.hpp>
#include "meshes/level_set.hpp"
#include "meshes/shapes.hpp"
#include "surface/resample/canonical.hpp"

namespace curveskel::tunnels_laws {
namespace {

using Eigen::Vector3d;

struct Tunnel {
  Vector3d through;
  Vector3d direction;
  double radius;
};

/// A ball of radius 1 with straight tunnels through it.
Surface pierced_ball(const std::vector<Tunnel>& tunnels, const Vector3d& seed, double spacing) {
  return shapes::mesh_level_set(
      [&](const Vector3d& p) {
        double field = p.norm() - 1;
        for (const Tunnel& tunnel : tunnels) {
          const Vector3d along = tunnel.direction.normalized();
          const Vector3d off = p - tunnel.through;
          field = std::max(field, tunnel.radius - (off - off.dot(along) * along).norm());
        }
        return field;
      },
      {seed}, spacing);
}

void expect_cycles_round(const Surface& surface, int tunnels, const std::string& name) {
  SCOPED_TRACE(name);
  ASSERT_EQ(topology(surface).total_genus(), tunnels);
  const Certificate found = extract(surface, {}, {}).certificate;
  EXPECT_EQ(found.cycle_rank, tunnels);
  EXPECT_EQ(found.homology_rank, tunnels);
  EXPECT_TRUE(found.inside_enough) << found.inside_fraction;
  EXPECT_EQ(found.spurs, 0);
}

TEST(Tunnels, OfEveryWidthHaveCyclesRoundThem) {
  for (const double radius : {0.05, 0.1, 0.2, 0.4}) {
    const Tunnel central{{0, 0, 0}, {1, 2, 3}, radius};
    expect_cycles_round(pierced_ball({central}, {0.9, 0, 0}, std::min(0.06, radius)), 1,
                        "central, radius " + std::to_string(radius));
    if (radius > 0.3) continue;
    const Tunnel aside{{0.4, 0, 0}, {0, 1, 3}, radius};
    expect_cycles_round(pierced_ball({aside}, {-0.5, 0, 0}, std::min(0.06, radius)), 1,
                        "aside, radius " + std::to_string(radius));
  }
}

TEST(ThoroughTunnels, SideBySideHaveACycleEach) {
  std::vector<Tunnel> tunnels;
  for (const double x : {-0.5, 0.0, 0.5}) {
    for (const double y : {-0.4, 0.1, 0.6}) tunnels.push_back({{x, y, 0}, {0.1, 0, 1}, 0.08});
    expect_cycles_round(pierced_ball(tunnels, {0.2, -0.1, 0}, 0.05),
                        static_cast<int>(tunnels.size()), std::to_string(tunnels.size()));
  }
}

// Meshes of rings so fine that they are coarsened: two thirds of a ring were gone round twice.
TEST(Tunnels, RingsOfAnyFinenessAreGoneRoundOnce) {
  for (const int around : {6, 12, 24, 48, 72}) {
    const auto ring = shapes::torus(3, 0.4, around);
    const Extraction found = extract(ring.surface, {}, {});
    EXPECT_TRUE(found.certificate.topology_correct()) << around;
    EXPECT_GT(found.certificate.coverage, 0.999) << around;
  }
}

/// n x n unit squares as thick as given, of which each second one in each second row is a hole; at
/// some corners only `pinch` times as thick.
Surface sieve_with_pinches(int n, double thickness, double pinch) {
  const auto is_hole = [n](int i, int j) {
    return i < 0 || j < 0 || i >= n || j >= n || (i % 2 == 1 && j % 2 == 1);
  };
  std::map<std::array<int, 3>, int> number;
  std::vector<Vector3d> places;
  std::vector<std::array<int, 3>> triangles;
  const auto corner = [&](int i, int j, int top) {
    const auto [at, is_new] = number.try_emplace({i, j, top}, static_cast<int>(places.size()));
    const double share = (i + j) % 5 == 0 ? pinch : 1;
    if (is_new) places.emplace_back(i, j, thickness * share * top);
    return at->second;
  };
  const auto add_quad = [&](int a, int b, int c, int d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (is_hole(i, j)) continue;
      const std::array<std::array<int, 2>, 4> round{
          {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
      const std::array<std::array<int, 2>, 4> beyond{
          {{i, j - 1}, {i + 1, j}, {i, j + 1}, {i - 1, j}}};
      const auto at = [&](std::size_t k, int top) { return corner(round[k][0], round[k][1], top); };
      add_quad(at(0, 1), at(1, 1), at(2, 1), at(3, 1));
      add_quad(at(0, 0), at(3, 0), at(2, 0), at(1, 0));
      for (std::size_t k = 0; k < 4; ++k) {
        if (!is_hole(beyond[k][0], beyond[k][1])) continue;
        const std::size_t next = (k + 1) % 4;
        add_quad(at(k, 0), at(next, 0), at(next, 1), at(k, 1));
      }
    }
  }
  Surface surface;
  surface.positions.resize(static_cast<Eigen::Index>(places.size()), 3);
  surface.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t k = 0; k < places.size(); ++k) {
    surface.positions.row(static_cast<Eigen::Index>(k)) = places[k].transpose();
  }
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    surface.triangles.row(static_cast<Eigen::Index>(k)) =
        Eigen::RowVector3i(triangles[k].data()).cast<std::int32_t>();
  }
  return surface;
}

// Plates of CAD: where balls are as good as outside no chain led on, and a cycle missed its hole.
TEST(Tunnels, OfPlatesThatAreHardlyThereInPlacesHaveACycleEach) {
  for (const int n : {3, 5, 7}) {
    for (const double thickness : {0.1, 0.5, 1.0, 2.0}) {
      for (const double pinch : {1e-3, 1e-4, 1e-5, 1e-6}) {
        const Surface surface = sieve_with_pinches(n, thickness, pinch);
        const double size = bounding_box_diagonal(surface.positions);
        if (thickness * pinch < 2 * canonical_step * size) continue;  // which rounding may close
        SCOPED_TRACE(std::to_string(n) + " wide, " + std::to_string(thickness) + " thick, " +
                     std::to_string(pinch) + " of it at pinches");
        const int holes = (n / 2) * (n / 2);
        ASSERT_EQ(topology(surface).total_genus(), holes);
        const Certificate found = extract(surface, {}, {}).certificate;
        EXPECT_EQ(found.cycle_rank, holes);
        EXPECT_EQ(found.homology_rank, holes);
        EXPECT_TRUE(found.inside_enough) << found.inside_fraction;
      }
    }
  }
}

}  // namespace
}  // namespace curveskel::tunnels_laws
