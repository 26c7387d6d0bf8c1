// Laws of which body is seen in a curve.
#include <curveskel/body_plan.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "tests/rig/plan_subjects.hpp"

namespace curveskel::plan_kind_laws {
namespace {

using Eigen::RowVector3d;

/// On four legs about a top, with a head at one end or without.
TEST(FindPlan, AnAnimalHasAHeadAtOneEnd) {
  for (const bool has_head : {true, false}) {
    BodyCurve figure;
    const int rear = figure.add({0, 10, -6}, 0.8);
    const int front = figure.add({0, 10, 6}, 0.8, rear);
    if (has_head) figure.add({0, 13, 10}, 0.8, front);
    figure.add_pair(rear, {{4, 9.5, -6}, {4, 4, -6}, {4, 0.5, -6}}, 0.5);
    figure.add_pair(front, {{4, 9.5, 6}, {4, 4, 6}, {4, 0.5, 6}}, 0.5);
    const RigSubject subject = subject_of("table", figure);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, has_head ? BodyKind::quadruped : BodyKind::other) << plan.reason;
  }
}

/// Arms as long as the forearms of a doll, or at the very top.
TEST(FindPlan, AChairsBackAndALadderAreNoHumans) {
  for (const double reach : {8.5, 2.6}) {
    BodyCurve figure;
    const int chest = add_body_without_arms(figure);
    figure.add_pair(chest, {{2.2, 15, 0}, {reach, 15, 0}}, 0.5);
    const RigSubject subject = subject_of("short arms", figure);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan == BodyKind::humanoid, reach > 5) << plan.reason;
  }
  BodyCurve figure;
  const int hips = figure.add({0, 10, 0}, 0.5);
  const int top = figure.add({0, 19.4, 0}, 0.5, hips);
  figure.add_pair(hips, {{1.6, 9, 0}, {1.6, 5, 0}, {1.6, 0.6, 0}}, 0.5);
  figure.add_pair(top, {{2.2, 19.4, 0}, {6, 19.4, 0}}, 0.5);
  const RigSubject subject = subject_of("rack", figure);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  EXPECT_NE(plan.plan, BodyKind::humanoid) << plan.reason;
}

/// Low, long, on short legs that stand out to the sides; the front ones end this high.
RigSubject lizard(double front_feet = 0.3) {
  BodyCurve figure;
  const int rump = figure.add({0, 1.6, -3}, 0.8);
  const int withers = figure.add({0, 1.6, 4}, 0.8, rump);
  figure.add({0, 1.8, 9}, 0.6, figure.add({0, 1.8, 6.5}, 0.5, withers));
  figure.add({0, 1, -11}, 0.3, rump);
  for (const int root : {rump, withers}) {
    const double z = figure.places[idx(root)].z();
    figure.add_pair(root, {{1.4, 1.5, z}, {1.8, root == rump ? 0.3 : front_feet, z}}, 0.25);
  }
  return subject_of("lizard", figure);
}

TEST(FindPlan, SprawlsOnFourLegs) {
  const RigSubject subject = lizard();
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  EXPECT_EQ(plan.plan, BodyKind::quadruped) << plan.reason;
  EXPECT_EQ(plan.axes(2, 2), 1);
}

/// Its height is no measure of how exactly the feet of a low body stand.
TEST(FindPlan, ALowBodyMayLiftItsFeetALittle) {
  for (const double front_feet : {0.6, 1.2}) {
    const RigSubject subject = lizard(front_feet);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan == BodyKind::quadruped, front_feet < 1)
        << plan.reason << ", " << front_feet;
  }
}

/// Head and tail as high as each other, and three toes.
RigSubject hen(double x_of_legs, double gap_of_toes) {
  BodyCurve figure;
  const int hips = figure.add({0, 9, 0}, 2.4);
  const int neck = figure.add({0, 14, 3.5}, 1.2, hips);
  figure.add({0, 18, 7}, 0.4, figure.add({0, 18, 4.5}, 0.9, neck));
  figure.add({0, 18.5, -5}, 0.8, figure.add({0, 14, -3.5}, 1.6, hips));
  for (const double side : {1.0, -1.0}) {
    int leg = hips;
    for (const double y : {7.0, 3.5, 0.6}) leg = figure.add({x_of_legs * side, y, 0}, 0.4, leg);
    for (const double inwards : {-1.0, 0.0, 1.0}) {
      const double tip = x_of_legs - inwards * (x_of_legs - gap_of_toes / 2);
      figure.add({tip * side, 0.3, 3}, 0.2, leg);
    }
  }
  return subject_of("hen", figure);
}

/// The inner toes are stretched, as tubes so near each other are hardly told apart.
TEST(FindPlan, AHenStandsOnTwoLegsHoweverNearItsToesAre) {
  constexpr double x = 2.4;
  constexpr double usual_gap = 1.2;
  const RigSubject usual = hen(x, usual_gap);
  for (const double gap : {usual_gap, 0.1, 0.0}) {
    const auto stretched = [&](Positions places) {
      for (auto place : places.rowwise()) {
        const double inwards = x - std::abs(place.x());
        if (place.y() > 0.7 || inwards < 0) continue;
        place.x() = std::copysign(x - inwards * (2 * x - gap) / (2 * x - usual_gap), place.x());
      }
      return places;
    };
    RigSubject subject = usual;
    subject.surface.positions = stretched(usual.surface.positions);
    subject.skeleton.nodes = stretched(usual.skeleton.nodes);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::tailed_biped) << plan.reason << ", gap " << gap;
    EXPECT_EQ(plan.axes(2, 2), 1) << gap;
    EXPECT_NE(joint_of(plan, "shin.R"), nullptr) << gap;
  }
}

/// Ears are no arms where a pair of front legs reaches the ground, if aslant.
TEST(FindPlan, AMouseWithLargeEarsStandsOnFourLegs) {
  const RigSubject subject = mouse();
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  EXPECT_EQ(plan.plan, BodyKind::quadruped) << plan.reason;
}

/// A human upside down, on its ears.
TEST(FindPlan, NobodyStandsOnHisEars) {
  for (const double ears : {0.0, 2.5}) {
    BodyCurve figure;
    const int head = figure.add({0, 17, 0}, 1.3);
    const int chest = figure.add({0, 14, 0}, 1.4, head);
    const int hips = figure.add({0, 9.5, 0}, 1.4, chest);
    if (ears > 0) figure.add_pair(head, {{0.9, 18, 0}, {1, 18 + ears, 0}}, 0.4);
    figure.add_pair(chest, {{2.2, 14, 0}, {5.5, 14, 0}, {8.5, 14, 0}}, 0.5);
    figure.add_pair(hips, {{1.6, 9, 0}, {1.6, 5, 0}, {1.6, 0.6, 0}, {1.6, 0.5, 2}}, 0.6);
    const RigSubject upright = subject_of("hare", figure);
    EXPECT_EQ(find_plan(upright.surface, upright.skeleton).plan, BodyKind::humanoid);
    PlanOptions upside_down;
    upside_down.up = Direction::minus_y;
    const BodyPlan plan = find_plan(upright.surface, upright.skeleton, upside_down);
    EXPECT_EQ(plan.plan, BodyKind::other) << plan.reason;
  }
}

/// Thighs are level: a share of the hips' height is in the shin.
TEST(FindPlan, KneesOfTheSittingAreHalfWayAlongTheLeg) {
  const RigSubject subject = sitting_human();
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  ASSERT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
  expect_near(plan, "leftLowerLeg", {1.4, 5, 5}, 1);
  expect_near(plan, "leftFoot", {1.4, 0.8, 5}, 1);
}

/// In clothes, of which none has most of the area, so that it is no animal.
TEST(FindPlan, LegsMayBeWideApart) {
  for (const double degrees : {15.0, 30.0, 42.0, 50.0}) {
    const double aside = std::sin(degrees * std::numbers::pi / 180);
    const double down = std::cos(degrees * std::numbers::pi / 180);
    const double hip = 8.4 * down + 0.6;
    BodyCurve figure;
    const int hips = figure.add({0, hip + 1, 0}, 1.4);
    const int chest = figure.add({0, hip + 6, 0}, 1.5, hips);
    figure.add({0, hip + 9.6, 0}, 1.3, figure.add({0, hip + 7.8, 0}, 0.6, chest));
    figure.add_pair(hips,
                    {{1.4, hip, 0},
                     {1.4 + 4 * aside, hip - 4 * down, 0},
                     {1.4 + 8.4 * aside, 0.6, 0},
                     {1.4 + 8.4 * aside, 0.5, 2}},
                    0.6);
    figure.add_pair(chest, {{2.2, hip + 6, 0}, {5.5, hip + 6, 0}, {8.5, hip + 6, 0}}, 0.5);
    const RigSubject subject = subject_of("straddling", figure);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::humanoid) << degrees << ": " << plan.reason;
  }
}

TEST(FindPlan, ADiscOnSprawlingLegsIsNoHuman) {
  BodyCurve figure;
  const int rear = figure.add({0, 8, -3}, 2);
  const int front = figure.add({0, 8.5, 3}, 2, rear);
  figure.add({0, 9, 6}, 1.5, front);
  figure.add_pair(rear, {{3, 8, -3}, {7, 6, -5}, {9.5, 0.6, -6}}, 0.6);
  figure.add_pair(front, {{4, 7, 3}, {7, 7, 5}, {9, 5, 6}}, 0.6);
  const RigSubject subject = subject_of("disc on legs", figure);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  EXPECT_NE(plan.plan, BodyKind::humanoid) << plan.reason;
}

TEST(FindPlan, RaisedArmsLeaveTheNeckBelowTheHead) {
  BodyCurve figure;
  const int chest = add_body_without_arms(figure);
  figure.add_pair(chest, {{2.2, 15.5, 0}, {2.4, 19, 0}, {2.4, 22.5, 0}}, 0.5);
  const RigSubject subject = subject_of("arms up", figure);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  ASSERT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
  expect_near(plan, "head", {0, 16.9, 0}, 0.6);
}

TEST(FindPlan, WhoLiesOnHisBackInClothesIsAHuman) {
  BodyCurve figure;
  const int hips = figure.add({0, 2.2, -1}, 1.2);
  const int chest = figure.add({0, 2.6, 5}, 1.3, hips);
  const int neck = figure.add({0, 2.6, 6.8}, 0.7, chest);
  figure.add({0, 2.4, 9}, 1.3, neck);
  figure.add_pair(hips, {{1.2, 2.2, -1.6}, {1.6, 2.4, -5}, {2, 0.6, -9}}, 0.6);
  figure.add_pair(chest, {{2, 2.6, 5}, {3.4, 2.2, 7}, {3, 0.5, 11}}, 0.5);
  RigSubject subject = subject_of("lying", figure);
  EXPECT_EQ(find_plan(subject.surface, subject.skeleton).plan, BodyKind::quadruped);
  const Eigen::VectorXi nodes = subject.skeleton.node_of_vertex;
  shapes::Shape layer;
  layer.surface = subject.surface;
  subject.surface = shapes::together("", {layer, layer, layer}).surface;
  subject.skeleton.node_of_vertex = nodes.replicate(3, 1);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  EXPECT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
}

/// Legs seem to part at the hem: the hips are where a human has them, and the knees below them.
TEST(FindPlan, AGownHidesHipsAndKnees) {
  BodyCurve figure;
  const int hem = figure.add({0, 3, 0}, 2.2);
  const int chest = figure.add({0, 15, 0}, 1.5, hem);
  figure.add({0, 18.6, 0}, 1.3, figure.add({0, 16.8, 0}, 0.6, chest));
  figure.add_pair(hem, {{1.6, 2, 0}, {1.6, 0.6, 0}, {1.6, 0.5, 3}}, 0.6);
  figure.add_pair(chest, {{2.2, 15, 0}, {5.5, 15, 0}, {8.5, 15, 0}}, 0.5);
  const RigSubject subject = subject_of("gown", figure);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  ASSERT_EQ(plan.plan, BodyKind::humanoid) << plan.reason;
  expect_near(plan, "hips", {0, 0.65 * 15, 0}, 0.5);
  expect_near(plan, "leftUpperLeg", {1.6, 0.65 * 15, 0}, 0.8);
  expect_near(plan, "rightLowerLeg", {-1.6, 0.36 * 15, 0}, 0.8);
  EXPECT_TRUE(plan.missing.empty());
}

/// A vessel that forks stands on two legs.
TEST(FindPlan, AForkIsNoAnimal) {
  BodyCurve figure;
  const int fork = figure.add({0, 10, 0}, 1);
  figure.add({0, 20, 0}, 1, fork);
  figure.add_pair(fork, {{2, 5, 0}, {2, 0.5, 0}}, 0.8);
  const RigSubject subject = subject_of("fork", figure);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  EXPECT_EQ(plan.plan, BodyKind::other) << plan.reason;
  EXPECT_TRUE(plan.joints.empty());
}

/// A robe that trails, its arms not told from it, is no animal with a tail; nor is a helmet with a
/// plume. What leans is: a bird that runs, without wings.
TEST(FindPlan, AnUprightBodyWithoutArmsHasNoTail) {
  for (const double lean : {0.0, 10.0, 20.0, 45.0, 60.0}) {
    SCOPED_TRACE(lean);
    const double turn = lean * std::numbers::pi / 180;
    const auto up_trunk = [&](double way) {
      return Eigen::RowVector3d(0, 8 + way * std::cos(turn), way * std::sin(turn));
    };
    BodyCurve figure;
    const int hips = figure.add({0, 8, 0}, 1.4);
    const int chest = figure.add(up_trunk(6), 1.5, hips);
    figure.add(up_trunk(10), 1.2, chest);
    figure.add({0, 6, -7}, 0.6, hips);
    figure.add_pair(hips, {{1.6, 7, 0}, {1.6, 4, 0}, {1.6, 0.6, 0}, {1.6, 0.5, 2}}, 0.6);
    const RigSubject subject = subject_of("no arms", figure);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, lean < 30 ? BodyKind::other : BodyKind::tailed_biped) << plan.reason;
  }
}

/// A room's corners, say.
TEST(FindPlan, SeesNoBodyWhereTheSurfaceIsNotMadeOfTubes) {
  RigSubject subject = human();
  subject.surface.positions.col(2) *= 8;  // walls, far from the curve
  PlanOptions options;
  options.made_of_tubes = false;
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton, options);
  EXPECT_EQ(plan.plan, BodyKind::other) << plan.reason;
  EXPECT_NE(plan.reason.find("tubes"), std::string::npos);
  options.plan = BodyKind::humanoid;  // all the same
  EXPECT_EQ(find_plan(subject.surface, subject.skeleton, options).plan, BodyKind::humanoid);
}

/// The same surface three times over, as of something that is put together.
RigSubject in_three(const RigSubject& subject) {
  shapes::Shape one;
  one.surface = subject.surface;
  RigSubject three = subject;
  three.surface = shapes::together("", {one, one, one}).surface;
  three.skeleton.node_of_vertex = subject.skeleton.node_of_vertex.replicate(3, 1);
  return three;
}

TEST(FindPlan, SeesNoAnimalInWhatIsPutTogether) {
  for (const RigSubject& subject : {beast(1), t_rex(), fish(1)}) {
    const RigSubject parts = in_three(subject);
    EXPECT_NE(find_plan(subject.surface, subject.skeleton).plan, BodyKind::other) << subject.name;
    const BodyPlan plan = find_plan(parts.surface, parts.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::other) << subject.name;
    EXPECT_TRUE(plan.joints.empty());
  }
  const RigSubject doll = in_three(human());
  EXPECT_EQ(find_plan(doll.surface, doll.skeleton).plan, BodyKind::humanoid);
}

TEST(FindPlan, SeesNoAnimalInLegsWithRungs) {
  for (const bool has_rungs : {false, true}) {
    BodyCurve figure;
    const int rear = figure.add({0, 10, -6}, 0.8);
    const int front = figure.add({0, 10, 6}, 0.8, rear);
    figure.add({0, 13, 9}, 0.8, front);
    figure.add_pair(rear, {{2, 9, -6}, {2, 4, -6}, {2, 0.5, -6}}, 0.5);
    figure.add_pair(front, {{2, 9, 6}, {2, 4, 6}, {2, 0.5, 6}}, 0.5);
    for (const int knee : {4, 7}) {  // of the left and the right leg behind; ahead six further on
      if (has_rungs) figure.edges.emplace_back(knee, knee + 6);
    }
    const RigSubject subject = subject_of("bench", figure);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, has_rungs ? BodyKind::other : BodyKind::quadruped) << plan.reason;
  }
}

TEST(FindPlan, CountsNoSheetWhereMostOfAnAnimalIsOneComponent) {
  const RigSubject parts = in_three(beast(1));
  PlanOptions options;
  const auto one = static_cast<std::int32_t>(parts.surface.positions.rows() / 3);
  options.sheets = {one, 2 * one};
  EXPECT_EQ(find_plan(parts.surface, parts.skeleton, options).plan, BodyKind::quadruped);
  options.sheets.push_back(0);  // a tree's leaves
  EXPECT_EQ(find_plan(parts.surface, parts.skeleton, options).plan, BodyKind::other);
  const RigSubject scan = beast(1);
  options.sheets = {0};
  EXPECT_EQ(find_plan(scan.surface, scan.skeleton, options).plan, BodyKind::quadruped);
}

TEST(FindPlan, NamesNoFinOnARod) {
  for (const RigSubject& subject : {rod(false), rod(true)}) {
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::other) << plan.reason;
  }
}

/// A block of 12 x 10 x 20 that stands on y = 0, whose upper side is narrower by this factor, with
/// the subject's curve inside.
RigSubject within_block(RigSubject subject, double narrower) {
  subject.surface = shapes::box({12, 10, 20}, 6).surface;
  Positions& positions = subject.surface.positions;
  positions.col(1).array() += 5;
  for (const int axis : {0, 2}) {
    positions.col(axis).array() *= 1 - (1 - narrower) * positions.col(1).array() / 10;
  }
  subject.skeleton.node_of_vertex.resize(positions.rows());
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    (subject.skeleton.nodes.rowwise() - positions.row(v))
        .rowwise()
        .squaredNorm()
        .minCoeff(&subject.skeleton.node_of_vertex[v]);
  }
  return subject;
}

/// Curves lead into the corners of blocks as they do into legs.
TEST(FindPlan, CornersAreNoLegs) {
  BodyCurve figure;
  const int rear = figure.add({0, 6, -3}, 0.8);
  const int front = figure.add({0, 6, 3}, 0.8, rear);
  figure.add({0, 9, 3}, 0.8, front);
  figure.add_pair(rear, {{2, 3, -5}, {3, 0.5, -6}}, 0.5);
  figure.add_pair(front, {{2, 3, 6}, {4, 0.5, 9}}, 0.5);
  const RigSubject beast = subject_of("beast", figure);
  const BodyPlan of_tubes = find_plan(beast.surface, beast.skeleton);
  EXPECT_EQ(of_tubes.plan, BodyKind::quadruped) << of_tubes.reason;
  for (const double narrower : {1.0, 0.3}) {  // of its box it fills all and .46, a ball .52
    const RigSubject block = within_block(beast, narrower);
    const BodyPlan plan = find_plan(block.surface, block.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::other) << narrower;
    EXPECT_TRUE(plan.joints.empty());
    EXPECT_NE(plan.reason.find(narrower == 1 ? "than a ball" : "air"), std::string::npos)
        << plan.reason;
  }
}

TEST(FindPlan, ABusIsNoFish) {
  const RigSubject subject = fish(1);
  const RigSubject bus = within_block(subject, 1);
  EXPECT_EQ(find_plan(subject.surface, subject.skeleton).plan, BodyKind::fish);
  const BodyPlan plan = find_plan(bus.surface, bus.skeleton);
  EXPECT_EQ(plan.plan, BodyKind::other);
  EXPECT_NE(plan.reason.find("than a ball"), std::string::npos) << plan.reason;
}

/// The middle of the box is not the body's.
TEST(FindPlan, AWeaponInOneHandHidesNoHuman) {
  const RigSubject without = human();
  const BodyPlan unarmed = find_plan(without.surface, without.skeleton);
  const auto place_of = [](const BodyPlan& plan, const std::string& role) -> Eigen::RowVector3d {
    const auto found = std::find_if(plan.joints.begin(), plan.joints.end(),
                                    [&](const PlannedJoint& joint) { return joint.role == role; });
    return found == plan.joints.end() ? Eigen::RowVector3d::Constant(1e9) : found->position;
  };
  for (const double length : {3.0, 6.0, 10.0}) {
    for (const double side : {1.0, -1.0}) {
      SCOPED_TRACE(side * length);
      BodyCurve figure;
      const int chest = add_body_without_arms(figure);
      for (const double x : {1.0, -1.0}) {
        int arm = chest;
        for (const double out : {2.2, 5.5, 8.5}) arm = figure.add({x * out, 15, 0}, 0.5, arm);
        if (x == side) figure.add({x * (9 + length), 15, 0.5}, 0.3, arm);
      }
      const RigSubject armed = subject_of("armed", figure);
      const BodyPlan plan = find_plan(armed.surface, armed.skeleton);
      ASSERT_EQ(plan.plan, BodyKind::humanoid);
      const RigSubject turned = standing_in(
          armed, frame(Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY()));  // as in Blender
      EXPECT_EQ(find_plan(turned.surface, turned.skeleton).plan, BodyKind::humanoid);
      for (const char* role : {"hips", "head", "leftUpperLeg", "rightFoot", "leftUpperArm"}) {
        const Eigen::RowVector3d off = place_of(plan, role) - place_of(unarmed, role);
        EXPECT_LT(off.norm(), 0.5) << role;  // of 20
      }
    }
  }
}

/// One leg stands farther out than the other.
TEST(FindPlan, JointsOfUnequalSidesLieOnTheirOwn) {
  BodyCurve figure;
  const int hips = figure.add({0, 10, 0}, 1.4);
  const int chest = figure.add({0, 15, 0}, 1.5, hips);
  figure.add({0, 18.6, 0}, 1.3, figure.add({0, 16.8, 0}, 0.6, chest));
  for (const double x : {1.6, -2.2}) {
    int leg = figure.add({x, 9, 0}, 0.6, hips);
    for (const auto& [y, z] : {std::pair{5.0, 0.0}, {0.6, 0.0}, {0.5, 2.0}}) {
      leg = figure.add({x, y, z}, 0.6, leg);
    }
  }
  for (const double side : {1.0, -1.0}) {
    int arm = chest;
    for (const double x : {2.2, 5.5, 8.5}) arm = figure.add({side * x, 15, 0}, 0.5, arm);
    if (side > 0) figure.add({15, 15, 0.5}, 0.3, arm);
  }
  const RigSubject subject = subject_of("unequal", figure);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  ASSERT_EQ(plan.plan, BodyKind::humanoid);
  int found = 0;
  for (const PlannedJoint& joint : plan.joints) {
    const bool is_left = joint.role == "leftLowerLeg";
    if (!is_left && joint.role != "rightLowerLeg") continue;
    ++found;
    EXPECT_NEAR(joint.position.x(), is_left ? 1.6 : -2.2, 0.15);
  }
  EXPECT_EQ(found, 2);
}

TEST(FindPlan, NamesNoHumanOnATree) {
  for (const RigSubject& subject : {tree(), snake()}) {
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::other) << subject.name;
    EXPECT_TRUE(plan.joints.empty());
    EXPECT_FALSE(plan.reason.empty());
    PlanOptions options;
    options.plan = BodyKind::humanoid;
    options.by_proportion = false;
    EXPECT_TRUE(find_plan(subject.surface, subject.skeleton, options).joints.empty());
    options.plan = BodyKind::none;
    EXPECT_EQ(find_plan(subject.surface, subject.skeleton, options).plan, BodyKind::none);
  }
}

/// Each hair a curve of its own. With more of them than a body has it is a tree or a crowd, whose
/// plan need not be looked for; whoever asks for one gets it.
TEST(FindPlan, AHumanHasAThousandHairsAtMost) {
  for (const Eigen::Index hairs : {400, 1100}) {
    RigSubject subject = human();
    CurveSkeleton& skeleton = subject.skeleton;
    const Eigen::Index nodes = skeleton.nodes.rows();
    const Eigen::Index edges = skeleton.edges.rows();
    skeleton.nodes.conservativeResize(nodes + 2 * hairs, 3);
    skeleton.radii.conservativeResize(nodes + 2 * hairs);
    skeleton.edges.conservativeResize(edges + hairs, 2);
    for (Eigen::Index k = 0; k < hairs; ++k) {
      const double side = k % 2 == 0 ? 1 : -1;
      const double turn = 0.005 * static_cast<double>(k - k % 2);
      const Eigen::Index first = nodes + 2 * k;
      skeleton.nodes.row(first) = RowVector3d(0.4 * side, 18.6, 0.4 * std::sin(turn));
      skeleton.nodes.row(first + 1) = RowVector3d(0.6 * side, 18.7, 0.6 * std::sin(turn));
      skeleton.radii.segment(first, 2).setConstant(0.01);
      skeleton.edges.row(edges + k) << static_cast<int>(first), static_cast<int>(first) + 1;
    }
    const BodyPlan plan = find_plan(subject.surface, skeleton);
    EXPECT_EQ(plan.plan, hairs < 1000 ? BodyKind::humanoid : BodyKind::other) << plan.reason;
    const BodyPlan asked = find_plan(subject.surface, skeleton, {.plan = BodyKind::humanoid});
    EXPECT_EQ(asked.plan, BodyKind::humanoid) << asked.reason;
  }
}

/// From below it would be a human who stands on the tail's end with raised arms.
TEST(FindPlan, ABirdInFlightWhoseWingsBendIsNoHuman) {
  for (const double lift : {0.5, 2.0, 3.5}) {
    SCOPED_TRACE(lift);
    BodyCurve figure;
    const int rump = figure.add({0, 8, -2}, 1);
    const int chest = figure.add({0, 8.4, 2}, 1.1, rump);
    figure.add({0, 9.4, 7.5}, 0.5, figure.add({0, 9, 5}, 0.5, chest));
    figure.add({0, 7.8, -5.5}, 0.6, rump);
    figure.add_pair(chest, {{2, 8.6, 2.2}, {6, 8.4 + lift, 2.6}, {10, 8.4 + 0.5 * lift, 1}}, 0.45);
    figure.add_pair(rump, {{0.9, 6.6, -2.6}, {1, 5.4, -4.2}, {1, 5, -6}}, 0.35);
    const RigSubject subject = subject_of("bird in flight", figure);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::bird) << plan.reason;
    EXPECT_GT(plan.axes(1, 1), 0.99) << plan.axes;
  }
}

}  // namespace
}  // namespace curveskel::plan_kind_laws
