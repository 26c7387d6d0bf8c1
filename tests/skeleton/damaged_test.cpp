// Surfaces that were open or noisy, on the whole way from repair to certificate.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/branch_profiles.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/repair.hpp>
#include "meshes/shapes.hpp"
#include "tests/skeleton/measure/tubes.hpp"
#include "tests/skeleton/shortfalls.hpp"
#include "tests/soups.hpp"

namespace curveskel::damaged_laws {
namespace {

constexpr std::array known{
    // Branches into the fur.
    Shortfall{"noisy star 14", "tips", 18},
    Shortfall{"noisy star 18", "tips", 6},
    Shortfall{"smoothed star 7", "tips", 6},
    // Inside after thirty iterations of fairing only.
    Shortfall{"noisy star 24", "faired", 1},
};

/// The shape's faces whose middle fulfils the predicate.
template <typename Predicate>
PolygonSoup part_of(const Surface& surface, const Predicate& stays) {
  PolygonSoup soup;
  soup.positions = surface.positions;
  soup.offsets = {0};
  for (const auto& t : surface.triangles.rowwise()) {
    const Eigen::RowVector3d middle = surface.positions(t.transpose(), Eigen::all).colwise().mean();
    if (stays(middle)) append(soup, {t(0), t(1), t(2)});
  }
  return soup;
}

Extraction extracted(const PolygonSoup& soup) {
  const RepairedSurface repaired = repair(soup, {}, {});
  ExtractOptions options;
  options.rims = repaired.rims;
  return extract(repaired.surface, options, {});
}

double nearest_tip(const CurveSkeleton& skeleton, const Eigen::RowVector3d& to, int& tip) {
  std::vector<int> degree(static_cast<std::size_t>(skeleton.nodes.rows()), 0);
  for (const std::int32_t node : skeleton.edges.reshaped()) {
    ++degree[static_cast<std::size_t>(node)];
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (int node = 0; node < skeleton.nodes.rows(); ++node) {
    const double distance = (skeleton.nodes.row(node) - to).norm();
    if (degree[static_cast<std::size_t>(node)] != 1 || distance >= nearest) continue;
    nearest = distance;
    tip = node;
  }
  return nearest;
}

TEST(Damaged, AnOpenTubesSkeletonReachesItsRims) {
  for (const double radius : {0.2, 0.5, 1.0}) {
    SCOPED_TRACE(radius);
    const auto tube = shapes::tube("tube", shapes::straight(8), shapes::constant(radius), 32);
    const auto soup = part_of(tube.surface, [](const auto& p) { return std::abs(p.x()) < 3; });
    const Extraction found = extracted(soup);
    EXPECT_TRUE(found.certificate.topology_correct());
    EXPECT_GE(found.certificate.inside_fraction, 0.999);
    EXPECT_EQ(found.certificate.tips, 2);
    const double end = soup.positions(soup.corners, Eigen::all).col(0).maxCoeff();
    for (const double side : {-1.0, 1.0}) {
      int tip = -1;
      EXPECT_LT(nearest_tip(found.skeleton, {side * end, 0, 0}, tip), 0.3 * radius);
      EXPECT_NEAR(found.skeleton.radii[tip], radius, 0.15 * radius);
    }
  }
}

/// Ends, where the repair has put caps, are as wide as the middle.
TEST(Damaged, WidthsOfAnOpenTubeKnowNothingOfItsCaps) {
  const auto unit = [](double) { return 1.0; };
  for (const bool inside_out : {false, true}) {
    Surface closed = straight_tube(10, 41, 48, unit, unit);
    if (inside_out) closed = turned_inside_out(closed);
    const auto soup =
        part_of(closed, [](const auto& p) { return p.x() > 1e-9 && p.x() < 10 - 1e-9; });
    const RepairedSurface repaired = repair(soup, {}, {});
    ASSERT_EQ(repaired.repairs.holes_closed, 2);
    const Extraction found = extracted(soup);
    EXPECT_GT(found.skeleton.radii.minCoeff(), 0.99);
    EXPECT_LT(found.skeleton.radii.maxCoeff(), 1.01);
    const auto sections =
        branch_profiles(repaired.surface, found.skeleton, {0.25, 0, repaired.rims});
    EXPECT_LT(sections.front().position.x(), 0.1);
    for (const BranchSection& section : sections) {
      EXPECT_NEAR(section.inscribed_radius, 1, 0.01) << section.s;
    }
  }
}

TEST(Damaged, AShortOpenTubesSkeletonIsItsAxis) {
  for (const int sides : {32, 64}) {
    for (const double length : {0.8, 1.0, 1.2, 1.6}) {  // in diameters
      SCOPED_TRACE(testing::Message() << sides << " sides, length " << length);
      const auto tube = shapes::tube("tube", shapes::straight(8), shapes::constant(1), sides);
      const auto soup =
          part_of(tube.surface, [=](const auto& p) { return std::abs(p.x()) < length; });
      const Extraction found = extracted(soup);
      EXPECT_EQ(found.certificate.tips, 2);
      EXPECT_LT(found.skeleton.nodes.rightCols(2).rowwise().norm().maxCoeff(), 0.03);
      EXPECT_NEAR(found.skeleton.nodes.col(0).maxCoeff(), length, 0.1);
      EXPECT_NEAR(found.skeleton.nodes.col(0).minCoeff(), -length, 0.1);
    }
  }
}

TEST(Damaged, EveryArmOfAnOpenStarReachesItsRim) {
  const auto star = shapes::tube_union("star", shapes::star(4, 3, 0.3));
  const auto soup = part_of(star.surface, [](const auto& p) { return p.norm() < 2.5; });
  const RepairedSurface repaired = repair(soup, {}, {});
  ASSERT_EQ(repaired.rims.size(), 4U);
  const Extraction found = extracted(soup);
  EXPECT_EQ(found.certificate.tips, 4);
  EXPECT_TRUE(found.certificate.topology_correct());
  for (const auto& rim : repaired.rims) {
    const Eigen::RowVector3d middle = repaired.surface.positions(rim, Eigen::all).colwise().mean();
    int tip = -1;
    EXPECT_LT(nearest_tip(found.skeleton, middle, tip), 0.1);
    ASSERT_GE(tip, 0);
    EXPECT_GT(found.skeleton.lives[tip], 3) << "the closed arm's life goes on with it";
  }
}

TEST(Damaged, TheRimOfAHoleInASideIsNotReached) {
  const auto tube = shapes::tube("tube", shapes::straight(8), shapes::constant(0.5), 32);
  const auto whole = extracted(soup_of(tube.surface));
  const auto found = extracted(
      part_of(tube.surface, [](const auto& p) { return std::abs(p.x()) > 0.2 || p.y() < 0.4; }));
  EXPECT_EQ(found.certificate.tips, 2);
  EXPECT_EQ(found.certificate.junctions, 0);
  EXPECT_LT(hausdorff_distance(whole.skeleton, found.skeleton, 0.02), 0.15);
}

/// A closed cylinder without a window in its side: long, short, at its middle and near an end.
TEST(Damaged, AWindowInASideLeavesBothTips) {
  const auto tube = shapes::tube("tube", shapes::straight(14), shapes::constant(1), 32);
  const auto whole = extracted(soup_of(tube.surface));
  for (const double cosine : {0.92, 0.7}) {  // of half of the window's angle
    for (const auto& [from, to] : {std::pair{-6.6, 6.6}, std::pair{-6.6, 2.5}, std::pair{-1.2, 1.2},
                                   std::pair{-6.5, -4.0}}) {
      SCOPED_TRACE(testing::Message() << cosine << ", " << from << " to " << to);
      const auto found = extracted(part_of(tube.surface, [&, begin = from, end = to](auto& p) {
        return p.x() < begin || p.x() > end || p.y() < cosine * p.tail(2).norm();
      }));
      if (cosine > 0.9) {  // a wide one gets a branch
        EXPECT_EQ(found.certificate.tips, 2);
      }
      for (const double side : {-1.0, 1.0}) {
        EXPECT_NEAR((side * found.skeleton.nodes.col(0)).maxCoeff(),
                    (side * whole.skeleton.nodes.col(0)).maxCoeff(), 0.35);
      }
    }
  }
}

/// A star of five arms under noise of `share` of the diagonal, which is some .3 of their radius per
/// hundredth: a fur.
// The curve ended in a hole beside its way, or had a branch to it.
TEST(Damaged, HolesInATubesSideNeitherEndNorForkItsCurve) {
  const auto tube = shapes::tube("tube", shapes::straight(10), shapes::constant(0.5), 32);
  for (const double hole : {0.25, 0.3, 0.35, 0.4}) {
    for (const double from_end : {0.4, 0.8, 1.5, 5.0}) {
      SCOPED_TRACE(testing::Message() << hole << ' ' << from_end);
      const Eigen::RowVector3d at(5 - from_end, 0.5, 0);
      const Extraction found =
          extracted(part_of(tube.surface, [&](const auto& p) { return (p - at).norm() > hole; }));
      EXPECT_EQ(found.certificate.tips, 2);
      EXPECT_LT(found.skeleton.nodes.rightCols<2>().rowwise().norm().maxCoeff(), 0.05);
    }
  }
}

Surface furry_star(double share, std::uint64_t seed) {
  shapes::TubeUnionOptions fine;
  fine.resolution = 6;
  const auto star = shapes::tube_union("star", shapes::star(5, 3, 0.3), fine);
  const double noise = share * bounding_box_diagonal(star.surface.positions);
  return shapes::noisy(star, noise, seed).surface;
}

// The fur meets itself: where a step from one ball to the next led outside, the curve left it.
TEST(Damaged, NoiseAsThickAsTheLimbsLeavesTheCurveInside) {
  for (const std::uint64_t seed : {7, 12, 14, 18, 24}) {
    SCOPED_TRACE(seed);
    const Extraction found = extract(furry_star(0.01, seed), {}, {});
    EXPECT_GE(found.certificate.inside_fraction, 0.99999);
    expect_at_most(known, "noisy star " + std::to_string(seed), "faired",
                   is_kept(found.history, try_faired) ? 1 : 0, 0);
    EXPECT_GE(found.certificate.tips, 5);
    expect_at_most(known, "noisy star " + std::to_string(seed), "tips", found.certificate.tips, 5);
  }
}

TEST(Damaged, NoiseThatTheCurveLeavesIsSmoothedAway) {
  for (const std::uint64_t seed : {7}) {  // of 24 seeds the one that needs it
    SCOPED_TRACE(seed);
    const Surface star = furry_star(0.0125, seed);
    const Extraction found = extract(star, {}, {});
    EXPECT_TRUE(found.certificate.inside_enough);
    EXPECT_TRUE(is_kept(found.history, try_faired));
    EXPECT_GE(found.certificate.tips, 5);
    expect_at_most(known, "smoothed star " + std::to_string(seed), "tips", found.certificate.tips,
                   5);
    ExtractOptions as_it_is;
    as_it_is.fair_if_outside = false;
    as_it_is.all_vertices_if_failed = false;
    // Otherwise this shape would show nothing.
    EXPECT_FALSE(extract(star, as_it_is, {}).certificate.inside_enough);
  }
}

// A single part that could not be faired took the time of all, and what had been won for the
// others.
TEST(Damaged, NoiseOnOnePartLeavesTheOthersAsTheyAre) {
  const Surface star = furry_star(0.0125, 4);
  const Surface ring = shapes::translated(shapes::torus(1, 0.3, 24), {0, 0, 8}).surface;
  const Surface both = together(star, ring);
  ExtractOptions once;
  once.fair_if_outside = once.all_vertices_if_failed = false;
  const Extraction first = extract(both, once, {});
  ASSERT_FALSE(first.certificate.inside_enough) << "else this shape shows nothing";
  const Extraction found = extract(both, {}, {});
  EXPECT_TRUE(found.certificate.inside_enough);
  EXPECT_TRUE(is_kept(found.history, try_faired));
  const auto ring_of = [&](const Extraction& of) {
    const int from = of.skeleton.node_of_vertex.tail(ring.positions.rows()).minCoeff();
    return Positions(of.skeleton.nodes.bottomRows(of.skeleton.nodes.rows() - from));
  };
  EXPECT_EQ(ring_of(found), ring_of(first));
  int tries_of_ring = 0;
  for (const Try& one : found.history) {
    if (one.component != 1) continue;
    ++tries_of_ring;
    EXPECT_EQ(one.outcome, Outcome::kept);
    EXPECT_EQ(found.history[idx(one.part_of)].name, try_as_asked);
  }
  EXPECT_EQ(tries_of_ring, 1);
}

}  // namespace
}  // namespace curveskel::damaged_laws
