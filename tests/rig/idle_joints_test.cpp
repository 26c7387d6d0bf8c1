// Laws of joints that would only be in the way: none amid a limb moves nothing, and none has all of
// its bones in one of the components that it moves.
#include "rig/joints/idle_joints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/joints.hpp>
#include <curveskel/make_rig.hpp>
#include "meshes/shapes.hpp"
#include "tests/rig/rig_subjects.hpp"

namespace curveskel::idle_joints_laws {
namespace {

/// A chain of joints, each of which but the tip moves the vertex of its number.
Rig chain_of(const std::vector<std::string>& names, const std::vector<int>& idle) {
  Rig rig;
  rig.names = names;
  const auto count = static_cast<int>(names.size());
  rig.joints.setZero(count, 3);
  rig.parents.resize(count);
  rig.weights.resize(count, count);
  for (int joint = 0; joint < count; ++joint) {
    rig.joints(joint, 0) = joint;
    rig.parents[joint] = joint - 1;
    int mover = joint;
    while (mover + 1 == count || std::count(idle.begin(), idle.end(), mover) > 0) --mover;
    rig.weights.insert(joint, mover) = 1;
  }
  return rig;
}

Eigen::VectorXi all_vertices(const Rig& rig) {
  const auto count = static_cast<int>(rig.weights.rows());
  return Eigen::VectorXi::LinSpaced(count, 0, count - 1);
}

const std::vector<std::string> limb{"root", "limb1_1", "limb1_2", "limb1_3", "limb1_end"};

TEST(IdleJoints, GoAndTheLimbIsCountedAnew) {
  const Rig rig = chain_of(limb, {2});
  const Rig without = without_idle_joints(rig, 0, all_vertices(rig));
  EXPECT_EQ(without.names, (std::vector<std::string>{"root", "limb1_1", "limb1_2", "limb1_end"}));
  EXPECT_EQ(without.parents, Eigen::Vector4i(-1, 0, 1, 2));
  EXPECT_EQ(without.joints.col(0), Eigen::Vector4d(0, 1, 3, 4));
  EXPECT_EQ(without.weights.coeff(2, 1), 1);
}

/// Hips with a spine 2 long, and with an end beside it.
TEST(IdleJoints, EndsBesideLongerPlannedBonesGo) {
  for (const double length : {1.0, 3.0}) {
    Rig rig = chain_of({"hips", "spine", "limb1_end"}, {});
    rig.joints(1, 0) = 2;
    rig.joints.row(2) << 0, -length, 0;
    rig.parents[2] = 0;
    const Rig without = without_idle_joints(rig, 2, all_vertices(rig));
    EXPECT_EQ(without.names.size(), length > 2 ? 3U : 2U);
  }
}

TEST(IdleJoints, StayWhereTheyArePlannedOrMoveSomething) {
  const Rig busy = chain_of(limb, {});
  EXPECT_EQ(without_idle_joints(busy, 0, all_vertices(busy)).names, limb);
  const Rig planned = chain_of(limb, {2});
  EXPECT_EQ(without_idle_joints(planned, 3, all_vertices(planned)).names, limb);
}

TEST(IdleJoints, AreThoseThatMoveNoVertexThatCounts) {
  const Rig rig = chain_of(limb, {});
  Eigen::VectorXi some = all_vertices(rig);
  some[2] = -1;
  EXPECT_EQ(without_idle_joints(rig, 0, some).names.size(), limb.size() - 1);
}

/// Both arms hang from the root; the left one's second joint moves nothing.
TEST(IdleJoints, StayBesideAMirrorImageThatMovesSomething) {
  Rig rig = chain_of(
      {"root", "limb1_1.L", "limb1_2.L", "limb1_end.L", "limb1_1.R", "limb1_2.R", "limb1_end.R"},
      {2});
  rig.parents[4] = 0;
  EXPECT_EQ(without_idle_joints(rig, 0, all_vertices(rig)).names, rig.names);
  const Rig both = chain_of(rig.names, {2, 5});
  const Rig without = without_idle_joints(both, 0, all_vertices(both));
  EXPECT_EQ(without.names, (std::vector<std::string>{"root", "limb1_1.L", "limb1_end.L",
                                                     "limb1_1.R", "limb1_end.R"}));
}

/// Two tubes along x, end in end, as an arm and a hand that is a component of its own.
RigSubject arm_and_hand() {
  const shapes::Shape arm = shapes::tube("", shapes::straight(10), shapes::constant(1), 16);
  const shapes::Shape hand = shapes::tube("", shapes::straight(5), shapes::constant(0.6), 16);
  const double between = 0.5 * (10 + 5) - 1;
  const Eigen::RowVector3d way =
      (arm.axis.nodes.row(arm.axis.nodes.rows() - 1) - arm.axis.nodes.row(0)).normalized();
  const shapes::Shape beyond = shapes::translated(hand, (between * way).transpose());
  return {"arm and hand", shapes::together("", {arm, beyond}).surface,
          together(arm.axis, beyond.axis)};
}

PlannedJoint planned_at(const RigSubject& subject, const std::string& role, int parent, int node) {
  PlannedJoint joint;
  joint.role = role;
  joint.parent = parent;
  joint.node = node;
  joint.position = subject.skeleton.nodes.row(node);
  return joint;
}

/// The elbow moves the end of the arm and the beginning of the hand.
TEST(IdleJoints, AreNoneThatMoveTwoComponents) {
  const RigSubject subject = arm_and_hand();
  const auto arm = static_cast<int>(
      shapes::tube("", shapes::straight(10), shapes::constant(1), 16).axis.nodes.rows());
  const auto all = static_cast<int>(subject.skeleton.nodes.rows());
  BodyPlan plan;
  plan.plan = BodyKind::other;
  plan.joints = {planned_at(subject, "shoulder", -1, 0), planned_at(subject, "elbow", 0, arm / 2),
                 planned_at(subject, "wrist", 1, (arm + all) / 2)};
  const Rig rig = make_planned_rig(subject.surface, subject.skeleton, plan, {}, {});
  const Eigen::RowVector3d from = rig.joints.row(0);
  const Eigen::RowVector3d way = (rig.joints.row(2) - from).normalized();
  const double elbow = (rig.joints.row(1) - from).dot(way);
  const double wrist = (rig.joints.row(2) - from).dot(way);
  for (Eigen::Index v = 0; v < rig.weights.rows(); ++v) {
    const double at = (subject.surface.positions.row(v) - from).dot(way);
    if (at > elbow + 1.5 && at < wrist - 1) {
      EXPECT_GT(rig.weights.coeff(v, 1), 0.5F) << at;
    }
  }
}

/// A doll's fingertip begins at the ball of the hinge before it.
TEST(IdleJoints, AreNoneBeforeAComponentThatBeginsThere) {
  const CurveSkeleton finger = chain_through({{0, 0, 0}, {10, 0, 0}}, 0.5, 0.5);
  const CurveSkeleton tip = chain_through({{10.2, 0, 0}, {12, 0, 0}}, 0.5, 0.3);
  const auto first = static_cast<int>(finger.nodes.rows());
  const CurveSkeleton curve = together(finger, tip);
  const RigSubject subject{"finger", {}, curve};
  const std::vector<PlannedJoint> planned{planned_at(subject, "finger_1", -1, 0),
                                          planned_at(subject, "finger_2", 0, first - 1)};
  const Joints joints = place_planned_joints(curve, planned);
  EXPECT_TRUE((joints.joint_of_node.tail(tip.nodes.rows()).array() == 1).all());
  ASSERT_EQ(joints.names.size(), 3U);
  EXPECT_TRUE(joints.names[2].ends_with("_end"));
  EXPECT_NEAR(joints.positions(2, 0), 12, 1e-9);
}

}  // namespace
}  // namespace curveskel::idle_joints_laws
