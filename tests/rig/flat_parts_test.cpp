// Laws of bodies with flat parts: birds, people in capes.
#include <curveskel/body_plan.hpp>

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/rig_polygons.hpp>
#include "tests/rig/plan_subjects.hpp"

namespace curveskel::flat_parts_laws {
namespace {

struct BirdShape {
  double half_span = 10;  ///< of a body 17 long
  double sweep = 1.5;
  double lift = 0.5;       ///< of the tips
  double thickness = 0.1;  ///< of wings and tail, of their width
  bool has_legs = false;
  bool has_fin = false;  ///< as an aeroplane
};

constexpr int tail_node = 5;

BodyCurve curve_of(const BirdShape& shape) {
  BodyCurve figure;
  int trunk = figure.add({0, 6, 8}, 0.4);
  trunk = figure.add({0, 6, 5}, 0.7, trunk);
  const int chest = figure.add({0, 6, 2}, 1.4, trunk);
  const int belly = figure.add({0, 6, -1}, 1.3, chest);
  trunk = figure.add({0, 6, -4}, 0.8, belly);
  const int tail = figure.add({0, 6, -8}, 1.2, trunk);
  EXPECT_EQ(tail, tail_node);
  const double middle = 0.5 * shape.half_span;
  figure.add_pair(chest,
                  {{2.2, 6, 2},
                   {middle, 6 + 0.5 * shape.lift, 2 - 0.3 * shape.sweep},
                   {shape.half_span, 6 + shape.lift, 2 - shape.sweep}},
                  1.2);
  if (shape.has_legs) figure.add_pair(belly, {{0.9, 4, -1}, {0.9, 2, -0.5}, {0.9, 0.5, 0}}, 0.35);
  if (shape.has_fin) figure.add({0, 12, -9}, 1.2, tail);
  return figure;
}

/// Of the wings beyond the trunk, and of the tail, by which part of their thickness they are left.
double left_of(const BirdShape& shape, const Eigen::RowVector3d& place) {
  const double out = std::max((std::abs(place.x()) - 1.6) / 1.4, (-place.z() - 4.5) / 2);
  return std::clamp(1 - out, shape.thickness, 1.0);
}

RigSubject bird(const BirdShape& shape) {
  RigSubject subject = subject_of("bird", curve_of(shape));
  CurveSkeleton& curve = subject.skeleton;
  for (Eigen::Index v = 0; v < subject.surface.positions.rows(); ++v) {
    Eigen::RowVector3d place = subject.surface.positions.row(v);
    const double left = left_of(shape, place);
    if (place.y() > 7.6 && std::abs(place.x()) < 1.5) {
      place.x() *= left;  // a fin
    } else if (place.y() > 4.4) {
      const double share = std::clamp(std::abs(place.x()) / shape.half_span, 0.0, 1.0);
      const double middle = 6 + shape.lift * share;
      place.y() = middle + left * (place.y() - middle);
    }
    subject.surface.positions.row(v) = place;
  }
  for (Eigen::Index node = 0; node < curve.nodes.rows(); ++node) {
    if (curve.nodes(node, 1) > 4.4) curve.radii[node] *= left_of(shape, curve.nodes.row(node));
  }
  return subject;
}

PlanOptions not_of_tubes() {
  PlanOptions options;
  options.made_of_tubes = false;
  return options;
}

TEST(FlatWings, MakeABirdWithLegsOrWithout) {
  for (const double half_span : {8.0, 16.0}) {
    for (const double lift : {-1.0, 4.0}) {
      for (const bool has_legs : {false, true}) {
        SCOPED_TRACE(std::to_string(half_span) + " " + std::to_string(lift) +
                     (has_legs ? " with legs" : ""));
        const RigSubject subject =
            bird({.half_span = half_span, .lift = lift, .has_legs = has_legs});
        for (const PlanOptions& options : {PlanOptions{}, not_of_tubes()}) {
          const BodyPlan plan = find_plan(subject.surface, subject.skeleton, options);
          ASSERT_EQ(plan.plan, BodyKind::bird) << plan.reason;
          expect_near(plan, "chest", {0, 6, 2}, 1.5);
          EXPECT_GT(joint_of(plan, "head")->position.z(), 4);
          EXPECT_LT(joint_of(plan, "spine")->position.z(), 0.5);
          EXPECT_LT(joint_of(plan, "tail.003")->position.z(), -4);
          EXPECT_GT(joint_of(plan, "upper_arm.L")->position.x(), 0.5);
          EXPECT_EQ(joint_of(plan, "thigh.R") != nullptr, has_legs);
        }
      }
    }
  }
}

TEST(FlatWings, TailsTellTheFront) {
  for (const double sweep : {-2.0, 0.0, 2.0}) {
    RigSubject subject = bird({.sweep = sweep});
    const Eigen::RowVector3d back(-1, 1, -1);
    subject.surface.positions.array().rowwise() *= back.array();
    subject.skeleton.nodes.array().rowwise() *= back.array();
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton, not_of_tubes());
    ASSERT_EQ(plan.plan, BodyKind::bird) << plan.reason;
    EXPECT_EQ(plan.axes(2, 2), -1);
    EXPECT_LT(joint_of(plan, "head")->position.z(), -4);
  }
}

/// Files whose z is up, or in which it looks along x.
TEST(FlatWings, AreSeenFromAnySide) {
  using Eigen::Vector3d;
  const RigSubject subject = bird({});
  for (const Eigen::Matrix3d& axes :
       {frame(Vector3d::UnitZ(), -Vector3d::UnitY()), frame(Vector3d::UnitZ(), Vector3d::UnitX()),
        frame(Vector3d::UnitY(), -Vector3d::UnitX())}) {
    const RigSubject turned = standing_in(subject, axes);
    for (const PlanOptions& options : {PlanOptions{}, not_of_tubes()}) {
      const BodyPlan plan = find_plan(turned.surface, turned.skeleton, options);
      ASSERT_EQ(plan.plan, BodyKind::bird) << plan.reason;
      EXPECT_TRUE(plan.axes.isApprox(axes, 1e-9)) << plan.axes;
    }
  }
}

/// A fin stands on an aeroplane; and arms of a thing that is not made of tubes may be anything.
TEST(FlatWings, AnAeroplaneIsNoBird) {
  for (const double half_span : {8.0, 16.0}) {
    const RigSubject plane = bird({.half_span = half_span, .has_fin = true});
    const RigSubject round = bird({.half_span = half_span, .thickness = 1});
    for (const RigSubject* const subject : {&plane, &round}) {
      const BodyPlan plan = find_plan(subject->surface, subject->skeleton, not_of_tubes());
      EXPECT_EQ(plan.plan, BodyKind::other) << plan.reason;
      EXPECT_TRUE(plan.joints.empty());
    }
    EXPECT_NE(find_plan(plane.surface, plane.skeleton).plan, BodyKind::bird);
  }
}

/// By the curve that the program makes, and its own certificate.
TEST(FlatWings, OfAFileAreRigged) {
  for (const bool has_legs : {false, true}) {
    const RigSubject subject = bird({.half_span = 18, .thickness = 0.06, .has_legs = has_legs});
    const PolygonsRig found = rig_polygons(soup_of(subject.surface));
    ASSERT_EQ(found.character.plan.plan, BodyKind::bird) << found.character.plan.reason;
    ASSERT_TRUE(found.certificate);
    EXPECT_LT(found.certificate->tube_share, tube_share_needed);
  }
}

/// A component of its own, of more area than the body's.
RigSubject human_in_cape() {
  BodyCurve figure;
  const int chest = add_body_without_arms(figure);
  figure.add_pair(chest, {{2.2, 15, 0}, {5.5, 15, 0}, {8.5, 15, 0}}, 0.5);
  figure.add({0, 14, -7}, 3, figure.add({0, 4, -7}, 3));
  RigSubject subject = subject_of("cape", figure);
  const auto flatten = [](double& z) { z = z < -3 ? -2.5 + 0.03 * (z + 7) : z; };
  for (double& z : subject.surface.positions.col(2)) flatten(z);
  for (Eigen::Index node = 0; node < subject.skeleton.nodes.rows(); ++node) {
    double& z = subject.skeleton.nodes(node, 2);
    if (z < -3) subject.skeleton.radii[node] *= 0.03;
    flatten(z);
  }
  return subject;
}

TEST(FlatParts, ACapeHidesNoHuman) {
  const RigSubject dressed = human_in_cape();
  const BodyPlan plan = find_plan(dressed.surface, dressed.skeleton, not_of_tubes());
  ASSERT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
  expect_near(plan, "leftHand", {7, 15, 0}, 1.5);
  EXPECT_NE(joint_of(plan, "rightFoot"), nullptr);
}

TEST(FlatParts, AFlatHumanIsNone) {
  RigSubject drawing = human();
  drawing.surface.positions.col(2) *= 0.05;
  drawing.skeleton.nodes.col(2) *= 0.05;
  drawing.skeleton.radii *= 0.05;
  EXPECT_EQ(find_plan(drawing.surface, drawing.skeleton, not_of_tubes()).plan, BodyKind::other);
}

}  // namespace
}  // namespace curveskel::flat_parts_laws
