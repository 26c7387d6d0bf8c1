#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "rig/plan/completed.hpp"
#include "tests/rig/plan_subjects.hpp"

namespace curveskel::missing_limb_laws {
namespace {

/// A human whose limbs on one side have so many places of those of the other.
struct Maimed {
  std::size_t arm = 3;
  std::size_t leg = 4;
  std::set<std::string> missing;  ///< after the side
};

RigSubject human_with(const Maimed& maimed, double side) {
  const std::array<Eigen::RowVector3d, 3> arm{{{2.2, 15, 0}, {5.5, 15, 0}, {8.5, 15, 0}}};
  const std::array<Eigen::RowVector3d, 4> leg{
      {{1.6, 9, 0}, {1.6, 5, 0}, {1.6, 0.6, 0}, {1.6, 0.5, 2}}};
  BodyCurve figure;
  const int hips = figure.add({0, 10, 0}, 1.4);
  const int chest = figure.add({0, 15, 0}, 1.5, hips);
  figure.add({0, 18.6, 0}, 1.3, figure.add({0, 16.8, 0}, 0.6, chest));
  for (const double x : {1.0, -1.0}) {
    int above = chest;
    for (std::size_t k = 0; k < (x == side ? maimed.arm : arm.size()); ++k) {
      above = figure.add({x * arm[k].x(), arm[k].y(), arm[k].z()}, 0.5, above);
    }
    above = hips;
    for (std::size_t k = 0; k < (x == side ? maimed.leg : leg.size()); ++k) {
      above = figure.add({x * leg[k].x(), leg[k].y(), leg[k].z()}, 0.6, above);
    }
  }
  return subject_of("maimed", figure);
}

const std::vector<Maimed>& all_maimed() {
  static const std::vector<Maimed> all{
      {0, 4, {"UpperArm", "LowerArm", "Hand"}},
      {2, 4, {"Hand"}},
      {3, 0, {"UpperLeg", "LowerLeg", "Foot"}},
      {3, 2, {"Foot"}},
  };
  return all;
}

// From the side the legs of a stride are images of each other, and one arm has none.
TEST(MissingLimbs, AreNotMadeUpForWhoIsSeenFromTheSide) {
  BodyCurve figure;
  const int hips = figure.add({0, 10, 0}, 1);
  const int chest = figure.add({0, 15, 0}, 1, hips);
  figure.add({0, 18.6, 0}, 1.2, figure.add({0, 16.8, 0}, 0.6, chest));
  for (const double x : {1.0, -1.0}) {
    const int thigh = figure.add({x * 0.3, 9, x * 1}, 0.6, hips);
    figure.add({x * 0.3, 0.6, x * 3}, 0.6, figure.add({x * 0.3, 5, x * 2}, 0.6, thigh));
  }
  const int elbow = figure.add({3.4, 12, 1}, 0.5, figure.add({3, 15, 0}, 0.8, chest));
  figure.add({3.4, 12.5, 5}, 0.5, elbow);
  const int stump = figure.add({-3, 15, 0}, 0.8, chest);
  figure.add({-4.2, 14, 0}, 1.2, stump);  // with what it carries
  const RigSubject subject = subject_of("strider", figure);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  EXPECT_FALSE(plan.reason.starts_with("one limb is not whole")) << plan.reason << plan.axes;
}

TEST(MissingLimbs, MakeNoHumanAnotherThing) {
  const RigSubject whole = human();
  const BodyPlan as_whole = find_plan(whole.surface, whole.skeleton);
  for (const Maimed& maimed : all_maimed()) {
    for (const double side : {1.0, -1.0}) {
      const std::string name = side > 0 ? "left" : "right";
      SCOPED_TRACE(name + *maimed.missing.begin());
      const RigSubject subject = human_with(maimed, side);
      const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
      ASSERT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
      std::set<std::string> missing;
      for (const std::string& part : maimed.missing) missing.insert(name + part);
      EXPECT_EQ(std::set<std::string>(plan.missing.begin(), plan.missing.end()), missing);
      int counted = 0;
      for (const PlannedJoint& joint : as_whole.joints) {
        const PlannedJoint* own = joint_of(plan, joint.role);
        if (own == nullptr) continue;
        ++counted;
        EXPECT_LT((own->position - joint.position).norm(), 0.5) << joint.role;  // of 20
      }
      EXPECT_EQ(counted, static_cast<int>(plan.joints.size()));
      EXPECT_EQ(joint_of(plan, name + "Shoulder") == nullptr, maimed.arm == 0);
      for (std::size_t k = 1; k < plan.joints.size(); ++k) {
        EXPECT_LT(plan.joints[k].parent, static_cast<int>(k));
        EXPECT_GE(plan.joints[k].parent, 0);
        EXPECT_LT(plan.joints[k].node, subject.skeleton.nodes.rows());
      }
    }
  }
}

/// The arm moves the box, beside whose middle the legs are a pair.
TEST(MissingLimbs, ARefusalIsOfTheLookThatExplainsMost) {
  const RigSubject subject = human_with(all_maimed().front(), 1);
  PlanOptions options;
  options.plan = BodyKind::quadruped;
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton, options);
  ASSERT_EQ(plan.plan, BodyKind::other);
  EXPECT_NE(plan.reason.find("one pair of limbs reaches the ground"), std::string::npos)
      << plan.reason;
}

/// A robot's forearm, say: one place from which three limbs lead, and a fourth one's image.
TEST(MissingLimbs, WhatForksTwiceInOnePlaceIsNoHuman) {
  BodyCurve figure;
  const int fork = figure.add({0, 14, 0}, 1);
  figure.add({0, 19, 0}, 1, fork);
  for (const double x : {2.0, -2.0}) {
    const int knee = figure.add({x, 7, 0}, 0.8, figure.add({x, 12, 0}, 0.8, fork));
    figure.add({x, 0.8, 0}, 0.8, knee);
  }
  figure.add({9, 14.3, 0}, 0.6, figure.add({3, 14.3, 0}, 0.6, fork));
  const RigSubject subject = subject_of("forks", figure);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  EXPECT_EQ(plan.plan, BodyKind::other) << plan.reason;
}

// The image of a limb was hung from a place within the limb, and grew from its own nodes.
TEST(MissingLimbs, NoLimbIsItsOwnImage) {
  CurveTree tree;
  for (int node = 0; node < 4; ++node) {
    tree.nodes.emplace_back(node, 0, 0);
    tree.radii.push_back(1);
    tree.neighbours.emplace_back();
    if (node == 0) continue;
    tree.neighbours[node].push_back(node - 1);
    tree.neighbours[node - 1].push_back(node);
  }
  EXPECT_FALSE(with_whole_limb(tree, {{{3, 1}}, {}}, {{0, 1, 2, 3}, {0, 1}, 3}));
  EXPECT_FALSE(with_whole_limb(tree, {{{1, 3}}, {}}, {{0, 1}, {0, 1, 2, 3}, 3}));
}

}  // namespace
}  // namespace curveskel::missing_limb_laws
