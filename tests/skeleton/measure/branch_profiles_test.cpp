// Sections of tubes of which they are known.
#include <curveskel/branch_profiles.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include <curveskel/error.hpp>
#include "meshes/shapes.hpp"
#include "tests/skeleton/measure/tubes.hpp"

namespace curveskel {
namespace {

constexpr Eigen::Index sides = 40;
/// The area of a polygon over that of the ellipse around it.
const double filled =
    double(sides) / (2 * std::numbers::pi) * std::sin(2 * std::numbers::pi / double(sides));

Eigen::Matrix3d some_rotation() {
  return Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
}

/// A cube about the origin, `inward` as the wall of a cavity.
void add_cube(Surface& surface, double half, bool inward) {
  Surface cube = shapes::box({2 * half, 2 * half, 2 * half}, 1).surface;
  const Eigen::RowVector3d middle =
      0.5 * (cube.positions.colwise().minCoeff() + cube.positions.colwise().maxCoeff());
  cube.positions.rowwise() -= middle;
  if (inward) cube.triangles.col(1).swap(cube.triangles.col(2));
  const Eigen::Index before = surface.positions.rows();
  const Eigen::Index faces = surface.triangles.rows();
  surface.positions.conservativeResize(before + cube.positions.rows(), 3);
  surface.positions.bottomRows(cube.positions.rows()) = cube.positions;
  surface.triangles.conservativeResize(faces + cube.triangles.rows(), 3);
  surface.triangles.bottomRows(cube.triangles.rows()) =
      cube.triangles.array() + static_cast<int>(before);
}

// A cavity within a cavity was taken out twice, or not, by the order of the vertices.
TEST(BranchProfiles, DoNotDependOnTheOrderOfNestedCavities) {
  for (const auto& cavities : {std::array{1.5, 0.5}, std::array{0.5, 1.5}}) {
    Surface surface{Positions(0, 3), Triangles(0, 3)};
    add_cube(surface, 3, false);
    for (const double half : cavities) add_cube(surface, half, true);
    CurveSkeleton skeleton;
    skeleton.nodes.resize(2, 3);
    skeleton.nodes << 2.2, 2.2, -0.1, 2.2, 2.2, 0.13;
    skeleton.edges.resize(1, 2);
    skeleton.edges << 0, 1;
    skeleton.radii = Eigen::VectorXd::Constant(2, 0.5);
    EXPECT_NEAR(branch_profiles(surface, skeleton, {0, 1})[0].area, 36 - 9, 1e-9);
  }
}

TEST(BranchProfiles, OfTaperingEllipticTubesAreThoseOfTheFormula) {
  const auto a = [](double x) { return 0.5 - 0.03 * x; };
  const auto b = [](double x) { return 0.3 + 0.01 * x; };
  const Surface tube = straight_tube<std::function<double(double)>>(6, 31, int(sides), a, b);
  for (const Eigen::Matrix3d& turn :
       {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), some_rotation()}) {
    const Eigen::Vector3d origin(100, -20, 3);
    const Surface surface = moved(tube, turn, origin);
    CurveSkeleton skeleton = chain(points_on_x(0.4, 5.6, 14), 0.3);
    skeleton.nodes = (skeleton.nodes * turn.transpose()).rowwise() + origin.transpose();
    for (const double spacing : {0.0, 0.17}) {
      const auto sections = branch_profiles(surface, skeleton, {spacing, 0});
      ASSERT_EQ(sections.size(), spacing == 0 ? 14U : 32U);
      for (const BranchSection& section : sections) {
        const double x = 0.4 + section.s;
        const double area = filled * std::numbers::pi * a(x) * b(x);
        // Between rings the surface is made of flat triangles.
        EXPECT_NEAR(section.area, area, 2e-4 * area);
        EXPECT_NEAR(section.equivalent_diameter, 2 * std::sqrt(area / std::numbers::pi), 1e-4);
        EXPECT_NEAR(section.ellipticity, 1 - std::min(a(x), b(x)) / std::max(a(x), b(x)), 2e-4);
        EXPECT_NEAR((section.tangent - turn.col(0)).norm(), 0, 1e-9);
        EXPECT_NEAR((section.position - origin - turn.col(0) * x).norm(), 0, 1e-9);
        EXPECT_FALSE(section.near_junction);
      }
    }
  }
}

TEST(BranchProfiles, SubtractHolesAndLeaveOtherPartsOut) {
  const auto one = [](double) { return 1.0; };
  const auto third = [](double) { return 1.0 / 3; };
  const Eigen::Matrix3d as_is = Eigen::Matrix3d::Identity();
  const Surface outer = straight_tube(4, 9, int(sides), one, one);
  const Surface hole = turned_inside_out(
      moved(straight_tube(3, 7, int(sides), third, third), as_is, Eigen::Vector3d(0.5, 0.4, 0)));
  const Surface beside = moved(outer, as_is, Eigen::Vector3d(0, 2.5, 0));
  const Surface surface = together(together(outer, hole), beside);
  Positions line = points_on_x(1, 3, 5);
  line.col(1).setConstant(-0.4);
  const double area = filled * std::numbers::pi * (1 - 1.0 / 9);
  const double perimeter =
      2 * double(sides) * std::sin(std::numbers::pi / double(sides)) * (1 + 1.0 / 3);
  for (const BranchSection& section : branch_profiles(surface, chain(line, 0.5))) {
    EXPECT_NEAR(section.area, area, 1e-9);
    EXPECT_NEAR(section.perimeter, perimeter, 1e-9);
  }
  line.col(1).setConstant(0.4);
  for (const BranchSection& section : branch_profiles(surface, chain(line, 0.5))) {
    EXPECT_TRUE(std::isnan(section.area)) << "in the hole there is no section";
    EXPECT_LT(section.inscribed_radius, 0);
  }
}

/// A torus with its circle: the plane cuts it in two places.
TEST(BranchProfiles, GoRoundARing) {
  constexpr Eigen::Index around = 96;
  Surface torus;
  torus.positions.resize(around * sides, 3);
  torus.triangles.resize(2 * around * sides, 3);
  for (Eigen::Index i = 0; i < around; ++i) {
    for (Eigen::Index k = 0; k < sides; ++k) {
      const double u = 2 * std::numbers::pi * double(i) / around;
      const double v = 2 * std::numbers::pi * double(k) / sides;
      const double r = 3 + 0.5 * std::cos(v);
      torus.positions.row(i * sides + k) << r * std::cos(u), r * std::sin(u), 0.5 * std::sin(v);
      const auto at = [](Eigen::Index ring, Eigen::Index side) {
        return static_cast<std::int32_t>(ring % around * sides + side % sides);
      };
      torus.triangles.row(2 * (i * sides + k)) << at(i, k), at(i + 1, k), at(i + 1, k + 1);
      torus.triangles.row(2 * (i * sides + k) + 1) << at(i, k), at(i + 1, k + 1), at(i, k + 1);
    }
  }
  CurveSkeleton ring;
  ring.nodes.resize(around, 3);
  ring.edges.resize(around, 2);
  ring.radii = Eigen::VectorXd::Constant(around, 0.5);
  for (int i = 0; i < around; ++i) {
    const double u = 2 * std::numbers::pi * (i + 0.25) / around;
    ring.nodes.row(i) << 3 * std::cos(u), 3 * std::sin(u), 0;
    ring.edges.row(i) << (i == 0 ? 0 : i - 1), (i == 0 ? around - 1 : i);
  }
  // Rows as Edges has them: the closing edge comes second.
  Edges sorted(around, 2);
  sorted.row(0) = ring.edges.row(1);
  sorted.row(1) = ring.edges.row(0);
  for (int i = 2; i < around; ++i) sorted.row(i) = ring.edges.row(i);
  ring.edges = sorted;
  const auto sections = branch_profiles(torus, ring);
  ASSERT_EQ(sections.size(), static_cast<std::size_t>(around + 1));
  for (const BranchSection& section : sections) {
    EXPECT_NEAR(section.area, filled * std::numbers::pi * 0.25, 0.003);
    EXPECT_NEAR(section.ellipticity, 0, 0.01);
    EXPECT_NEAR(section.tangent.dot(section.position.normalized()), 0, 1e-3);
    EXPECT_FALSE(section.near_junction);
  }
}

TEST(BranchProfiles, FlagWhatOtherBranchesPassThrough) {
  const auto wide = [](double) { return 2.0; };
  const Surface tube = straight_tube(10, 21, int(sides), wide, wide);
  CurveSkeleton fork;  // one branch along the axis, two that leave it side by side
  fork.nodes.resize(5, 3);
  fork.nodes << 1, 0, 0, 4, 0, 0, 9, 0.5, 0, 9, -0.5, 0, 2, 0, 0;
  fork.edges.resize(4, 2);
  fork.edges << 0, 4, 1, 2, 1, 3, 1, 4;
  const auto sections = branch_profiles(tube, fork, {0.25, 0});
  int flagged = 0;
  for (const BranchSection& section : sections) {
    if (section.position.x() == 9) continue;       // the other ends in that very plane
    const bool beyond = section.position.x() > 2;  // the ball of radius 2 around the junction
    EXPECT_EQ(section.near_junction, beyond) << section.position.transpose();
    flagged += section.near_junction ? 1 : 0;
  }
  EXPECT_GT(flagged, 20);
}

TEST(BranchProfiles, AreTheSameFromAnyNumberOfThreadsAndRefuseABadSpacing) {
  const auto one = [](double) { return 1.0; };
  const Surface tube = straight_tube(4, 9, int(sides), one, one);
  const CurveSkeleton skeleton = chain(points_on_x(0.5, 3.5, 7), 1);
  const auto alone = branch_profiles(tube, skeleton, {0.01, 1});
  const auto many = branch_profiles(tube, skeleton, {0.01, 4});
  ASSERT_EQ(alone.size(), many.size());
  for (std::size_t k = 0; k < alone.size(); ++k) EXPECT_EQ(alone[k].area, many[k].area);
  EXPECT_THROW((void)branch_profiles(tube, skeleton, {-1, 0}), Error);
  try {
    (void)branch_profiles(tube, skeleton, {1e-12, 0});
    FAIL() << "sections without end";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a spacing of 1e-12;"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace curveskel
