// Laws of hole triangulation: it fills the border, the same way every time.
#include "surface/repair/hole_triangulation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/monitor.hpp>
#include "surface/repair/close_surface.hpp"

namespace curveskel::hole_triangulation_laws {
namespace {

struct Rim {
  Positions corners;
  Positions beyond;
};

/// The open end of a tube: a regular polygon in an inclined plane, the tube's wall beyond it.
Rim regular_rim(int count) {
  Rim rim{Positions(count, 3), Positions(count, 3)};
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()));
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    const Eigen::Vector3d corner(std::cos(angle), std::sin(angle), 0);
    rim.corners.row(i) = (turn * corner).transpose();
    rim.beyond.row(i) = (turn * (corner - Eigen::Vector3d(0, 0, 0.3))).transpose();
  }
  return rim;
}

/// A rim of changing radius and height.
Rim uneven_rim(int count, std::uint32_t seed) {
  Rim rim = regular_rim(count);
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int i = 0; i < count; ++i) {
    const double stretch = 0.7 + 0.6 * unit();
    rim.corners.row(i) *= stretch;
    rim.beyond.row(i) *= stretch;
    rim.corners(i, 2) += 0.2 * unit();
  }
  return rim;
}

bool nowhere(std::int32_t /*i*/, std::int32_t /*k*/) { return false; }

std::vector<HoleTriangle> filled(const Rim& rim) {
  return triangulate_hole(rim.corners, rim.beyond, nowhere, {});
}

/// Each triangle stands upon two edges that are there and adds one; in the end all are used.
void expect_fills(const std::vector<HoleTriangle>& triangles, std::int32_t count) {
  ASSERT_EQ(triangles.size(), static_cast<std::size_t>(count) - 2);
  std::set<std::pair<std::int32_t, std::int32_t>> open;
  for (std::int32_t i = 0; i + 1 < count; ++i) open.emplace(i, i + 1);
  for (const auto& [i, j, k] : triangles) {
    ASSERT_LT(i, j);
    ASSERT_LT(j, k);
    EXPECT_EQ(open.erase({i, j}), 1U) << i << ' ' << j;
    EXPECT_EQ(open.erase({j, k}), 1U) << j << ' ' << k;
    EXPECT_TRUE(open.emplace(i, k).second);
  }
  EXPECT_EQ(open, (std::set<std::pair<std::int32_t, std::int32_t>>{{0, count - 1}}));
}

double area(const std::vector<HoleTriangle>& triangles, const Positions& corners) {
  double sum = 0;
  for (const auto& [i, j, k] : triangles) {
    const Eigen::Vector3d a = (corners.row(j) - corners.row(i)).transpose();
    const Eigen::Vector3d b = (corners.row(k) - corners.row(i)).transpose();
    sum += 0.5 * a.cross(b).norm();
  }
  return sum;
}

/// Blocks of memory all over, some of them free again: what is allocated next lies anywhere.
class ScatteredMemory {
 public:
  void scatter() {
    for (int i = 0; i < 300; ++i) {
      blocks_.push_back(std::make_unique<std::vector<char>>(400 + random_() % 6000));
      if (random_() % 2 == 0) blocks_[random_() % blocks_.size()].reset();
    }
  }

 private:
  std::mt19937 random_{1};
  std::vector<std::unique_ptr<std::vector<char>>> blocks_;
};

TEST(HoleTriangulation, FillsTheBorderEdgeByEdge) {
  for (int count = 3; count <= 60; ++count) {
    SCOPED_TRACE(count);
    expect_fills(filled(regular_rim(count)), count);
    expect_fills(filled(uneven_rim(count, static_cast<std::uint32_t>(count))), count);
  }
}

TEST(HoleTriangulation, OfAPlanePolygonCoversItOnce) {
  for (int count = 3; count <= 60; ++count) {
    const Rim rim = regular_rim(count);
    const double expected = 0.5 * count * std::sin(2 * std::numbers::pi / count);
    EXPECT_NEAR(area(filled(rim), rim.corners), expected, 1e-12) << count;
  }
}

TEST(HoleTriangulation, IsTheSameWhereverMemoryLies) {
  ScatteredMemory memory;
  for (int count = 4; count <= 24; ++count) {
    const Rim rim = regular_rim(count);
    const auto first = filled(rim);
    for (int again = 0; again < 20; ++again) {
      memory.scatter();
      EXPECT_EQ(filled(rim), first) << count;
    }
  }
}

TEST(HoleTriangulation, FromAnotherCornerOnIsAboutAsLarge) {
  for (int count = 5; count <= 30; ++count) {
    const Rim rim = uneven_rim(count, 100 + static_cast<std::uint32_t>(count));
    const double whole = area(filled(rim), rim.corners);
    Rim turned = rim;
    for (int i = 0; i < count; ++i) {
      turned.corners.row(i) = rim.corners.row((i + 2) % count);
      turned.beyond.row(i) = rim.beyond.row((i + 2) % count);
    }
    const auto triangles = filled(turned);
    expect_fills(triangles, count);
    // The fold of a part depends on how its neighbour was filled: another start may find a
    // neighbouring optimum.
    EXPECT_NEAR(area(triangles, turned.corners), whole, 0.05 * whole) << count;
  }
}

TEST(HoleTriangulation, LeavesAloneWhatIsJoinedOutsideTheHole) {
  const Rim rim = uneven_rim(12, 7);
  for (const auto& chosen : filled(rim)) {
    const std::pair taken(chosen[0], chosen[2]);
    if (taken.second == 11) continue;  // the border's last edge
    const auto joined = [&](std::int32_t i, std::int32_t k) { return std::pair(i, k) == taken; };
    const auto triangles = triangulate_hole(rim.corners, rim.beyond, joined, {});
    expect_fills(triangles, 12);
    for (const auto& [i, j, k] : triangles) EXPECT_NE(std::pair(i, k), taken);
  }
}

TEST(HoleTriangulation, OfCornersOnALineIsNone) {
  Rim rim = regular_rim(6);
  for (int i = 0; i < 6; ++i) rim.corners.row(i) << i, 0, 0;
  EXPECT_TRUE(filled(rim).empty());
  EXPECT_TRUE(filled(Rim{rim.corners.topRows(2), rim.beyond.topRows(2)}).empty());
}

TEST(HoleTriangulation, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  const Rim rim = regular_rim(40);
  EXPECT_THROW((void)triangulate_hole(rim.corners, rim.beyond, nowhere, stop.get_token()),
               Cancelled);
}

/// A cone over a polygon that goes to and fro at random: the search among all triangles would take
/// seconds.
TEST(HoleTriangulation, ATangledRimWithoutDelaunayTrianglesIsNarrowed) {
  constexpr int count = 200;
  int tangled = 0;
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    std::mt19937 random(seed);
    Surface cone{Positions(count + 1, 3), Triangles(count, 3)};
    for (Eigen::Index i = 0; i < cone.positions.size(); ++i) {
      cone.positions.data()[i] = static_cast<double>(random()) / 4294967296.0;
    }
    Rim rim{cone.positions.topRows(count), Positions(count, 3)};
    for (std::int32_t i = 0; i < count; ++i) {
      cone.triangles.row(i) << (i + 1) % count, i, count;
      rim.beyond.row(i) = cone.positions.row(count);
    }
    const bool is_tangled = filled(rim).empty();
    tangled += is_tangled ? 1 : 0;
    const ClosedParts closed = close_surface(cone, {});
    EXPECT_NO_THROW(require_closed_manifold(closed.surface, "a test")) << seed;
    EXPECT_EQ(closed.holes_narrowed, is_tangled ? 1 : 0) << seed;
  }
  EXPECT_GT(tangled, 0);
}

}  // namespace
}  // namespace curveskel::hole_triangulation_laws
