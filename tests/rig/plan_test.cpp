// Laws of plans: where the roles of a body lie.
#include <curveskel/body_plan.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/joints.hpp>
#include <curveskel/error.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/rest_pose.hpp>
#include <curveskel/role_names.hpp>
#include "meshes/random.hpp"
#include "rig/plan/mirror_plane.hpp"
#include "tests/rig/plan_subjects.hpp"

namespace curveskel::plan_laws {
namespace {

using Eigen::RowVector3d;

TEST(MirrorPlanes, AsymmetryIsTheMeanDistanceOfTheImageOverTheSize) {
  shapes::Random random(7);
  CurveTree tree;
  tree.size = 2;
  for (int k = 0; k < 700; ++k) {
    tree.nodes.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  }
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0;
    int count = 0;
    for (std::size_t k = 0; k < tree.nodes.size(); k += 3) {
      Eigen::Vector3d image = tree.nodes[k];
      image[axis] = 0.2 - image[axis];
      double least = 100;
      for (const auto& other : tree.nodes) least = std::min(least, (other - image).norm());
      sum += least;
      ++count;
    }
    EXPECT_NEAR(asymmetry(tree, axis, 0.1), sum / count / tree.size, 1e-12);
  }
}

TEST(FindPlan, HumanoidsHaveTheirJoints) {
  const RigSubject subject = human();
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  EXPECT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
  EXPECT_TRUE(plan.missing.empty());
  expect_near(plan, "hips", {0, 10, 0}, 1.2);
  expect_near(plan, "leftUpperLeg", {1.6, 9.4, 0}, 1);
  expect_near(plan, "leftLowerLeg", {1.6, 5.5, 0}, 1);
  expect_near(plan, "leftFoot", {1.6, 1.1, 0}, 0.6);
  expect_near(plan, "rightFoot", {-1.6, 1.1, 0}, 0.6);
  expect_near(plan, "leftUpperArm", {2.2, 15, 0}, 0.8);
  expect_near(plan, "leftLowerArm", {4.6, 15, 0}, 0.8);
  expect_near(plan, "head", {0, 16.9, 0}, 0.8);
  ASSERT_FALSE(plan.joints.empty());
  EXPECT_EQ(plan.joints.front().role, "hips");
  EXPECT_EQ(plan.joints.front().parent, -1);
}

/// In the ball of a belly the curve has one junction or two: noise decides.
TEST(FindPlan, AFatHumanIsOneWithAChestAndWithout) {
  for (const bool has_chest : {true, false}) {
    BodyCurve figure;
    const int hips = figure.add({0, 9, 0}, 4);
    const int chest = has_chest ? figure.add({0, 12, 0}, 3, hips) : hips;
    const int neck = figure.add({0, 16, 0}, 0.9, chest);
    figure.add({0, 18.5, 0}, 1.5, neck);
    figure.add_pair(chest, {{4, 12.5, 0}, {7, 12.5, 0}, {10, 12.5, 0}}, 0.7);
    figure.add_pair(hips, {{2, 5, 0}, {2, 1, 0}, {2, 0.8, 1.5}}, 0.8);
    const RigSubject subject = subject_of("fat human", figure);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
    EXPECT_TRUE(plan.missing.empty());
    expect_near(plan, "leftUpperArm", {4.2, 12.5, 0}, 1.2);
  }
}

/// From the thumb, which is ahead, backwards.
TEST(FindPlan, FingersAreInTheirOrder) {
  const std::vector<std::string> names{"Index", "Middle", "Ring", "Little"};
  for (const int fingers : {1, 4}) {
    const RigSubject subject = human_with_hands(fingers);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    ASSERT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
    for (const std::string side : {"left", "right"}) {
      const PlannedJoint* thumb = joint_of(plan, side + "ThumbDistal");
      const PlannedJoint* hand = joint_of(plan, side + "Hand");
      ASSERT_NE(thumb, nullptr) << fingers;
      double last = thumb->position.z();
      for (int finger = 0; finger < 4; ++finger) {
        const PlannedJoint* joint = joint_of(plan, side + names[idx(finger)] + "Distal");
        EXPECT_EQ(joint != nullptr, finger < fingers) << side << names[idx(finger)];
        if (joint == nullptr) continue;
        EXPECT_LT(joint->position.z(), last) << side << names[idx(finger)];
        last = joint->position.z();
        const PlannedJoint& middle = plan.joints[idx(joint->parent)];
        const PlannedJoint& first = plan.joints[idx(middle.parent)];
        EXPECT_EQ(middle.role, side + names[idx(finger)] + "Intermediate");
        EXPECT_EQ(first.role, side + names[idx(finger)] + "Proximal");
        EXPECT_EQ(plan.joints[idx(first.parent)].role, hand->role);
        const auto away = [&](const PlannedJoint& from) {
          return (from.position - hand->position).norm();
        };
        EXPECT_LT(away(first), away(middle));
        EXPECT_LT(away(middle), away(*joint));
      }
      EXPECT_LT(std::abs(hand->position.x()), 7.5) << "before the thumb";
    }
  }
}

// A nail, or a crumb of it, may make two tips.
TEST(FindPlan, AFingerThatEndsInTwoTipsIsOne) {
  const RigSubject plain = human_with_hands(4);
  const RigSubject forked = human_with_hands(4, true);
  const BodyPlan wanted = find_plan(plain.surface, plain.skeleton);
  const BodyPlan plan = find_plan(forked.surface, forked.skeleton);
  ASSERT_EQ(plan.joints.size(), wanted.joints.size());
  for (const PlannedJoint& joint : wanted.joints) {
    const PlannedJoint* found = joint_of(plan, joint.role);
    ASSERT_NE(found, nullptr) << joint.role;
    EXPECT_LT((found->position - joint.position).norm(), 0.3) << joint.role;
  }
}

TEST(FindPlan, ThinArmsWithoutFingersHaveNone) {
  const RigSubject subject = human();
  for (const PlannedJoint& joint : find_plan(subject.surface, subject.skeleton).joints) {
    EXPECT_EQ(joint.role.find("Distal"), std::string::npos) << joint.role;
  }
}

TEST(FindPlan, TailsHaveFourBonesOfOneLength) {
  for (const double front : {1.0, -1.0}) {
    const RigSubject subject = beast(front);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    std::vector<RowVector3d> places;
    for (const char* role : {"tail", "tail.001", "tail.002", "tail.003"}) {
      const PlannedJoint* joint = joint_of(plan, role);
      ASSERT_NE(joint, nullptr) << role;
      places.push_back(joint->position);
    }
    for (std::size_t k = 1; k < places.size(); ++k) {
      EXPECT_LT(places[k].z() * front, places[k - 1].z() * front);
      EXPECT_NEAR((places[k] - places[k - 1]).norm(), (places[1] - places[0]).norm(), 0.05);
    }
  }
}

TEST(PlannedJoints, AHeadBetweenNodesIsOneToo) {
  const RigSubject subject = human();
  std::vector<PlannedJoint> planned = find_plan(subject.surface, subject.skeleton).joints;
  const auto head = std::find_if(planned.begin(), planned.end(),
                                 [](const PlannedJoint& joint) { return joint.role == "head"; });
  ASSERT_NE(head, planned.end());
  head->node = -1;
  const Joints joints = place_planned_joints(subject.skeleton, planned);
  EXPECT_EQ(joints.names[idx(head - planned.begin())], "head");
  EXPECT_GE(joints.joint_of_node.minCoeff(), 0);
}

// The upper chest lay in the rucksack, and neck and arms hung from it.
TEST(FindPlan, ARucksackBendsNoSpine) {
  BodyCurve figure;
  const int chest = add_body_without_arms(figure);
  figure.add_pair(chest, {{2.2, 15, 0}, {5.5, 15, 0}, {8.5, 15, 0}}, 0.5);
  figure.add({0, 13, -3}, 0.8, chest);
  const RigSubject subject = subject_of("human with rucksack", figure);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  ASSERT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
  for (const PlannedJoint& joint : plan.joints) {
    const bool is_spine = joint.role == "spine" || joint.role == "chest" ||
                          joint.role == "upperChest" || joint.role == "neck";
    if (is_spine) {
      EXPECT_LT(std::abs(joint.position.z()), 0.5) << joint.role;
    }
  }
}

// Turned, a head left its ears and jaws behind: they hung from the neck.
TEST(PlannedJoints, EarsHangFromTheHead) {
  for (const double share : {0.4, 0.5, 0.7}) {
    SCOPED_TRACE(share);
    const RigSubject subject = beast_with_ears(share);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    ASSERT_EQ(plan.plan, BodyKind::quadruped) << plan.reason;
    Rig rig = make_planned_rig(subject.surface, subject.skeleton, plan);
    name_roles(rig, plan, NameStyle::automatic);
    const auto joint = [&](const std::string& name) {
      return std::find(rig.names.begin(), rig.names.end(), name) - rig.names.begin();
    };
    for (const char* ear : {"ear_1.L", "ear_1.R"}) {
      ASSERT_LT(joint(ear), rig.parents.size()) << ear;
      int above = rig.parents[joint(ear)];
      while (above >= static_cast<int>(plan.joints.size())) above = rig.parents[above];
      EXPECT_EQ(rig.names[idx(above)], "head");
    }
    const double ahead = rig.joints(joint("ear_1.L"), 2) - rig.joints(joint("head"), 2);
    EXPECT_LT(std::abs(ahead), 1.5) << "the head turns about where they begin";
  }
}

TEST(FindPlan, BothSidesAreAlike) {
  for (const RigSubject& subject : {human(), beast(1)}) {
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    std::size_t pairs = 0;
    for (const PlannedJoint& joint : plan.joints) {
      std::string other = joint.role;
      if (other.starts_with("left")) other = "right" + other.substr(4);
      if (other.ends_with(".L")) other.back() = 'R';
      if (other == joint.role) continue;
      const PlannedJoint* image = joint_of(plan, other);
      if (image == nullptr) continue;
      ++pairs;
      EXPECT_GT(joint.position.x(), 0) << joint.role;
      RowVector3d mirrored = image->position;
      mirrored.x() *= -1;
      EXPECT_LT((mirrored - joint.position).norm(), 0.02 * 20) << joint.role;
    }
    EXPECT_GE(pairs, 8U) << subject.name;
  }
}

TEST(FindPlan, QuadrupedsLookWhereTheirHeadsAre) {
  for (const double front : {1.0, -1.0}) {
    const RigSubject subject = beast(front);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::quadruped) << plan.reason;
    EXPECT_EQ(plan.axes(2, 2), front);
    expect_near(plan, "foot.L", {1.5 * front, 3, -7.4 * front}, 1.5);
    expect_near(plan, "front_foot.R", {-1.5 * front, 1, 5 * front}, 1.5);
    expect_near(plan, "spine", {0, 8, -6.5 * front}, 1.5);
    const PlannedJoint* head = joint_of(plan, "head");
    ASSERT_NE(head, nullptr);
    EXPECT_GT(head->position.z() * front, 6);
  }
}

TEST(FindPlan, FishHaveASpineAndFins) {
  for (const double front : {1.0, -1.0}) {
    const RigSubject subject = fish(front);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    ASSERT_EQ(plan.plan, BodyKind::fish) << plan.reason;
    EXPECT_GT(front * plan.axes(2, 2), 0) << "it looks where it is thick";
    const auto along = [&](const std::string& role) {
      const PlannedJoint* joint = joint_of(plan, role);
      return joint == nullptr ? 1e9 : front * joint->position.z();
    };
    EXPECT_GT(along("head"), along("spine"));
    EXPECT_GT(along("spine"), along("tail"));
    EXPECT_GT(along("tail"), along("tail.006"));
    for (const char* side : {".L", ".R"}) {
      for (const char* fin : {"pectoral_fin", "fluke"}) {
        EXPECT_NE(joint_of(plan, std::string(fin) + side), nullptr) << fin << side;
      }
    }
    EXPECT_NE(joint_of(plan, "dorsal_fin"), nullptr);
    const Joints joints = place_planned_joints(subject.skeleton, plan.joints);
    EXPECT_LE(joints.positions.rows(), 25) << "no beads";
  }
}

TEST(FindPlan, AFishThatBendsHasEachJointOfItsTailOnTheCurve) {
  const RigSubject subject = lionfish();
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  ASSERT_EQ(plan.plan, BodyKind::fish) << plan.reason;
  std::vector<int> nodes;
  for (const PlannedJoint& joint : plan.joints) {
    if (!joint.role.starts_with("tail") && joint.role != "head") continue;
    nodes.push_back(joint.node);
    const Eigen::RowVector3d node = subject.skeleton.nodes.row(joint.node);
    EXPECT_LT((node - joint.position).norm(), 0.5) << joint.role;
  }
  EXPECT_EQ(nodes.size(), 8U);
  std::sort(nodes.begin(), nodes.end());
  EXPECT_EQ(std::adjacent_find(nodes.begin(), nodes.end()), nodes.end()) << "one node, two joints";
}

TEST(PlannedJoints, ComeFirstAndAreTheOnlyOnesOnTheirWay) {
  for (const RigSubject& subject : {human(), beast(1)}) {
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    const Joints joints = place_planned_joints(subject.skeleton, plan.joints);
    ASSERT_GE(joints.names.size(), plan.joints.size());
    for (std::size_t k = 0; k < plan.joints.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      EXPECT_EQ(joints.names[k], plan.joints[k].role);
      EXPECT_EQ(joints.parents[row], plan.joints[k].parent);
      EXPECT_EQ(joints.positions.row(row), plan.joints[k].position);
    }
    EXPECT_EQ((joints.parents.array() < 0).count(), 1);
    EXPECT_GE(joints.joint_of_node.minCoeff(), 0);
    for (std::size_t k = 0; k < plan.joints.size(); ++k) {
      if (!plan.joints[k].is_last) continue;
      EXPECT_EQ((joints.parents.array() == static_cast<int>(k)).count(), 1) << joints.names[k];
    }
    // A human's only others are beyond the head, the hands and the toes.
    if (plan.plan != BodyKind::humanoid) continue;
    for (Eigen::Index j = static_cast<Eigen::Index>(plan.joints.size()); j < joints.parents.size();
         ++j) {
      int above = joints.parents[j];
      while (idx(above) >= plan.joints.size()) above = joints.parents[above];
      const std::string& role = plan.joints[idx(above)].role;
      EXPECT_TRUE(role == "head" || role.ends_with("Hand") || role.ends_with("Toes") ||
                  role.ends_with("Foot") || role.ends_with("Distal"))
          << joints.names[idx(j)] << " hangs from " << role;
    }
  }
}

TEST(PlannedRigs, HaveWeightsForEveryVertexAndTheRolesNames) {
  for (const RigSubject& subject : {human(), beast(-1)}) {
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    const Rig rig = make_planned_rig(subject.surface, subject.skeleton, plan);
    for (Eigen::Index v = 0; v < rig.weights.rows(); ++v) {
      EXPECT_NEAR(rig.weights.row(v).sum(), 1, 1e-5);
    }
    for (std::size_t k = 0; k < plan.joints.size(); ++k) {
      EXPECT_EQ(rig.names[k], plan.joints[k].role);
    }
  }
}

/// Where the joints are at rest.
Positions at_rest(const Rig& rig) {
  Positions places = rig.joints;
  for (int joint = 0; joint < static_cast<int>(rig.parents.size()); ++joint) {
    const int parent = rig.parents[joint];
    if (parent < 0) continue;
    const RowVector3d bone = rig.joints.row(joint) - rig.joints.row(parent);
    places.row(joint) =
        places.row(parent) + (rig.turns[idx(parent)] * bone.transpose()).transpose();
  }
  return places;
}

TEST(RestPose, OfAHumanHasLevelArmsAndStraightLegs) {
  for (const bool has_fingers : {true, false}) {
    RigSubject subject = has_fingers ? human_with_hands(4) : human();
    // Arms hang by 40 degrees, the figure looks along x.
    const Eigen::Matrix3d about =
        Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitY()).matrix();
    const auto lowered = [&](Positions& points) {
      for (Eigen::Index row = 0; row < points.rows(); ++row) {
        Eigen::Vector3d p = points.row(row).transpose();
        const double out = std::abs(p.x()) - 2;
        if (p.y() > 12 && out > 0) p.y() -= 0.8 * out;
        points.row(row) = (about * p).transpose();
      }
    };
    lowered(subject.surface.positions);
    lowered(subject.skeleton.nodes);
    PlanOptions options;
    options.front = Direction::x;
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton, options);
    ASSERT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
    Rig rig = make_planned_rig(subject.surface, subject.skeleton, plan);
    const Positions before = rig.joints;
    rest_in_t_pose(rig, plan);
    EXPECT_EQ(rig.joints, before) << "vertices and joints stay";
    const Positions rest = at_rest(rig);
    const auto place = [&](const std::string& role) -> RowVector3d {
      return rest.row(std::find(rig.roles.begin(), rig.roles.end(), role) - rig.roles.begin());
    };
    for (const std::string side : {"left", "right"}) {
      const double out = side == "left" ? -1 : 1;  // along z, as x is the front
      for (const auto& [from, to] :
           {std::pair{"UpperArm", "LowerArm"}, std::pair{"LowerArm", "Hand"}}) {
        const RowVector3d bone = place(side + to) - place(side + from);
        EXPECT_NEAR(bone.z() * out, bone.norm(), 1e-9) << side << from;
        EXPECT_GT(bone.norm(), 1);
      }
      const RowVector3d shin = place(side + "Foot") - place(side + "LowerLeg");
      EXPECT_NEAR(-shin.y(), shin.norm(), 1e-9);
    }
  }
  const RigSubject animal = beast(1);
  const BodyPlan plan = find_plan(animal.surface, animal.skeleton);
  Rig rig = make_planned_rig(animal.surface, animal.skeleton, plan);
  EXPECT_THROW(rest_in_t_pose(rig, plan), Error);
}

TEST(GroundRoot, IsBelowAndMovesNothing) {
  const RigSubject subject = human();
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  const Rig rig = make_planned_rig(subject.surface, subject.skeleton, plan);
  const Rig more = with_ground_root(rig, subject.surface, {0, 1, 0});
  ASSERT_EQ(more.joints.rows(), rig.joints.rows() + 1);
  EXPECT_EQ(more.names[0], "root");
  EXPECT_EQ(more.parents[0], -1);
  EXPECT_EQ((more.parents.array() < 0).count(), 1);
  EXPECT_NEAR(more.joints(0, 1), subject.surface.positions.col(1).minCoeff(), 1e-12);
  EXPECT_EQ(more.joints(0, 0), rig.joints(0, 0));
  EXPECT_EQ(more.joints.bottomRows(rig.joints.rows()), rig.joints);
  EXPECT_EQ(more.weights.col(0).sum(), 0);
  EXPECT_EQ(more.roles[1], "hips");
  EXPECT_EQ(Eigen::MatrixXf(more.weights).rightCols(rig.joints.rows()),
            Eigen::MatrixXf(rig.weights));
}

TEST(WithoutEnds, OnlyTipsThatMoveNothingAreGone) {
  const RigSubject subject = human_with_hands(1);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  Rig rig = make_planned_rig(subject.surface, subject.skeleton, plan);
  name_roles(rig, plan, NameStyle::automatic);
  const Rig fewer = without_ends(rig);
  ASSERT_LT(fewer.joints.rows(), rig.joints.rows());
  for (const std::string& name : fewer.names) {
    EXPECT_EQ(name.find("_end"), std::string::npos) << name;
  }
  for (Eigen::Index v = 0; v < rig.weights.rows(); ++v) {
    EXPECT_NEAR(fewer.weights.row(v).sum(), 1, 1e-5);
  }
  for (std::size_t joint = 0; joint < fewer.names.size(); ++joint) {
    const auto same = std::find(rig.names.begin(), rig.names.end(), fewer.names[joint]);
    ASSERT_NE(same, rig.names.end());
    EXPECT_EQ(fewer.joints.row(static_cast<Eigen::Index>(joint)),
              rig.joints.row(same - rig.names.begin()));
  }
}

}  // namespace
}  // namespace curveskel::plan_laws
