// Handles that are holes through something solid rather than rings of it: the contraction closes
// the tunnel, not the body, so that the surgery's cycle runs along it and not round it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <curveskel/extract.hpp>
#include <curveskel/topology.hpp>
#include "meshes/level_set.hpp"
#include "meshes/shapes.hpp"

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

}  // namespace
}  // namespace curveskel::tunnels_laws
