// Laws of what is body and what follows it.
#include <curveskel/rig_parts.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/topology.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::parts_laws {
namespace {

using shapes::Shape;

/// A body of radius 1 and length 12 along x (the first component), then what else there is.
std::vector<Shape> with_body(std::vector<Shape> others) {
  others.insert(others.begin(), shapes::tube("", shapes::straight(12), shapes::constant(1), 16));
  return others;
}

Shape ball_at(double radius, const Eigen::Vector3d& middle) {
  return shapes::translated(shapes::ellipsoid({radius, radius, radius}, 2), middle);
}

/// A rod that begins in the body's middle and reaches `length` out of its axis.
Shape limb_at(double x, double length, double radius) {
  Shape rod = shapes::tube("", shapes::straight(length), shapes::constant(radius), 12);
  const Eigen::RowVector3d low = rod.surface.positions.colwise().minCoeff();
  const Eigen::RowVector3d high = rod.surface.positions.colwise().maxCoeff();
  rod = shapes::translated(rod, -0.5 * (low + high).transpose());
  Eigen::Index along = 0;
  (high - low).maxCoeff(&along);
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(along);
  if (along != 2) {
    rod = shapes::rotated(rod, axis.cross(Eigen::Vector3d::UnitZ()), std::acos(0.0));
  }
  return shapes::translated(rod, {x, 0, 0.5 * length});
}

/// The body lies along x, from its own middle.
Shape together(std::vector<Shape> parts) {
  Shape& body = parts.front();
  const Eigen::RowVector3d low = body.surface.positions.colwise().minCoeff();
  const Eigen::RowVector3d high = body.surface.positions.colwise().maxCoeff();
  body = shapes::translated(body, -0.5 * (low + high).transpose());
  Eigen::Index along = 0;
  (high - low).maxCoeff(&along);
  if (along != 0) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(along);
    body = shapes::rotated(body, axis.cross(Eigen::Vector3d::UnitX()), std::acos(0.0));
  }
  return shapes::together("", parts);
}

TEST(FindParts, ButtonsFollowAndLimbsDoNot) {
  const Shape shape = together(with_body({ball_at(0.2, {1, 0, 1}), ball_at(0.4, {-3, 1, 0}),
                                          limb_at(3, 5, 0.5), limb_at(-3, 4, 0.4)}));
  const RigParts found = find_parts(shape.surface);
  ASSERT_EQ(found.parts.size(), 5U);
  const std::vector<bool> follows{false, true, true, false, false};
  for (std::size_t c = 0; c < follows.size(); ++c) {
    EXPECT_EQ(found.parts[c].follows, follows[c]) << c << " reach " << found.parts[c].reach;
    EXPECT_EQ(found.parts[c].host, follows[c] ? 0 : -1) << c;
  }
  EXPECT_FALSE(found.all_body());
}

// No inscribed ball is about the rim of a flat end: a robot's rivets had joints of their own.
TEST(FindParts, RivetsOnARimFollow) {
  for (const double x : {-6.0, 6.0}) {
    for (const double z : {-1.0, 1.0}) {
      const Shape shape = together(with_body({ball_at(0.05, {x, 0, z})}));
      const RigParts found = find_parts(shape.surface);
      EXPECT_TRUE(found.parts[1].follows) << x << " " << z << " " << found.parts[1].reach;
      EXPECT_LT(found.parts[1].reach, 0.2);
    }
  }
}

TEST(FindParts, ReachIsInRadiiOfTheBody) {
  for (const double scale : {0.01, 1.0, 300.0}) {
    for (const double out : {0.3, 0.8, 2.0, 4.0}) {  // the farthest place, from the body's surface
      const Shape shape =
          shapes::scaled(together(with_body({ball_at(0.2, {1, 0, 1 + out - 0.2})})), scale);
      const RigParts found = find_parts(shape.surface, {10, 1});
      EXPECT_NEAR(found.parts[1].reach, out, 0.15 * out) << out << " at " << scale;
      EXPECT_EQ(find_parts(shape.surface).parts[1].follows, out < 1) << out;
    }
  }
}

TEST(FindParts, IsTheSameHoweverTheSurfaceLies) {
  const Shape shape = together(with_body({ball_at(0.3, {1, 0, 1}), limb_at(3, 5, 0.5)}));
  const RigParts at_rest = find_parts(shape.surface);
  for (const double angle : {0.4, 1.3, 2.9}) {
    const RigParts turned = find_parts(shapes::rotated(shape, {1, 2, 3}, angle).surface);
    for (std::size_t c = 0; c < at_rest.parts.size(); ++c) {
      EXPECT_EQ(turned.parts[c].follows, at_rest.parts[c].follows);
      EXPECT_NEAR(turned.parts[c].reach, at_rest.parts[c].reach, 0.02 * at_rest.parts[c].reach);
    }
  }
}

TEST(FindParts, MirrorImagesDecideTogether) {
  // One reaches .08 farther than the limit and the other .08 less.
  const Shape shape = together(with_body(
      {ball_at(0.2, {-2, 1.95, 0}), ball_at(0.2, {-2, -1.87, 0}), ball_at(0.2, {3, 0, 4})}));
  const RigParts found = find_parts(shape.surface, {1.11, 1});
  EXPECT_EQ(found.parts[1].twin, 2);
  EXPECT_EQ(found.parts[2].twin, 1);
  EXPECT_EQ(found.parts[3].twin, -1);
  EXPECT_NE(found.parts[1].reach < 1.11, found.parts[2].reach < 1.11);
  EXPECT_EQ(found.parts[1].follows, found.parts[2].follows);
  EXPECT_FALSE(found.parts[3].follows);
}

/// Trunk, head in a hat, arms and legs as games have them, of boxes; arms and legs are one box.
std::vector<Shape> block_figure() {
  const auto box_at = [](const Eigen::Vector3d& size, const Eigen::Vector3d& middle) {
    Shape box = shapes::box(size, 1);
    const Eigen::RowVector3d low = box.surface.positions.colwise().minCoeff();
    const Eigen::RowVector3d high = box.surface.positions.colwise().maxCoeff();
    return shapes::translated(box, middle - 0.5 * (low + high).transpose());
  };
  std::vector<Shape> figure{box_at({8, 12, 4}, {0, 18, 0}), box_at({9, 9, 9}, {0, 28.1, 0})};
  for (const double side : {1.0, -1.0}) {
    figure.push_back(box_at({4, 12, 4}, {2.1 * side, 5.9, 0}));
    figure.push_back(box_at({4, 12, 4}, {6.1 * side, 18, 0}));
  }
  return figure;
}

// Arms followed a trunk beside which only the head was thick, unless a leg came before them.
TEST(FindParts, DoesNotDependOnTheOrderOfEquals) {
  const std::vector<Shape> figure = block_figure();
  std::vector<std::size_t> order{0, 1, 2, 3, 4, 5};
  do {
    std::vector<Shape> parts;
    parts.reserve(order.size());
    for (const std::size_t part : order) parts.push_back(figure[part]);
    const RigParts found = find_parts(shapes::together("", parts).surface);
    ASSERT_EQ(found.parts.size(), parts.size());
    EXPECT_TRUE(found.all_body()) << testing::PrintToString(order);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(FindParts, ZeroGivesAllJoints) {
  const Shape shape = together(with_body({ball_at(0.2, {1, 0, 1})}));
  EXPECT_TRUE(find_parts(shape.surface, {0, 1}).all_body());
  EXPECT_THROW((void)find_parts(shape.surface, {-1, 1}), Error);
}

TEST(FindParts, DoesNotDependOnThreads) {
  constexpr int balls = 30;
  std::vector<Shape> many;
  many.reserve(balls);
  for (int k = 0; k < balls; ++k) {
    many.push_back(ball_at(0.1 + 0.01 * k, {0.35 * k - 5, std::sin(k), 1 + std::cos(k)}));
  }
  const Shape shape = together(with_body(std::move(many)));
  const RigParts one = find_parts(shape.surface, {1.15, 1});
  const RigParts two = find_parts(shape.surface, {1.15, 3});
  for (std::size_t c = 0; c < one.parts.size(); ++c) {
    EXPECT_EQ(one.parts[c].reach, two.parts[c].reach);
    EXPECT_EQ(one.parts[c].follows, two.parts[c].follows);
  }
}

TEST(BodyOf, LeavesOutWhatFollows) {
  const Shape shape = together(with_body({ball_at(0.2, {1, 0, 1}), limb_at(3, 5, 0.5)}));
  const RepairedSurface repaired = repair(soup_of(shape.surface), {}, {});
  const RigParts found = find_parts(repaired.surface);
  const RepairedSurface body = body_of(repaired, found);
  EXPECT_EQ(topology(body.surface).components(), 2);
  for (Eigen::Index v = 0; v < repaired.vertex_of_input.size(); ++v) {
    const int before = repaired.vertex_of_input[v];
    const int after = body.vertex_of_input[v];
    ASSERT_GE(before, 0);
    const bool follows =
        found.parts[static_cast<std::size_t>(found.part_of_vertex[before])].follows;
    ASSERT_EQ(after < 0, follows);
    if (follows) continue;
    EXPECT_EQ(body.surface.positions.row(after), repaired.surface.positions.row(before));
  }
}

}  // namespace
}  // namespace curveskel::parts_laws
