// Laws of humans who are asked for and whose limbs the curve does not show: robes, crossed arms,
// armour of plates.
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/extract_repaired.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rig_character.hpp>
#include "tests/rig/plan_subjects.hpp"
#include "tests/soups.hpp"

namespace curveskel::hidden_limb_laws {
namespace {

using Eigen::RowVector3d;

PlanOptions humanoid() {
  PlanOptions options;
  options.plan = BodyKind::humanoid;
  return options;
}

BodyPlan asked_for(const RigSubject& subject) {
  return find_plan(subject.surface, subject.skeleton, humanoid());
}

bool is_by_proportion(const BodyPlan& plan, const std::string& role) {
  const PlannedJoint* joint = joint_of(plan, role);
  return joint != nullptr && joint->reason.starts_with("by proportion");
}

void expect_hidden(const BodyPlan& plan, bool legs, bool arms) {
  ASSERT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
  EXPECT_TRUE(plan.missing.empty());
  EXPECT_EQ(plan.by_proportion, legs || arms) << plan.reason;
  for (const std::string side : {"left", "right"}) {
    for (const char* role : {"UpperLeg", "LowerLeg", "Foot", "Toes"}) {
      EXPECT_EQ(is_by_proportion(plan, side + role), legs) << side << role;
    }
    for (const char* role : {"UpperArm", "LowerArm", "Hand"}) {
      EXPECT_EQ(is_by_proportion(plan, side + role), arms) << side << role;
    }
  }
  const std::string hidden = legs && arms ? "legs and arms are" : legs ? "legs are" : "arms are";
  EXPECT_NE(plan.reason.find(hidden + " not seen"), std::string::npos) << plan.reason;
}

void expect_alike_on_both_sides(const BodyPlan& plan) {
  for (const PlannedJoint& joint : plan.joints) {
    if (!joint.role.starts_with("left")) continue;
    const PlannedJoint* other = joint_of(plan, "right" + joint.role.substr(4));
    ASSERT_NE(other, nullptr) << joint.role;
    const Eigen::Vector3d one = plan.axes * joint.position.transpose();
    const Eigen::Vector3d two = plan.axes * other->position.transpose();
    EXPECT_NEAR(one.y(), two.y(), 1e-9) << joint.role;
    EXPECT_NEAR(one.z(), two.z(), 1e-9) << joint.role;
    EXPECT_GE(one.x(), two.x()) << joint.role;
  }
}

void expect_inside(const BodyPlan& plan, const Surface& surface) {
  const SurfaceTree tree(surface);
  for (const PlannedJoint& joint : plan.joints) {
    if (is_by_proportion(plan, joint.role)) {
      EXPECT_TRUE(tree.inside(joint.position.transpose())) << joint.role << " " << joint.position;
    }
  }
}

/// 20 high and looking along z, in a robe that widens to the ground.
int add_robe(BodyCurve& figure, double hem) {
  const int ground = figure.add({0, hem, 0}, hem);
  const int waist = figure.add({0, 11, 0}, 1.5, ground);
  const int chest = figure.add({0, 15, 0}, 1.5, waist);
  figure.add({0, 18.6, 0}, 1.3, figure.add({0, 16.8, 0}, 0.6, chest));
  return chest;
}

RigSubject robed(double hem, bool shows_arms) {
  BodyCurve figure;
  const int chest = add_robe(figure, hem);
  if (shows_arms) figure.add_pair(chest, {{2.2, 15, 0}, {5.5, 15, 0}, {8.5, 15, 0}}, 0.5);
  return subject_of("robed", figure);
}

TEST(HiddenLimbs, ARobeHidesLegs) {
  for (const double hem : {2.0, 2.6, 3.4}) {
    SCOPED_TRACE(hem);
    const RigSubject subject = robed(hem, true);
    EXPECT_EQ(find_plan(subject.surface, subject.skeleton).plan, BodyKind::other);
    const BodyPlan plan = asked_for(subject);
    expect_hidden(plan, true, false);
    expect_alike_on_both_sides(plan);
    expect_inside(plan, subject.surface);
    const double hips = 0.648 * joint_of(plan, "leftUpperArm")->position.y();
    expect_near(plan, "leftUpperLeg", {1, hips, 0}, 0.6);
    expect_near(plan, "leftLowerLeg", {1, 0.56 * hips, 0.2}, 0.6);
    expect_near(plan, "rightFoot", {-1, 0.115 * hips, -0.2}, 0.6);
    expect_near(plan, "hips", {0, hips, 0}, 0.4);
    EXPECT_GT(joint_of(plan, "leftToes")->position.z(), joint_of(plan, "leftFoot")->position.z());
  }
}

/// The arms are those of the same body with legs.
TEST(HiddenLimbs, SeenArmsStayWhereTheyAre) {
  const BodyPlan whole = [] {
    const RigSubject subject = human();
    return find_plan(subject.surface, subject.skeleton);
  }();
  const BodyPlan plan = asked_for(robed(2.6, true));
  for (const char* role : {"leftUpperArm", "rightLowerArm", "leftHand", "rightHand", "head"}) {
    expect_near(plan, role, joint_of(whole, role)->position, 0.4);
  }
}

TEST(HiddenLimbs, ABodyWithoutAnyLimbHasAllByProportion) {
  for (const double hem : {1.6, 2.6}) {
    SCOPED_TRACE(hem);
    const RigSubject subject = robed(hem, false);
    const BodyPlan plan = asked_for(subject);
    expect_hidden(plan, true, true);
    expect_alike_on_both_sides(plan);
    expect_inside(plan, subject.surface);
    EXPECT_NEAR(joint_of(plan, "leftUpperArm")->position.y(), 0.79 * 19.9, 1);
    EXPECT_GT(joint_of(plan, "leftHand")->position.y(),
              joint_of(plan, "leftLowerLeg")->position.y());
    EXPECT_LT(joint_of(plan, "leftHand")->position.y(),
              joint_of(plan, "leftLowerArm")->position.y());
  }
}

// All its limbs were made up, far from those that the curve has.
TEST(HiddenLimbs, ADollThatSitsKeepsItsLimbs) {
  const RigSubject subject = sitting_doll();
  PlanOptions options = humanoid();
  options.front = Direction::z;  // feet without toes do not say it
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton, options);
  ASSERT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
  EXPECT_EQ(plan.reason.find("not seen"), std::string::npos) << plan.reason;
  EXPECT_FALSE(is_by_proportion(plan, "leftUpperLeg"));
  EXPECT_FALSE(is_by_proportion(plan, "leftUpperArm"));
  expect_near(plan, "leftLowerLeg", {2, 1, 3.5}, 1);
  expect_near(plan, "leftLowerArm", {3.6, 4.4, 0.5}, 1);
  expect_alike_on_both_sides(plan);
}

/// Legs that are seen are those of the same body with arms. No arms are: none at all, braids,
/// stubs.
TEST(HiddenLimbs, WhatIsNoWholeArmIsNone) {
  const BodyPlan whole = [] {
    const RigSubject subject = human();
    return find_plan(subject.surface, subject.skeleton);
  }();
  const auto nothing = [](BodyCurve&, int) {};
  const auto stumps = [](BodyCurve& figure, int chest) {
    figure.add_pair(chest, {{2.2, 15, 0}, {2.8, 15, 0}}, 0.5);
  };
  const std::vector<std::function<void(BodyCurve&, int)>> all{nothing, stumps};
  for (std::size_t k = 0; k < all.size(); ++k) {
    SCOPED_TRACE(k);
    BodyCurve figure;
    all[k](figure, add_body_without_arms(figure));
    const RigSubject subject = subject_of("no arms", figure);
    const BodyPlan plan = asked_for(subject);
    expect_hidden(plan, false, true);
    expect_alike_on_both_sides(plan);
    for (const char* role : {"leftUpperLeg", "rightLowerLeg", "leftFoot"}) {
      expect_near(plan, role, joint_of(whole, role)->position, 0.3);
    }
  }
}

/// Hands on hips make cycles, which are cut somewhere; braids hang from the head.
TEST(HiddenLimbs, CutCyclesAndBraidsAreNoArms) {
  for (const bool braids : {true, false}) {
    SCOPED_TRACE(braids);
    BodyCurve figure;
    const int chest = add_robe(figure, 2.6);
    const int head = static_cast<int>(figure.places.size()) - 1;
    if (braids) figure.add_pair(head, {{2, 18.6, 0}, {4, 17, 0}, {5, 14, 0}, {5, 12, 0}}, 0.3);
    for (const double side : {1.0, -1.0}) {
      if (braids) continue;
      int arm = chest;
      for (const double y : {15.0, 12.5}) arm = figure.add({side * 3.4, y, 0}, 0.5, arm);
      figure.edges.emplace_back(arm, 1);
    }
    const RigSubject subject = subject_of("no arms", figure);
    expect_hidden(asked_for(subject), true, true);
  }
}

/// Elbows are all that the curve shows of them. Beside these hips is no room for hands.
TEST(HiddenLimbs, CrossedArmsAreFoldedAheadOfTheBody) {
  BodyCurve figure;
  const int chest = add_body_without_arms(figure);
  figure.add({0, 13.2, 1.6}, 0.9, chest);
  figure.add_pair(chest, {{1.9, 14.8, 0}, {2.1, 13.5, 0.4}}, 0.6);
  const RigSubject subject = subject_of("crossed arms", figure);
  const BodyPlan plan = asked_for(subject);
  expect_hidden(plan, false, true);
  expect_alike_on_both_sides(plan);
  expect_inside(plan, subject.surface);
  const RowVector3d elbow = joint_of(plan, "leftLowerArm")->position;
  const RowVector3d wrist = joint_of(plan, "leftHand")->position;
  EXPECT_GT(wrist.z(), elbow.z() + 0.3);
  EXPECT_LT(wrist.x(), elbow.x() - 0.5);
  EXPECT_NEAR(wrist.y(), elbow.y(), 0.1);
}

TEST(HiddenLimbs, StandInAnyFrameAndSize) {
  using Eigen::Vector3d;
  const RigSubject subject = robed(2.6, true);
  const BodyPlan usual = asked_for(subject);
  for (const Eigen::Matrix3d& axes :
       {frame(Vector3d::UnitZ(), -Vector3d::UnitY()), frame(Vector3d::UnitY(), Vector3d::UnitX()),
        Eigen::Matrix3d(3e-4 * Eigen::Matrix3d::Identity())}) {
    RigSubject turned = standing_in(subject, axes);
    turned.skeleton.radii *= axes.row(0).norm();
    const BodyPlan plan = asked_for(turned);
    ASSERT_EQ(plan.joints.size(), usual.joints.size()) << plan.reason;
    for (const PlannedJoint& joint : usual.joints) {
      expect_near(plan, joint.role, joint.position * axes, 0.05 * axes.row(0).norm());
    }
  }
  PlanOptions options = humanoid();
  options.front = Direction::minus_z;
  const BodyPlan back = find_plan(subject.surface, subject.skeleton, options);
  EXPECT_LT(joint_of(back, "leftUpperLeg")->position.x(), 0);
  EXPECT_LT(joint_of(back, "leftToes")->position.z(), joint_of(back, "leftFoot")->position.z());
}

/// Of what is not asked for nothing is by proportion, nor of what lies.
TEST(HiddenLimbs, AreLeftAloneUnlessAHumanIsAskedFor) {
  const RigSubject subject = robed(2.6, true);
  for (const BodyKind kind : {BodyKind::automatic, BodyKind::quadruped, BodyKind::bird,
                              BodyKind::tailed_biped, BodyKind::other}) {
    PlanOptions options;
    options.plan = kind;
    const BodyPlan with = find_plan(subject.surface, subject.skeleton, options);
    options.by_proportion = false;
    const BodyPlan without = find_plan(subject.surface, subject.skeleton, options);
    EXPECT_EQ(with.plan, without.plan);
    EXPECT_EQ(with.reason, without.reason);
    EXPECT_EQ(with.joints.size(), without.joints.size());
    EXPECT_FALSE(with.by_proportion);
  }
  const RigSubject whole = human();
  const BodyPlan asked = asked_for(whole);
  EXPECT_FALSE(asked.by_proportion);
  EXPECT_EQ(asked.reason, find_plan(whole.surface, whole.skeleton).reason);
  const RigSubject lying = snake();
  const BodyPlan plan = asked_for(lying);
  EXPECT_EQ(plan.plan, BodyKind::other);
  EXPECT_NE(plan.reason.find("not upright"), std::string::npos) << plan.reason;
  EXPECT_TRUE(asked_for(tree()).by_proportion);  // whoever says so has it
}

double share_of(const Rig& rig, Eigen::Index vertex, const std::set<std::string>& roles) {
  double share = 0;
  for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
    if (roles.count(rig.roles[idx(static_cast<int>(it.col()))]) > 0)
      share += static_cast<double>(it.value());
  }
  return share;
}

/// Each half follows its own leg, with a soft passage between them.
TEST(HiddenLimbs, ARobesHalvesFollowTheirLegs) {
  const std::set<std::string> left{"leftUpperLeg", "leftLowerLeg", "leftFoot", "leftToes"};
  const std::set<std::string> right{"rightUpperLeg", "rightLowerLeg", "rightFoot", "rightToes"};
  for (const bool shows_arms : {true, false}) {
    const RigSubject subject = robed(2.6, shows_arms);
    const BodyPlan plan = asked_for(subject);
    const Rig rig = make_planned_rig(subject.surface, subject.skeleton, plan);
    const double knees = joint_of(plan, "leftLowerLeg")->position.y();
    for (Eigen::Index v = 0; v < rig.weights.rows(); ++v) {
      ASSERT_NEAR(rig.weights.row(v).sum(), 1, 1e-5);
      const RowVector3d place = subject.surface.positions.row(v);
      if (place.y() > knees) continue;
      const double own = share_of(rig, v, place.x() > 0 ? left : right);
      const double other = share_of(rig, v, place.x() > 0 ? right : left);
      EXPECT_GT(own + other, 0.9) << place;
      EXPECT_GE(own, other - 0.1) << place;
      if (std::abs(place.x()) > 1.5) {
        EXPECT_GT(own, 0.8) << place;
      }
      if (std::abs(place.x()) < 0.2 && place.y() > 1) {
        EXPECT_LT(own - other, 0.6) << place;
      }
    }
    for (std::size_t joint = plan.joints.size(); joint < rig.names.size(); ++joint) {
      EXPECT_NE(rig.names[joint].find("_end"), std::string::npos) << rig.names[joint];
    }
  }
}

/// Plates before and behind a human 20 high whose arms are held out or hang. They touch nowhere.
shapes::Shape armour(bool holds_out) {
  std::vector<shapes::Shape> plates;
  const auto add = [&](double width, double height, double depth, const Eigen::Vector3d& middle) {
    for (const double side : {1.0, -1.0}) {
      plates.push_back(shapes::translated(shapes::box({width, height, 0.2}, 3),
                                          middle + Eigen::Vector3d(0, 0, 0.5 * side * depth)));
    }
  };
  add(2.2, 2.6, 2.4, {0, 18.6, 0});  // helmet
  add(4.4, 4, 2, {0, 14, 0});
  add(3.6, 1.4, 2, {0, 11, 0});
  for (const double side : {1.0, -1.0}) {
    for (const double far : {1.0, 4.0, 7.0}) {
      if (holds_out) add(2.4, 1, 1, {side * (2.4 + far), 15.2, 0});
      if (!holds_out) add(1, 2.4, 1, {side * 2.9, 15.4 - far, 0});
    }
    add(1.4, 4, 1.6, {side, 7.8, 0});
    add(1.2, 4, 1.4, {side, 3.2, 0});
    add(1.2, 0.8, 2.4, {side, 0.4, 0.4});
  }
  return shapes::together("armour", plates);
}

TEST(HiddenLimbs, AnArmourOfPlatesIsOneHuman) {
  for (const bool holds_out : {true, false}) {
    SCOPED_TRACE(holds_out);
    const shapes::Shape shape = armour(holds_out);
    const RepairedSurface repaired = repair(soup_of(shape.surface));
    const CurveSkeleton skeleton =
        extract_repaired(repaired, RepairOptions{}, ExtractOptions{}).extraction.skeleton;
    CharacterOptions options;
    options.plan.plan = BodyKind::humanoid;
    const CharacterRig made = rig_character(shape.surface, repaired, skeleton, options);
    ASSERT_EQ(made.plan.plan, BodyKind::humanoid) << made.plan.reason;
    EXPECT_TRUE(made.plan.by_proportion) << made.plan.reason;
    EXPECT_TRUE(made.other_plans.empty());
    EXPECT_TRUE(made.plan.missing.empty());
    const RowVector3d hand = joint_of(made.plan, "leftHand")->position;
    const RowVector3d expected = holds_out ? RowVector3d(7.5, 15.2, 0) : RowVector3d(2.2, 10, 0);
    EXPECT_LT((hand - expected).norm(), 1.8) << hand;
    const std::set<std::string> arm{"leftUpperArm", "leftLowerArm", "leftHand"};
    for (Eigen::Index v = 0; v < made.rig.weights.rows(); ++v) {
      ASSERT_NEAR(made.rig.weights.row(v).sum(), 1, 1e-5);
      const RowVector3d place = shape.surface.positions.row(v);
      const bool is_hand =
          holds_out ? place.x() > 8 : place.x() > 2.3 && std::abs(place.y() - 8.4) < 1.3;
      if (is_hand) {
        EXPECT_GT(share_of(made.rig, v, arm), 0.8) << place;
      }
    }
  }
}

}  // namespace
}  // namespace curveskel::hidden_limb_laws
