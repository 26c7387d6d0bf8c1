// Laws of bodies without limbs: the curve is the axis that a person would draw.
#include "skeleton/embed/place/convex_axis.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/read.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/embed/working_surface.hpp"

namespace curveskel::convex_axis_laws {
namespace {

using Eigen::Vector3d;

constexpr double dent = EmbedTuning{}.convex_dent;

bool is_convex_shape(const Surface& surface) {
  const SurfaceTree tree(surface);
  const InscribedBalls balls = inscribed_balls(surface, tree, 0);
  return is_convex(WorkingSurface(surface, balls), tree, dent);
}

/// Along z, its middle at the origin. With two turns or more it is a star that crosses itself.
Surface prism(int sides, double radius, double height, int turns = 1) {
  Surface prism;
  prism.positions.resize(Eigen::Index{2} * sides + 2, 3);
  prism.triangles.resize(Eigen::Index{4} * sides, 3);
  prism.positions.row(Eigen::Index{2} * sides) << 0, 0, -height / 2;
  prism.positions.row(Eigen::Index{2} * sides + 1) << 0, 0, height / 2;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * turns * i / sides;
    const int next = (i + 1) % sides;
    for (const int level : {0, 1}) {
      prism.positions.row(Eigen::Index{level} * sides + i) << radius * std::cos(angle),
          radius * std::sin(angle), (level - 0.5) * height;
    }
    prism.triangles.row(Eigen::Index{4} * i) << i, next, sides + next;
    prism.triangles.row(Eigen::Index{4} * i + 1) << i, sides + next, sides + i;
    prism.triangles.row(Eigen::Index{4} * i + 2) << 2 * sides, next, i;
    prism.triangles.row(Eigen::Index{4} * i + 3) << 2 * sides + 1, sides + i, sides + next;
  }
  return prism;
}

shapes::Shape shape_of(Surface surface) {
  return {.name = "", .surface = std::move(surface), .axis = {}};
}

/// Flat faces become round, corners less sharp: the surface of |x|^n + |y|^n + |z|^n = 1.
Surface rounded_box(const Vector3d& size, int cells, double exponent) {
  Surface box = shapes::box({2, 2, 2}, cells).surface;
  for (auto row : box.positions.rowwise()) {
    row /= std::pow(row.array().abs().pow(exponent).sum(), 1 / exponent);
  }
  box.positions *= size.asDiagonal() * 0.5;
  return box;
}

struct Turn {
  Vector3d about;
  double angle;
};
const std::vector<Turn>& turns() {
  static const std::vector<Turn> all{{{1, 2, 3}, 0.7}, {{-2, 1, 0.5}, 2.4}};
  return all;
}

/// The curve of a turned and renumbered copy, in the body's own frame.
CurveSkeleton curve_of_turned(const Surface& body, const Turn& turn) {
  const Vector3d about = turn.about.normalized();
  const Surface turned =
      shapes::renumbered(shapes::rotated(shape_of(body), about, turn.angle), 5).surface;
  CurveSkeleton curve = extract(turned, {}, {}).skeleton;
  curve.nodes *= Eigen::AngleAxisd(turn.angle, about).toRotationMatrix();
  return curve;
}

double off_line(const CurveSkeleton& curve, const Vector3d& along) {
  const Positions off = curve.nodes - (curve.nodes * along) * along.transpose();
  return off.rowwise().norm().maxCoeff();
}

/// From the middle nearly half-way or farther to either side, and no farther than the surface.
void expect_line_through_middle(const CurveSkeleton& curve, const Vector3d& along, double half,
                                double diagonal) {
  EXPECT_EQ(graph_topology(curve).tips, 2);
  EXPECT_EQ(graph_topology(curve).junctions, 0);
  EXPECT_LT(off_line(curve, along), 1e-4 * diagonal);
  const Eigen::VectorXd places = curve.nodes * along;
  for (const double end : {places.maxCoeff(), -places.minCoeff()}) {
    EXPECT_GE(end, 0.499 * half);
    EXPECT_LT(end, half);
  }
}

/// Cubes of size 1 in the plane of x and y: a back, and `teeth` on it, a gap of one cube apart.
Surface comb(int teeth, int length) {
  const int width = 2 * teeth - 1;
  const auto is_filled = [=](int x, int y) {
    return x >= 0 && x < width && y >= 0 && y <= length && (y == 0 || x % 2 == 0);
  };
  const auto vertex = [=](int x, int y, int z) { return 2 * (y * (width + 1) + x) + z; };
  std::vector<Eigen::RowVector3i> triangles;
  const auto add_quad = [&](int a, int b, int c, int d) {
    triangles.emplace_back(a, b, c);
    triangles.emplace_back(a, c, d);
  };
  for (int y = 0; y <= length; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!is_filled(x, y)) continue;
      const auto corner = [&](int k, int z) {
        return vertex(x + (k == 1 || k == 2), y + k / 2, z);
      };
      add_quad(corner(0, 1), corner(1, 1), corner(2, 1), corner(3, 1));
      add_quad(corner(3, 0), corner(2, 0), corner(1, 0), corner(0, 0));
      const std::array<bool, 4> open{!is_filled(x, y - 1), !is_filled(x + 1, y),
                                     !is_filled(x, y + 1), !is_filled(x - 1, y)};
      for (int k = 0; k < 4; ++k) {
        if (!open[idx(k)]) continue;
        const int next = (k + 1) % 4;
        add_quad(corner(k, 0), corner(next, 0), corner(next, 1), corner(k, 1));
      }
    }
  }
  Surface comb;
  comb.positions.resize(Eigen::Index{2} * (width + 1) * (length + 2), 3);
  for (int y = 0; y < length + 2; ++y) {
    for (int x = 0; x <= width; ++x) {
      for (const int z : {0, 1}) comb.positions.row(vertex(x, y, z)) << x, y, z;
    }
  }
  comb.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    comb.triangles.row(static_cast<Eigen::Index>(t)) = triangles[t];
  }
  return clean(soup_of(comb)).surface;
}

TEST(ConvexAxis, ACombIsNotConvexHoweverManyTeethItHas) {
  for (int teeth = 2; teeth <= 17; ++teeth) {
    for (const int length : {3, 10}) {
      SCOPED_TRACE(testing::Message() << teeth << " teeth, " << length << " long");
      const Surface surface = comb(teeth, length);
      EXPECT_FALSE(is_convex_shape(surface));
    }
  }
  for (const int teeth : {5, 9}) {
    EXPECT_EQ(graph_topology(extract(comb(teeth, 10), {}, {}).skeleton).tips, teeth) << teeth;
  }
}

TEST(ConvexAxis, ABoxHasOneThatIsNormalToItsFaces) {
  for (const Vector3d& size :
       {Vector3d(1, 1, 1), Vector3d(1, 0.95, 0.9), Vector3d(1, 0.9, 0.8), Vector3d(1, 0.5, 0.5),
        Vector3d(1, 0.3, 0.1), Vector3d(1, 1, 0.5), Vector3d(1, 1, 0.1), Vector3d(1, 0.8, 0.1),
        Vector3d(1, 0.5, 0.05), Vector3d(1, 0.02, 0.02), Vector3d(1, 1, 0.02)}) {
    for (const int cells : {1, 5, 16}) {
      for (const Turn& turn : turns()) {
        SCOPED_TRACE(testing::Message()
                     << size.transpose() << ", cells " << cells << ", turned by " << turn.angle);
        const Surface box = shapes::box(size, cells).surface;
        const CurveSkeleton curve = curve_of_turned(box, turn);
        Eigen::Index axis = 0;
        curve.nodes.cwiseAbs().colwise().maxCoeff().maxCoeff(&axis);
        EXPECT_EQ(size[axis], size.maxCoeff());
        expect_line_through_middle(curve, Vector3d::Unit(axis), 0.5, size.norm());
      }
    }
  }
}

TEST(ConvexAxis, ARoundedBoxHasThatOfTheBox) {
  for (const Vector3d& size :
       {Vector3d(1, 1, 1), Vector3d(1, 0.5, 0.3), Vector3d(1, 1, 0.2), Vector3d(1, 0.3, 0.1)}) {
    for (const double exponent : {4.0, 8.0}) {
      for (const Turn& turn : turns()) {
        SCOPED_TRACE(testing::Message() << size.transpose() << ", exponent " << exponent);
        const CurveSkeleton curve = curve_of_turned(rounded_box(size, 15, exponent), turn);
        Eigen::Index axis = 0;
        curve.nodes.cwiseAbs().colwise().maxCoeff().maxCoeff(&axis);
        EXPECT_EQ(size[axis], 1);
        expect_line_through_middle(curve, Vector3d::Unit(axis), 0.5, size.norm());
      }
    }
  }
}

/// Of a rod along the middle; of a disc in its middle plane through the middle, straight.
TEST(ConvexAxis, APrismHasItsOwnOrAWidthOfItsMiddlePlane) {
  for (const int sides : {3, 4, 5, 6, 8, 32}) {
    for (const double height : {0.05, 0.3, 2.5, 10.0}) {
      for (const Turn& turn : turns()) {
        SCOPED_TRACE(testing::Message() << sides << " sides, height " << height);
        const Surface body = prism(sides, 0.5, height);
        const CurveSkeleton curve = curve_of_turned(body, turn);
        const double diagonal = bounding_box_diagonal(body.positions);
        if (height > 1) {
          // Twelve rays do not find the middle of five sides to the last bit.
          EXPECT_LT(off_line(curve, Vector3d::UnitZ()), 0.01 * 0.5);
          EXPECT_EQ(graph_topology(curve).tips, 2);
          const double half = curve.nodes.col(2).maxCoeff();
          EXPECT_NEAR(half, -curve.nodes.col(2).minCoeff(), 1e-3 * diagonal);
          EXPECT_GE(half, 0.499 * height / 2);
          continue;
        }
        EXPECT_EQ(graph_topology(curve).tips, 2);
        EXPECT_EQ(graph_topology(curve).junctions, 0);
        EXPECT_LT(curve.nodes.col(2).cwiseAbs().maxCoeff(), 1e-4 * diagonal);
        Eigen::Index far = 0;
        curve.nodes.rowwise().norm().maxCoeff(&far);
        const Vector3d along = curve.nodes.row(far).normalized();
        EXPECT_LT(off_line(curve, along), 1e-4 * diagonal);
        // On a mirror plane through the axis: multiples of half of a side's angle.
        if (sides == 32) continue;  // round
        const double parts = std::atan2(along.y(), along.x()) * sides / std::numbers::pi;
        EXPECT_NEAR(parts, std::round(parts), 1e-3);
      }
    }
  }
}

/// Half of the way is no axis, however many radii the ends are off.
TEST(ConvexAxis, AThinRodHasItFromEndToEnd) {
  for (const double ratio : {10.0, 40.0, 100.0, 200.0, 2000.0}) {
    for (const double taper : {1.0, 0.2}) {
      for (const Turn& turn : turns()) {
        SCOPED_TRACE(testing::Message() << ratio << " : 1, taper " << taper);
        const double radius = 0.5 / ratio;
        const Surface rod =
            shapes::tube("rod", shapes::straight(1), shapes::tapered(radius, taper * radius), 12)
                .surface;
        const CurveSkeleton curve = curve_of_turned(rod, turn);
        EXPECT_EQ(graph_topology(curve).tips, 2);
        EXPECT_LT(off_line(curve, Vector3d::UnitX()), 0.1 * radius);
        // A tip ends 1.15 radii before the surface, and no nearer than the curve's least spacing.
        const double margin = std::max(1.2 * radius, 1.0 / 400);
        EXPECT_LT(curve.nodes.col(0).minCoeff(), -0.5 + margin);
        EXPECT_GT(curve.nodes.col(0).maxCoeff(), 0.5 - margin);
      }
    }
  }
}

TEST(ConvexAxis, StarsThatBendOutwardsAtEachEdgeAreNotConvex) {
  for (const int turns : {2, 3}) EXPECT_FALSE(is_convex_shape(prism(7, 0.5, 1, turns))) << turns;
  EXPECT_TRUE(is_convex_shape(prism(7, 0.5, 1)));
}

TEST(ConvexAxis, NothingIsMadeOfTheCutOfAConvexBody) {
  const auto first_courses = [](const Surface& surface) {
    std::ptrdiff_t count = 0;
    for (const StageTime& stage : extract(surface, {}).times) {
      count += std::count_if(stage.steps.begin(), stage.steps.end(),
                             [](const StepTime& step) { return step.step == "first course"; });
    }
    return count;
  };
  EXPECT_EQ(first_courses(prism(6, 0.5, 1)), 0);
  EXPECT_EQ(first_courses(shapes::tube_union("Y", shapes::star(3, 0.5, 0.07)).surface), 1);
}

TEST(ConvexAxis, DentsAreNoLimbsAndLimbsAreNoDents) {
  EXPECT_TRUE(is_convex_shape(shapes::box({1, 1, 1}, 6).surface));
  EXPECT_TRUE(is_convex_shape(shapes::ellipsoid({1, 0.6, 0.3}, 4).surface));
  EXPECT_TRUE(is_convex_shape(shapes::cone(0.3, 1, 24).surface));
  EXPECT_TRUE(is_convex_shape(shapes::noisy(shapes::box({1, 1, 1}, 12), 0.003, 3).surface));
  for (const auto& [name, graph] :
       {std::pair{"H", shapes::letter_h(1, 0.6, 0.08)}, std::pair{"Y", shapes::star(3, 0.5, 0.07)},
        std::pair{"X", shapes::star(4, 0.5, 0.1)}}) {
    EXPECT_FALSE(is_convex_shape(shapes::tube_union(name, graph).surface)) << name;
  }
  EXPECT_FALSE(
      is_convex_shape(shapes::tube("bow", shapes::arc(1, 1), shapes::constant(0.05), 16).surface));
  // A horn on a ball, and a hollow in it.
  for (const double height : {0.4, 0.6, 1.0, -0.6}) {
    Surface ball = shapes::ellipsoid({1, 1, 1}, 5).surface;
    for (auto row : ball.positions.rowwise()) {
      row *= 1 + height * std::exp(-60 * (1 - row.z()));
    }
    EXPECT_FALSE(is_convex_shape(ball)) << height;
  }
}

}  // namespace
}  // namespace curveskel::convex_axis_laws
