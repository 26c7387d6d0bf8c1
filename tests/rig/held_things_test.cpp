// Laws of humans of several components: what they hold is no limb, and a head moves with its joint.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/read.hpp>
#include <curveskel/rig_polygons.hpp>
#include "tests/rig/plan_subjects.hpp"

namespace curveskel::held_thing_laws {
namespace {

using Eigen::RowVector3d;
using shapes::Shape;

Shape shape_of(Surface surface) {
  Shape shape;
  shape.surface = std::move(surface);
  return shape;
}

/// One leg ahead, so that left and right are no images. 20 high, looks along z, holds its hands,
/// at (+-3.8, 9.5, 2), apart from the hips.
RigSubject idle_human(bool has_head = true) {
  BodyCurve figure;
  const int hips = figure.add({0, 10, 0}, 1.4);
  const int chest = figure.add({0, 15, 0}, 1.5, hips);
  const int neck = figure.add({0, 17, 0}, 0.6, chest);
  if (has_head) figure.add({0, 18.6, 0}, 1.3, neck);
  for (const double side : {1.0, -1.0}) {
    int leg = hips;
    for (const RowVector3d& place :
         {RowVector3d(1.6, 9, 0), {1.8, 5, 0.4 + side}, {2, 0.6, side}, {2.2, 0.5, 2 + side}}) {
      leg = figure.add({side * place.x(), place.y(), place.z()}, 0.6, leg);
    }
    int arm = chest;
    for (const RowVector3d& place : {RowVector3d(2.2, 15, 0), {3.5, 12, -0.6}, {3.8, 9.5, 2}}) {
      arm = figure.add({side * place.x(), place.y(), place.z()}, 0.5, arm);
    }
  }
  return subject_of("idle human", figure);
}

Shape bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  const auto line = [=](double t) -> Eigen::Vector3d { return from + t * (to - from); };
  return shapes::tube("bar", line, shapes::constant(radius), 10);
}

struct Held {
  std::string name;
  std::vector<Shape> things;
};

/// Each touches a hand.
std::vector<Held> held_things() {
  const Shape staff = bar({4.5, 0.5, 2}, {4.5, 21, 2.5}, 0.3);
  const Shape sword = bar({-4.4, 9.5, 2}, {-4.6, 2, 6}, 0.25);
  const Shape axe = bar({-4.4, 9.5, 2}, {-5.6, 17, 5}, 0.3);
  const Shape shield = shapes::translated(shapes::box({0.6, 6, 6}, 10), {4.5, 10, 2});
  return {{"staff", {staff}},
          {"sword", {sword}},
          {"staff and sword", {staff, sword}},
          {"axe", {axe}},
          {"shield and sword", {shield, sword}}};
}

const PlannedJoint& joint_with(const BodyPlan& plan, const std::string& role) {
  static const PlannedJoint none;
  const PlannedJoint* joint = joint_of(plan, role);
  EXPECT_NE(joint, nullptr) << role;
  return joint == nullptr ? none : *joint;
}

TEST(HeldThings, AreNoLimbsWhetherAHumanIsAskedForOrNot) {
  const RigSubject human = idle_human();
  for (const Held& held : held_things()) {
    std::vector<Shape> all{shape_of(human.surface)};
    all.insert(all.end(), held.things.begin(), held.things.end());
    const PolygonSoup soup = soup_of(shapes::together("", all).surface);
    for (const BodyKind wanted : {BodyKind::automatic, BodyKind::humanoid}) {
      SCOPED_TRACE(held.name + (wanted == BodyKind::automatic ? "" : ", asked for"));
      RigPolygonsOptions options;
      options.character.plan.plan = wanted;
      const BodyPlan plan = rig_polygons(soup, {}, options).character.plan;
      ASSERT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
      EXPECT_TRUE(plan.missing.empty()) << plan.reason;
      for (const double side : {1.0, -1.0}) {
        const std::string name = side > 0 ? "left" : "right";
        const RowVector3d hand(side * 3.8, 9.5, 2);
        const RowVector3d foot(side * 2, 0.6, side);
        EXPECT_LT((joint_with(plan, name + "Hand").position - hand).norm(), 2.5) << plan.reason;
        EXPECT_LT((joint_with(plan, name + "Foot").position - foot).norm(), 1.5) << plan.reason;
      }
    }
  }
}

/// Vertices from `first` on that the joint moves alone.
Eigen::Index moved_alone(const Rig& rig, Eigen::Index first, const std::string& role) {
  const auto found = std::find(rig.roles.begin(), rig.roles.end(), role);
  const Eigen::Index joint = found - rig.roles.begin();
  Eigen::Index count = 0;
  for (Eigen::Index v = first; v < rig.weights.rows(); ++v) {
    count += rig.weights.coeff(v, joint) > 0.999F ? 1 : 0;
  }
  return count;
}

/// The body ends at the neck, so that the head's joint moves nothing of it.
TEST(HeldThings, AHeadThatIsAPartOfItsOwnMovesWithItsJoint) {
  const RigSubject body = idle_human(false);
  for (const double radius : {0.7, 1.3}) {
    SCOPED_TRACE(radius);
    const Shape head = bar({0, 18, 0}, {0, 18 + radius, 0}, radius);
    const Surface all = shapes::together("", {shape_of(body.surface), head}).surface;
    RigPolygonsOptions options;
    options.character.parts.follow = 10;
    const CharacterRig made = rig_polygons(soup_of(all), {}, options).character;
    ASSERT_EQ(made.plan.plan, BodyKind::humanoid) << made.plan.reason;
    EXPECT_EQ(moved_alone(made.rig, body.surface.positions.rows(), "head"),
              head.surface.positions.rows());
    EXPECT_EQ(moved_alone(made.rig, body.surface.positions.rows(), "neck"), 0);
  }
}

}  // namespace
}  // namespace curveskel::held_thing_laws
