// Laws of plans of bodies in a pose: left and right are no mirror images there.
#include <curveskel/body_plan.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "tests/rig/plan_subjects.hpp"

namespace curveskel::posed_body_laws {
namespace {

using Eigen::RowVector3d;

using Limb = std::vector<RowVector3d>;

/// Forwards about its first place, as seen from the left.
Limb swung(const Limb& limb, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  Limb result;
  for (const RowVector3d& place : limb) {
    const RowVector3d off = place - limb.front();
    result.emplace_back(place.x(),
                        limb.front().y() + std::cos(angle) * off.y() + std::sin(angle) * off.z(),
                        limb.front().z() - std::sin(angle) * off.y() + std::cos(angle) * off.z());
  }
  return result;
}

Limb mirrored(Limb limb) {
  for (RowVector3d& place : limb) place.x() *= -1;
  return limb;
}

void add_limb(BodyCurve& figure, int from, const Limb& limb, double radius) {
  int above = from;
  for (const RowVector3d& place : limb) above = figure.add(place, radius, above);
}

const Limb leg_of_human{{1.6, 9, 0}, {1.6, 5, 0}, {1.6, 0.6, 0}, {1.6, 0.5, 2}};
const Limb arm_of_human{{2.2, 15, 0}, {2.8, 11.5, 0}, {3.2, 8.5, 0}};

/// The left leg and the right arm ahead by so much, the others behind.
RigSubject striding_human(double degrees) {
  BodyCurve figure;
  const int hips = figure.add({0, 10, 0}, 1.4);
  const int chest = figure.add({0, 15, 0}, 1.5, hips);
  const int neck = figure.add({0, 16.8, 0}, 0.6, chest);
  figure.add({0, 18.6, 0}, 1.3, neck);
  add_limb(figure, hips, swung(leg_of_human, degrees), 0.6);
  add_limb(figure, hips, mirrored(swung(leg_of_human, -degrees)), 0.6);
  add_limb(figure, chest, swung(arm_of_human, -degrees), 0.5);
  add_limb(figure, chest, mirrored(swung(arm_of_human, 1.5 * degrees)), 0.5);
  return subject_of("striding human", figure);
}

/// In the limb that it belongs to, as far as its thickness goes.
void expect_in(const BodyPlan& plan, const std::string& role, const Limb& limb, double radius) {
  const PlannedJoint* joint = joint_of(plan, role);
  ASSERT_NE(joint, nullptr) << role;
  double least = 1e300;
  for (std::size_t k = 1; k < limb.size(); ++k) {
    const RowVector3d along = limb[k] - limb[k - 1];
    const double share =
        std::clamp((joint->position - limb[k - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (joint->position - limb[k - 1] - share * along).norm());
  }
  EXPECT_LT(least, radius) << role << " at " << joint->position;
}

std::set<std::string> roles_of(const BodyPlan& plan) {
  std::set<std::string> roles;
  for (const PlannedJoint& joint : plan.joints) roles.insert(joint.role);
  return roles;
}

TEST(PosedBodies, AStridingHumanHasTheJointsOfOneThatStands) {
  const RigSubject standing = striding_human(0);
  const std::set<std::string> roles = roles_of(find_plan(standing.surface, standing.skeleton));
  for (const double degrees : {15.0, 30.0, 40.0}) {
    SCOPED_TRACE(degrees);
    const RigSubject subject = striding_human(degrees);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
    EXPECT_TRUE(plan.missing.empty());
    EXPECT_EQ(roles_of(plan), roles);
    expect_near(plan, "hips", {0, 10, 0}, 1.2);
    expect_near(plan, "head", {0, 16.9, 0}, 0.8);
    expect_near(plan, "leftFoot", swung(leg_of_human, degrees)[2], 1.5);
    expect_near(plan, "rightFoot", mirrored(swung(leg_of_human, -degrees))[2], 1.5);
    expect_near(plan, "leftHand", swung(arm_of_human, -degrees)[2], 3);
    expect_near(plan, "rightHand", mirrored(swung(arm_of_human, 1.5 * degrees))[2], 3);
  }
}

struct Stride {
  double thigh;  // degrees ahead
  double knee;   // degrees that it is bent
};

/// The shin turned backwards about the knee.
Limb bent(const Stride& stride) {
  const Limb leg = swung(leg_of_human, stride.thigh);
  const Limb shin = swung({leg.begin() + 1, leg.end()}, -stride.knee);
  return {leg[0], shin[0], shin[1], shin[2]};
}

/// Looks along -z if it is turned.
RowVector3d placed(const RowVector3d& place, bool is_turned) {
  return is_turned ? RowVector3d(-place.x(), place.y(), -place.z()) : place;
}

/// The trunk leans ahead by so many degrees.
RigSubject bent_human(const Stride& left, const Stride& right, double lean, bool is_turned) {
  const Limb trunk = swung({{0, 10, 0}, {0, 15, 0}, {0, 16.8, 0}, {0, 18.6, 0}}, -lean);
  const auto put = [&](Limb limb, const RowVector3d& move) {
    for (RowVector3d& place : limb) place = placed(place + move, is_turned);
    return limb;
  };
  const RowVector3d still = RowVector3d::Zero();
  const RowVector3d of_chest = trunk[1] - RowVector3d(0, 15, 0);
  BodyCurve figure;
  const int hips = figure.add(placed(trunk[0], is_turned), 1.4);
  const int chest = figure.add(placed(trunk[1], is_turned), 1.5, hips);
  const int neck = figure.add(placed(trunk[2], is_turned), 0.6, chest);
  figure.add(placed(trunk[3], is_turned), 1.3, neck);
  add_limb(figure, hips, put(bent(left), still), 0.6);
  add_limb(figure, hips, put(mirrored(bent(right)), still), 0.6);
  add_limb(figure, chest, put(swung(arm_of_human, -30), of_chest), 0.5);
  add_limb(figure, chest, put(mirrored(swung(arm_of_human, 40)), of_chest), 0.5);
  return subject_of("bent human", figure);
}

/// Runs, kicks, kneels, steps down.
const std::vector<std::pair<Stride, Stride>> strides{
    {{40, 60}, {-20, 70}}, {{0, 0}, {60, 100}}, {{-10, 90}, {45, 45}}, {{20, 30}, {-30, 100}}};

/// A foot in the air tells nothing by where it lies.
TEST(PosedBodies, AHumanLooksWhereTheKneesBend) {
  for (const auto& [left, right] : strides) {
    for (const bool is_turned : {false, true}) {
      SCOPED_TRACE(std::to_string(left.thigh) + (is_turned ? " turned" : ""));
      const RigSubject subject = bent_human(left, right, 20, is_turned);
      const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
      EXPECT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
      expect_near(plan, "leftLowerLeg", placed(bent(left)[1], is_turned), 2);
      expect_near(plan, "rightLowerLeg", placed(mirrored(bent(right))[1], is_turned), 2);
    }
  }
}

/// Nor does its height, of which both legs have the mean, tell where its ankle is.
TEST(PosedBodies, ALiftedFootHasItsAnkleAboveItsOwnSole) {
  for (const auto& [left, right] : strides) {
    SCOPED_TRACE(left.thigh);
    const RigSubject subject = bent_human(left, right, 20, false);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    expect_near(plan, "leftFoot", bent(left)[2], 1);
    expect_near(plan, "rightFoot", mirrored(bent(right))[2], 1);
  }
}

TEST(PosedBodies, ATrunkThatLeansBackIsNoTail) {
  for (const double lean : {-32.0, -25.0, 32.0}) {
    for (const bool is_turned : {false, true}) {
      SCOPED_TRACE(lean);
      const RigSubject subject = bent_human({10, 10}, {25, 50}, lean, is_turned);
      const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
      EXPECT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
      expect_near(plan, "leftFoot", placed(bent({10, 10})[2], is_turned), 2);
    }
  }
}

const Limb hind_leg{{1.5, 6, -6.5}, {1.5, 3, -7.5}, {1.5, 0.5, -7}};
const Limb front_leg{{1.5, 6, 5}, {1.5, 3, 5}, {1.5, 0.5, 5}};

/// Its legs swung by so much, its head and tail to so far aside.
RigSubject beast_in_pose(const std::vector<double>& degrees, double aside) {
  BodyCurve figure;
  const int rump = figure.add({0, 8, -6}, 1.4);
  const int withers = figure.add({0, 8, 5}, 1.4, rump);
  const int neck = figure.add({0.5 * aside, 10.5, 8}, 0.8, withers);
  const int head = figure.add({aside, 11, 10.5}, 1, neck);
  figure.add({aside + 1.2, 12.8, 10.2}, 0.3, head);
  figure.add({aside - 1.2, 12.8, 10.2}, 0.3, head);
  figure.add({-aside, 7, -11}, 0.5, rump);
  add_limb(figure, rump, swung(hind_leg, degrees[0]), 0.5);
  add_limb(figure, rump, mirrored(swung(hind_leg, degrees[1])), 0.5);
  add_limb(figure, withers, swung(front_leg, degrees[2]), 0.5);
  add_limb(figure, withers, mirrored(swung(front_leg, degrees[3])), 0.5);
  return subject_of("beast in a pose", figure);
}

TEST(PosedBodies, AWalkingBeastIsAQuadrupedAndLooksAhead) {
  for (const double aside : {0.0, 2.0}) {
    SCOPED_TRACE(aside);
    const RigSubject subject = beast_in_pose({25, -25, -20, 20}, aside);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::quadruped) << plan.reason;
    for (const std::string role : {"shin", "foot"}) {
      expect_in(plan, "front_" + role + ".L", swung(front_leg, -20), 0.6);
      expect_in(plan, "front_" + role + ".R", mirrored(swung(front_leg, 20)), 0.6);
      expect_in(plan, role + ".L", swung(hind_leg, 25), 0.6);
      expect_in(plan, role + ".R", mirrored(swung(hind_leg, -25)), 0.6);
    }
    expect_near(plan, "head", {aside, 11, 10.5}, 3);
  }
}

/// In a gallop, and when it kicks.
TEST(PosedBodies, ABeastWithLiftedLegsIsAQuadruped) {
  const std::vector<std::vector<double>> poses{{-20, -40, 70, 50}, {-60, -45, 5, -10}};
  for (const std::vector<double>& degrees : poses) {
    SCOPED_TRACE(degrees.front());
    const RigSubject subject = beast_in_pose(degrees, 0.5);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::quadruped) << plan.reason;
    expect_in(plan, "front_foot.L", swung(front_leg, degrees[2]), 0.6);
    expect_in(plan, "foot.R", mirrored(swung(hind_leg, degrees[1])), 0.6);
  }
}

TEST(PosedBodies, ACrawlerOnEightLegsIsNoQuadruped) {
  for (const double swing : {0.0, 4.0}) {
    BodyCurve figure;
    const int rear = figure.add({0, 4, -5}, 1.5);
    int body = rear;
    for (int pair = 0; pair < 4; ++pair) {
      body = figure.add({0, 4, -4.0 + 2.5 * pair}, 1.2, body);
      const double z = -4.0 + 2.5 * pair;
      const Limb leg{{2, 4.6, z}, {5, 4.5, z}, {6.5, 0.5, z}};
      const double degrees = pair % 2 == 0 ? swing : -swing;
      add_limb(figure, body, swung(leg, degrees), 0.4);
      add_limb(figure, body, mirrored(swung(leg, -degrees)), 0.4);
    }
    figure.add({0, 4.5, 6.5}, 0.8, body);
    const RigSubject subject = subject_of("crawler", figure);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::other) << plan.reason;
  }
}

}  // namespace
}  // namespace curveskel::posed_body_laws
