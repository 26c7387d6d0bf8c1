// Laws of plans: what a body is, where its roles lie, what they are called.
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
#include <curveskel/advanced/joints.hpp>
#include <curveskel/error.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/rest_pose.hpp>
#include <curveskel/rig_character.hpp>
#include <curveskel/role_names.hpp>
#include "tests/rig/rig_subjects.hpp"

namespace curveskel::plan_laws {
namespace {

using Eigen::RowVector3d;

/// Places joined by edges; the left half also stands for the right one.
struct Figure {
  std::vector<RowVector3d> places;
  std::vector<double> radii;
  std::vector<std::pair<int, int>> edges;

  int add(const RowVector3d& place, double radius, int from = -1) {
    places.push_back(place);
    radii.push_back(radius);
    const int number = static_cast<int>(places.size()) - 1;
    if (from >= 0) edges.emplace_back(from, number);
    return number;
  }
  /// A limb of both sides through these places, from a place in the middle.
  void add_pair(int from, const std::vector<RowVector3d>& limb, double radius) {
    for (const double side : {1.0, -1.0}) {
      int above = from;
      for (const RowVector3d& place : limb) {
        above = add({side * place.x(), place.y(), place.z()}, radius, above);
      }
    }
  }
};

RigSubject subject_of(const std::string& name, const Figure& figure, double resolution = 2.5) {
  CurveSkeleton graph;
  const auto count = static_cast<Eigen::Index>(figure.places.size());
  graph.nodes.resize(count, 3);
  graph.radii.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    graph.nodes.row(k) = figure.places[idx(k)];
    graph.radii[k] = figure.radii[idx(k)];
  }
  graph.edges.resize(static_cast<Eigen::Index>(figure.edges.size()), 2);
  for (std::size_t e = 0; e < figure.edges.size(); ++e) {
    graph.edges.row(static_cast<Eigen::Index>(e)) << figure.edges[e].first, figure.edges[e].second;
  }
  shapes::Shape shape = shapes::tube_union(name, graph, {0.25, resolution});
  graph.node_of_vertex.setConstant(shape.surface.positions.rows(), -1);
  RigSubject subject{name, std::move(shape.surface), std::move(graph)};
  subject.skeleton = dense_skeleton(subject.surface, subject.skeleton);
  for (Eigen::Index v = 0; v < subject.surface.positions.rows(); ++v) {
    Eigen::Index node = 0;
    (subject.skeleton.nodes.rowwise() - subject.surface.positions.row(v))
        .rowwise()
        .squaredNorm()
        .minCoeff(&node);
    subject.skeleton.node_of_vertex[v] = static_cast<int>(node);
  }
  return subject;
}

/// 20 high, looks along z, arms held out.
RigSubject human() {
  Figure figure;
  const int hips = figure.add({0, 10, 0}, 1.4);
  const int chest = figure.add({0, 15, 0}, 1.5, hips);
  const int neck = figure.add({0, 16.8, 0}, 0.6, chest);
  figure.add({0, 18.6, 0}, 1.3, neck);
  figure.add_pair(hips, {{1.6, 9, 0}, {1.6, 5, 0}, {1.6, 0.6, 0}, {1.6, 0.5, 2}}, 0.6);
  figure.add_pair(chest, {{2.2, 15, 0}, {5.5, 15, 0}, {8.5, 15, 0}}, 0.5);
  return subject_of("human", figure);
}

/// The same with a thumb and `fingers` on each hand, the last of which may end in two tips.
RigSubject human_with_hands(int fingers, bool is_forked = false) {
  Figure figure;
  const int hips = figure.add({0, 10, 0}, 1.4);
  const int chest = figure.add({0, 15, 0}, 1.5, hips);
  const int neck = figure.add({0, 16.8, 0}, 0.6, chest);
  figure.add({0, 18.6, 0}, 1.3, neck);
  figure.add_pair(hips, {{1.6, 9, 0}, {1.6, 5, 0}, {1.6, 0.6, 0}, {1.6, 0.5, 2}}, 0.6);
  for (const double side : {1.0, -1.0}) {
    int arm = chest;
    for (const double x : {2.2, 5.0, 7.0}) arm = figure.add({side * x, 15, 0}, 0.5, arm);
    const int thumb = figure.add({side * 8.2, 14.8, 1.2}, 0.22, arm);
    figure.add({side * 8.9, 14.7, 1.8}, 0.2, thumb);
    const int palm = figure.add({side * 8.4, 15, 0}, 0.4, arm);
    for (int finger = 0; finger < fingers; ++finger) {
      const double z = 0.9 - 1.8 * finger / std::max(fingers - 1, 1);
      const int knuckle = figure.add({side * 9.0, 15, z}, 0.2, palm);
      const double reach = 10.6 - 0.5 * std::abs(finger - 1);
      const int tip = figure.add({side * reach, 15, 1.1 * z}, 0.18, knuckle);
      if (!is_forked || finger + 1 < fingers) continue;
      figure.add({side * (reach + 0.15), 15.25, 1.1 * z}, 0.12, tip);
      figure.add({side * (reach + 0.15), 14.75, 1.1 * z}, 0.12, tip);
    }
  }
  return subject_of("hands", figure, 1.7);  // thin fingers, so many vertices
}

/// 20 long, its head at +z or -z.
RigSubject beast(double front) {
  Figure figure;
  const int rump = figure.add({0, 8, -6 * front}, 1.4);
  const int withers = figure.add({0, 8, 5 * front}, 1.4, rump);
  const int neck = figure.add({0, 10.5, 8 * front}, 0.8, withers);
  figure.add({0, 11, 10.5 * front}, 1, neck);
  figure.add({0, 7, -11 * front}, 0.5, rump);
  figure.add_pair(rump, {{1.5, 6, -6.5 * front}, {1.5, 3, -7.5 * front}, {1.5, 0.5, -7 * front}},
                  0.5);
  figure.add_pair(withers, {{1.5, 6, 5 * front}, {1.5, 3, 5 * front}, {1.5, 0.5, 5 * front}}, 0.5);
  return subject_of("beast", figure);
}

/// Six branches round a trunk, none of them down to the ground.
RigSubject tree() {
  Figure figure;
  int below = figure.add({0, 0.8, 0}, 0.8);
  for (const double height : {6.0, 9.0, 12.0}) {
    const int fork = figure.add({0.2, height, 0.1}, 0.8, below);
    figure.add({4, height + 3, 1.5}, 0.5, fork);
    figure.add({-3.4, height + 2.1, -2.2}, 0.5, fork);
    below = fork;
  }
  return subject_of("tree", figure);
}

/// 20 long, thick before the middle, with two pairs of fins and one on the back, its nose at +z or
/// -z; clear of the ground.
RigSubject fish(double front) {
  Figure figure;
  const int thick = figure.add({0, 6, 3 * front}, 2);
  figure.add({0, 6, 8 * front}, 1, figure.add({0, 6, 6 * front}, 1.5, thick));
  const int back = figure.add({0, 6, 0.5 * front}, 1.8, thick);
  const int slim = figure.add({0, 6, -5 * front}, 0.9, back);
  const int tail = figure.add({0, 6, -9 * front}, 0.5, slim);
  figure.add_pair(tail, {{2, 6, -11 * front}}, 0.3);
  figure.add_pair(thick, {{2.5, 5, 2 * front}, {5, 4, 0.5 * front}}, 0.35);
  figure.add({0, 10, -2 * front}, 0.35, figure.add({0, 8.2, -0.5 * front}, 0.4, back));
  return subject_of("fish", figure, 2);
}

RigSubject snake() {
  Figure figure;
  int before = figure.add({-10, 1, 0}, 0.8);
  for (int k = 1; k <= 10; ++k) before = figure.add({2.0 * k - 10, 1, std::sin(k)}, 0.8, before);
  return subject_of("snake", figure);
}

const PlannedJoint* joint_of(const BodyPlan& plan, const std::string& role) {
  const auto found = std::find_if(plan.joints.begin(), plan.joints.end(),
                                  [&](const PlannedJoint& joint) { return joint.role == role; });
  return found == plan.joints.end() ? nullptr : &*found;
}

void expect_near(const BodyPlan& plan, const std::string& role, const RowVector3d& place,
                 double off) {
  const PlannedJoint* joint = joint_of(plan, role);
  ASSERT_NE(joint, nullptr) << role;
  EXPECT_LT((joint->position - place).norm(), off) << role << " at " << joint->position;
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

TEST(FindPlan, FollowsUpAndFront) {
  const RigSubject subject = human();
  const BodyPlan upright = find_plan(subject.surface, subject.skeleton);
  // Lying: up is z, and the front is -y, as in Blender.
  RigSubject turned = subject;
  const auto turn = [](Positions& points) {
    const Positions given = points;
    points.col(1) = -given.col(2);
    points.col(2) = given.col(1);
  };
  turn(turned.surface.positions);
  turn(turned.skeleton.nodes);
  PlanOptions options;
  options.up = Direction::z;
  const BodyPlan found = find_plan(turned.surface, turned.skeleton, options);
  ASSERT_EQ(found.plan, BodyKind::humanoid);
  ASSERT_EQ(found.joints.size(), upright.joints.size());
  for (std::size_t k = 0; k < found.joints.size(); ++k) {
    const RowVector3d& place = upright.joints[k].position;
    EXPECT_EQ(found.joints[k].role, upright.joints[k].role);
    EXPECT_LT((found.joints[k].position - RowVector3d(place.x(), -place.z(), place.y())).norm(),
              0.4);
  }
  options.front = Direction::minus_z;
  EXPECT_THROW((void)find_plan(turned.surface, turned.skeleton, options), Error);
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

TEST(FindPlan, NamesNoHumanOnATree) {
  for (const RigSubject& subject : {tree(), snake()}) {
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::other) << subject.name;
    EXPECT_TRUE(plan.joints.empty());
    EXPECT_FALSE(plan.reason.empty());
    PlanOptions options;
    options.plan = BodyKind::humanoid;
    EXPECT_TRUE(find_plan(subject.surface, subject.skeleton, options).joints.empty());
    options.plan = BodyKind::none;
    EXPECT_EQ(find_plan(subject.surface, subject.skeleton, options).plan, BodyKind::none);
  }
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

TEST(RoleNames, OfFingersAreThoseOfThePrograms) {
  const RigSubject subject = human_with_hands(4);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  Rig rig = make_planned_rig(subject.surface, subject.skeleton, plan);
  const auto has = [&](NameStyle style, const std::vector<std::string>& wanted) {
    name_roles(rig, plan, style);
    for (const std::string& name : wanted) {
      EXPECT_EQ(std::count(rig.names.begin(), rig.names.end(), name), 1) << name;
    }
  };
  has(NameStyle::vrm, {"leftThumbMetacarpal", "leftThumbDistal", "rightLittleIntermediate"});
  has(NameStyle::mixamo, {"mixamorig:LeftHandThumb1", "mixamorig:RightHandPinky2"});
  has(NameStyle::unreal, {"thumb_01_l", "thumb_03_l", "pinky_02_r"});
  has(NameStyle::unity, {"LeftThumbMetacarpal", "RightLittleIntermediate"});
  has(NameStyle::rigify, {"thumb.01.L", "f_pinky.02.R"});
  has(NameStyle::automatic, {"thumb_1.L", "thumb_3.L", "finger_pinky_2.R"});
}

TEST(RoleNames, AreUniqueAndOfTheirStyle) {
  for (const RigSubject& subject : {human(), human_with_hands(3), beast(1), tree()}) {
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    for (const auto& style : name_styles) {
      Rig rig = make_planned_rig(subject.surface, subject.skeleton, plan);
      name_roles(rig, plan, style.value);
      const std::set<std::string> names(rig.names.begin(), rig.names.end());
      EXPECT_EQ(names.size(), rig.names.size()) << subject.name << ' ' << style.name;
      const bool is_human = plan.plan == BodyKind::humanoid;
      EXPECT_EQ(names.count("mixamorig:LeftUpLeg") > 0,
                is_human && style.value == NameStyle::mixamo);
      EXPECT_EQ(names.count("calf_r") > 0, is_human && style.value == NameStyle::unreal);
      EXPECT_EQ(names.count("rightLowerLeg") > 0, is_human && style.value == NameStyle::vrm);
      EXPECT_EQ(names.count("RightLowerLeg") > 0, is_human && style.value == NameStyle::unity);
      EXPECT_EQ(names.count("forearm.R") > 0, is_human && style.value == NameStyle::rigify);
      EXPECT_EQ(names.count("upper_leg.L") > 0, is_human && style.value == NameStyle::automatic);
      // What hangs from a joint of the plan is called after it.
      const bool says_limb = std::any_of(names.begin(), names.end(), [](const std::string& name) {
        return name.find("limb") != std::string::npos;
      });
      EXPECT_EQ(says_limb, plan.joints.empty() && style.value != NameStyle::neutral)
          << subject.name << ' ' << style.name;
    }
  }
}

TEST(AssignedRoles, AreHeldByOneJointEach) {
  const RigSubject subject = human();
  BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  ASSERT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
  Rig rig = make_planned_rig(subject.surface, subject.skeleton, plan);
  name_roles(rig, plan, NameStyle::mixamo);
  const auto joint_of = [&](const std::string& role) {
    const auto found = std::find(rig.roles.begin(), rig.roles.end(), role);
    return static_cast<int>(found - rig.roles.begin());
  };
  const int neck = joint_of("neck");
  const int head = joint_of("head");
  const std::string name_of_neck = rig.names[idx(neck)];
  assign_role(rig, plan, neck, "head", NameStyle::mixamo);
  EXPECT_EQ(joint_of("head"), neck);
  EXPECT_EQ(joint_of("neck"), head) << "they have changed places";
  EXPECT_EQ(rig.names[idx(neck)], "mixamorig:Head");
  EXPECT_EQ(rig.names[idx(head)], name_of_neck);
  EXPECT_TRUE(plan.missing.empty());
  assign_role(rig, plan, neck, "", NameStyle::mixamo);
  EXPECT_EQ(plan.missing, std::vector<std::string>{"head"});
  assign_role(rig, plan, head, "head", NameStyle::mixamo);
  EXPECT_TRUE(plan.missing.empty());
  EXPECT_EQ(rig.names[idx(head)], "mixamorig:Head");
  const std::set<std::string> names(rig.names.begin(), rig.names.end());
  EXPECT_EQ(names.size(), rig.names.size());
}

TEST(AssignedRoles, AreWordsThatNamesAreKnownFor) {
  for (const auto& entry : body_kinds) {
    const std::vector<std::string> roles = roles_of(entry.value);
    const std::set<std::string> known(roles.begin(), roles.end());
    EXPECT_EQ(known.size(), roles.size());
    const bool has_plan = entry.value != BodyKind::none && entry.value != BodyKind::automatic;
    EXPECT_EQ(roles.empty(), !has_plan);
  }
  const auto human_roles = roles_of(BodyKind::humanoid);
  for (const char* required : required_human_roles) {
    EXPECT_NE(std::find(human_roles.begin(), human_roles.end(), required), human_roles.end());
  }
  const RigSubject subject = beast(1);
  const std::vector<std::string> roles = roles_of(BodyKind::quadruped);
  for (const PlannedJoint& joint : find_plan(subject.surface, subject.skeleton).joints) {
    EXPECT_NE(std::find(roles.begin(), roles.end(), joint.role), roles.end()) << joint.role;
  }
}

/// These subjects, each moved along x.
RigSubject scene(const std::vector<std::pair<RigSubject, double>>& subjects) {
  RigSubject all{"scene", {}, {}};
  for (const auto& [subject, x] : subjects) {
    const Eigen::Index vertices = all.surface.positions.rows();
    const Eigen::Index faces = all.surface.triangles.rows();
    const Eigen::Index nodes = all.skeleton.nodes.rows();
    const Eigen::Index edges = all.skeleton.edges.rows();
    const auto extend = [](auto& rows, const auto& more) {
      rows.conservativeResize(rows.rows() + more.rows(), more.cols());
      rows.bottomRows(more.rows()) = more;
    };
    extend(all.surface.positions, subject.surface.positions);
    extend(all.surface.triangles, subject.surface.triangles);
    extend(all.skeleton.nodes, subject.skeleton.nodes);
    extend(all.skeleton.edges, subject.skeleton.edges);
    extend(all.skeleton.radii, subject.skeleton.radii);
    extend(all.skeleton.node_of_vertex, subject.skeleton.node_of_vertex);
    for (Eigen::Index v = vertices; v < all.surface.positions.rows(); ++v) {
      all.surface.positions(v, 0) += x;
      all.skeleton.node_of_vertex[v] += static_cast<int>(nodes);
    }
    for (Eigen::Index k = nodes; k < all.skeleton.nodes.rows(); ++k) all.skeleton.nodes(k, 0) += x;
    for (Eigen::Index f = faces; f < all.surface.triangles.rows(); ++f) {
      all.surface.triangles.row(f).array() += static_cast<int>(vertices);
    }
    for (Eigen::Index e = edges; e < all.skeleton.edges.rows(); ++e) {
      all.skeleton.edges.row(e).array() += static_cast<int>(nodes);
    }
  }
  return all;
}

CharacterRig rig_of(const RigSubject& subject) {
  RepairedSurface body;
  body.surface = subject.surface;
  body.vertex_of_input = Eigen::VectorXi::LinSpaced(
      subject.surface.positions.rows(), 0, static_cast<int>(subject.surface.positions.rows()) - 1);
  return rig_body(subject.surface, body, subject.skeleton);
}

/// Each figure of a scene is rigged as if it were alone.
TEST(Figures, OfASceneAreRiggedEachByItsPlan) {
  constexpr double aside = 16;
  const CharacterRig one = rig_of(human());
  const CharacterRig other = rig_of(beast(1));
  const CharacterRig both = rig_of(scene({{beast(1), aside}, {human(), 0}}));
  EXPECT_EQ(both.plan.plan, BodyKind::humanoid);
  ASSERT_EQ(both.other_plans.size(), 1U);
  EXPECT_EQ(both.other_plans[0].plan, BodyKind::quadruped);
  const std::size_t first = one.rig.names.size();
  ASSERT_EQ(both.rig.names.size(), first + other.rig.names.size());
  const Eigen::Index beast_vertices = other.rig.weights.rows();
  for (std::size_t k = 0; k < both.rig.names.size(); ++k) {
    const bool is_one = k < first;
    const Rig& alone = is_one ? one.rig : other.rig;
    const std::size_t same = is_one ? k : k - first;
    EXPECT_EQ(both.rig.names[k], (is_one ? "" : "figure2_") + alone.names[same]);
    EXPECT_EQ(both.rig.roles[k], is_one ? alone.roles[same] : "");
    const auto row = static_cast<Eigen::Index>(k);
    const auto alone_row = static_cast<Eigen::Index>(same);
    const int parent = alone.parents[alone_row];
    EXPECT_EQ(both.rig.parents[row], parent < 0 || is_one ? parent : parent + int(first));
    const RowVector3d shift(is_one ? 0 : aside, 0, 0);
    EXPECT_LT((both.rig.joints.row(row) - alone.joints.row(alone_row) - shift).norm(), 1e-9);
  }
  for (Eigen::Index v = 0; v < both.rig.weights.rows(); ++v) {
    const bool is_one = v >= beast_vertices;
    const Rig& alone = is_one ? one.rig : other.rig;
    for (SkinWeights::InnerIterator it(both.rig.weights, v); it; ++it) {
      const Eigen::Index joint = is_one ? it.col() : it.col() - static_cast<Eigen::Index>(first);
      ASSERT_GE(joint, 0);
      ASSERT_NEAR(it.value(), alone.weights.coeff(is_one ? v - beast_vertices : v, joint), 1e-5F);
    }
  }
}

TEST(Figures, AreNotMadeOfThings) {
  const CharacterRig with_tree = rig_of(scene({{human(), 0}, {tree(), 30}}));
  EXPECT_TRUE(with_tree.other_plans.empty());
  const CharacterRig three = rig_of(scene({{human(), 0}, {tree(), 30}, {human(), 60}}));
  EXPECT_EQ(three.other_plans.size(), 1U);
  for (Eigen::Index v = 0; v < three.rig.weights.rows(); ++v) {
    ASSERT_NEAR(three.rig.weights.row(v).sum(), 1, 1e-5F) << "something moves the tree, too";
  }
}

}  // namespace
}  // namespace curveskel::plan_laws
