// Laws of which body is seen in a curve, and from which side.
#include <curveskel/body_plan.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/rig_polygons.hpp>
#include "rig/joints/placed_rig.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/plan_subjects.hpp"
#include "tests/soups.hpp"

namespace curveskel::plan_kind_laws {
namespace {

using Eigen::RowVector3d;

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

/// `axes`: rows to the left, up and ahead, in which the subject stands as it is made.
RigSubject standing_in(RigSubject subject, const Eigen::Matrix3d& axes) {
  subject.surface.positions *= axes;
  subject.skeleton.nodes *= axes;
  return subject;
}

Eigen::Matrix3d frame(const Eigen::Vector3d& up, const Eigen::Vector3d& front) {
  Eigen::Matrix3d axes;
  axes << up.cross(front).transpose(), up.transpose(), front.transpose();
  return axes;
}

/// With y or z up, looking along any other axis. A tail's biped stands with its toes to no side.
TEST(FindPlan, UpAndFrontAreFound) {
  using Eigen::Vector3d;
  std::vector<Eigen::Matrix3d> frames;
  for (const double side : {1.0, -1.0}) {
    frames.push_back(frame(Vector3d::UnitY(), side * Vector3d::UnitZ()));
    frames.push_back(frame(Vector3d::UnitY(), side * Vector3d::UnitX()));
    frames.push_back(frame(Vector3d::UnitZ(), side * Vector3d::UnitY()));
    frames.push_back(frame(Vector3d::UnitZ(), side * Vector3d::UnitX()));
  }
  for (const RigSubject& subject : {human(), beast(1)}) {
    const BodyPlan usual = find_plan(subject.surface, subject.skeleton);
    ASSERT_NE(usual.plan, BodyKind::other);
    bool z_is_up = false;  // right or wrong
    for (const Eigen::Matrix3d& axes : frames) {
      SCOPED_TRACE(testing::Message() << subject.name << "\n" << axes);
      const RigSubject stands = standing_in(subject, axes);
      PlanOptions options;
      options.z_is_up = z_is_up;
      z_is_up = !z_is_up;
      const BodyPlan found = find_plan(stands.surface, stands.skeleton, options);
      EXPECT_EQ(found.plan, usual.plan) << found.reason;
      EXPECT_LT((found.axes - axes).norm(), 1e-12) << found.axes;
      ASSERT_EQ(found.joints.size(), usual.joints.size());
      for (std::size_t k = 0; k < found.joints.size(); ++k) {
        EXPECT_EQ(found.joints[k].role, usual.joints[k].role);
        EXPECT_LT((found.joints[k].position - usual.joints[k].position * axes).norm(), 0.4);
      }
    }
  }
}

// Of a scan with z up the file lay down, as glTF has y up.
TEST(Upright, IsTheFileOfASurfaceWithZUp) {
  const Surface standing = human().surface;
  Surface scan = standing;
  scan.positions << standing.positions.col(0), -standing.positions.col(2),
      standing.positions.col(1);
  for (const SurfaceFormat format : {SurfaceFormat::stl, SurfaceFormat::obj, SurfaceFormat::glb}) {
    PolygonSoup soup = soup_of(scan);
    soup.format = format;
    const PolygonsRig found = rig_polygons(soup);
    ASSERT_EQ(found.character.plan.plan, BodyKind::humanoid) << found.character.plan.reason;
    const Eigen::Matrix3d& turn = found.character.rig.to_y_up;
    const bool states_up = format == SurfaceFormat::glb;
    const Surface& wanted = states_up ? scan : standing;
    EXPECT_LT((scan.positions * turn.transpose() - wanted.positions).norm(), 1e-12);
    EXPECT_EQ(format_rig(scan, found.character.rig, RigFormat::glb, "a", "b"),
              format_rig(wanted, placed(found.character.rig, Eigen::Affine3d(turn)), RigFormat::glb,
                         "a", "b"));
  }
  PolygonSoup upright = soup_of(standing);
  EXPECT_TRUE(rig_polygons(upright).character.rig.to_y_up.isIdentity(0));
}

/// FBX and COLLADA say which way is up, and how long their unit is; joints alone keep the input's
/// numbers.
TEST(Upright, IsTheBareFileOfWhatStatesItsAxesAndUnit) {
  const Surface standing = human().surface;
  PolygonSoup soup = soup_of(standing);
  soup.positions << standing.positions.col(0), -standing.positions.col(2),
      standing.positions.col(1);
  soup.positions *= 100;
  soup.format = SurfaceFormat::fbx;
  soup.z_is_up = true;
  soup.to_gltf << 0.01, 0, 0, 0, 0, 0.01, 0, -0.01, 0;
  const Rig rig = rig_polygons(soup).character.rig;
  EXPECT_EQ(rig.to_y_up, soup.to_gltf);
  const Surface given{soup.positions, standing.triangles};
  const OwnFolder folder;
  const double size = standing.positions.norm();
  for (const RigFormat format : {RigFormat::glb, RigFormat::fbx}) {
    const std::string bytes = format_rig(given, rig, format, "a", "b");
    const auto file = folder.write("a." + std::string(name_of(rig_formats, format)), bytes);
    const PolygonSoup seen = read_polygons(file);
    EXPECT_LT((seen.positions * seen.to_gltf.transpose() - standing.positions).norm(), 1e-6 * size);
    const Rig joints = read_joints(file, {});
    EXPECT_NEAR(joints.joints.col(1).maxCoeff(), 0.01 * rig.joints.col(2).maxCoeff(), 1e-6 * size);
  }
  const Surface metres{given.positions * rig.to_y_up.transpose(), given.triangles};
  const Rig upright = placed(rig, Eigen::Affine3d(rig.to_y_up));
  EXPECT_EQ(format_rig(given, rig, RigFormat::usda, "a", "b"),
            format_rig(metres, upright, RigFormat::usda, "a", "b"));
  Rig unturned = rig;
  unturned.to_y_up.setIdentity();
  for (const RigFormat format : {RigFormat::json, RigFormat::npz, RigFormat::txt, RigFormat::bvh}) {
    EXPECT_EQ(format_rig(given, rig, format, "a", "b"),
              format_rig(given, unturned, format, "a", "b"));
  }
}

/// On its back, its front or a side, in a file with y or z up.
TEST(FindPlan, ALyingBodyIsWhatItIsUpright) {
  using Eigen::Vector3d;
  std::vector<Eigen::Matrix3d> frames;
  for (const double side : {1.0, -1.0}) {
    frames.push_back(frame(side * Vector3d::UnitX(), Vector3d::UnitY()));
    frames.push_back(frame(side * Vector3d::UnitX(), -Vector3d::UnitZ()));
    frames.push_back(frame(-Vector3d::UnitZ(), side * Vector3d::UnitY()));
    frames.push_back(frame(-Vector3d::UnitZ(), side * Vector3d::UnitX()));
  }
  for (const RigSubject& subject : {human(), beast(1)}) {
    const BodyPlan usual = find_plan(subject.surface, subject.skeleton);
    for (const Eigen::Matrix3d& axes : frames) {
      SCOPED_TRACE(testing::Message() << subject.name << "\n" << axes);
      const RigSubject lies = standing_in(subject, axes);
      const BodyPlan found = find_plan(lies.surface, lies.skeleton);
      ASSERT_EQ(found.plan, usual.plan) << found.reason;
      EXPECT_LT((found.axes - axes).norm(), 1e-12) << found.axes;
      ASSERT_EQ(found.joints.size(), usual.joints.size());
      for (std::size_t k = 0; k < found.joints.size(); ++k) {
        EXPECT_EQ(found.joints[k].role, usual.joints[k].role);
        EXPECT_LT((found.joints[k].position - usual.joints[k].position * axes).norm(), 0.4);
      }
      PlanOptions options;
      options.up = Direction::y;  // what is said holds
      EXPECT_NE(find_plan(lies.surface, lies.skeleton, options).plan, usual.plan);
    }
  }
}

TEST(Upright, IsNoFileOfALyingBody) {
  RigSubject lies = standing_in(human(), frame(Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()));
  const PolygonsRig found = rig_polygons(soup_of(lies.surface));
  EXPECT_EQ(found.character.plan.plan, BodyKind::humanoid) << found.character.plan.reason;
  EXPECT_TRUE(found.character.rig.to_y_up.isIdentity(0));
}

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

TEST(FindPlan, ABipedWithATailIsOneWithZUpToo) {
  const RigSubject subject = t_rex();
  const RigSubject stands =
      standing_in(subject, frame(Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY()));
  for (const RigSubject& one : {subject, stands}) {
    const BodyPlan plan = find_plan(one.surface, one.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::tailed_biped) << plan.reason;
  }
}

TEST(FindPlan, ABipedWithATailLooksWhereItsToesPoint) {
  const RigSubject back =
      standing_in(t_rex(), frame(Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ()));
  const BodyPlan plan = find_plan(back.surface, back.skeleton);
  EXPECT_EQ(plan.plan, BodyKind::tailed_biped) << plan.reason;
  EXPECT_EQ(plan.axes(2, 2), -1);
}

/// Low, long, on short legs that stand out to the sides.
RigSubject lizard() {
  BodyCurve figure;
  const int rump = figure.add({0, 1.6, -3}, 0.8);
  const int withers = figure.add({0, 1.6, 4}, 0.8, rump);
  figure.add({0, 1.8, 9}, 0.6, figure.add({0, 1.8, 6.5}, 0.5, withers));
  figure.add({0, 1, -11}, 0.3, rump);
  for (const int root : {rump, withers}) {
    const double z = figure.places[idx(root)].z();
    figure.add_pair(root, {{1.4, 1.5, z}, {2.1, 0.3, z}}, 0.25);
  }
  return subject_of("lizard", figure);
}

TEST(FindPlan, SprawlsOnFourLegs) {
  const RigSubject subject = lizard();
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  EXPECT_EQ(plan.plan, BodyKind::quadruped) << plan.reason;
  EXPECT_EQ(plan.axes(2, 2), 1);
}

/// Its rump is a little higher than its head is, and it has horns: at which end is told by what is
/// long, not by how many signs there are. Seen from both sides, as the usual look may be right.
TEST(FindPlan, HornsOutweighAHighRump) {
  for (const double front : {1.0, -1.0}) {
    BodyCurve figure;
    const int rump = figure.add({0, 8.2, -6 * front}, 1.4);
    const int withers = figure.add({0, 8, 5 * front}, 1.4, rump);
    const int poll = figure.add({0, 8.2, 8 * front}, 0.8, withers);
    figure.add({0, 7, 11 * front}, 0.8, poll);
    const int tail = figure.add({0, 8.8, -8 * front}, 0.5, rump);
    figure.add({0, 4, -10 * front}, 0.4, tail);
    figure.add_pair(rump, {{1.5, 6, -6 * front}, {1.5, 3, -6 * front}, {1.5, 0.5, -6 * front}},
                    0.5);
    figure.add_pair(withers, {{1.5, 6, 5 * front}, {1.5, 3, 5 * front}, {1.5, 0.5, 5 * front}},
                    0.5);
    figure.add_pair(poll, {{3, 8.2, 8 * front}}, 0.3);
    const RigSubject subject = subject_of("cow", figure);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::quadruped) << plan.reason;
    EXPECT_EQ(plan.axes(2, 2), front);
  }
}

/// With its tail lifted above its back, as a dog's, and without ears: the paws say it.
TEST(FindPlan, PawsOutweighALiftedTail) {
  for (const double front : {1.0, -1.0}) {
    BodyCurve figure;
    const int rump = figure.add({0, 8, -6 * front}, 1.4);
    const int withers = figure.add({0, 8, 5 * front}, 1.4, rump);
    figure.add({0, 8, 10 * front}, 0.9, withers);
    figure.add({0, 9.4, -10 * front}, 0.4, rump);
    for (const auto& [root, z] : {std::pair(rump, -6.0), std::pair(withers, 5.0)}) {
      figure.add_pair(
          root, {{1.5, 5, z * front}, {1.5, 0.5, z * front}, {1.5, 0.5, (z + 2) * front}}, 0.5);
    }
    const RigSubject subject = subject_of("dog", figure);
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::quadruped) << plan.reason;
    EXPECT_EQ(plan.axes(2, 2), front);
  }
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

/// A front that is said holds, in shoes with the longer end behind, too.
TEST(FindPlan, ToesDoNotOverruleWhatIsSaid) {
  const RigSubject back =
      standing_in(human(), frame(Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ()));
  PlanOptions options;
  options.front = Direction::z;
  EXPECT_EQ(find_plan(back.surface, back.skeleton, options).axes(2, 2), 1);
  const RigSubject subject = human();
  options.front = Direction::automatic;
  options.faces_minus_z = true;
  EXPECT_EQ(find_plan(subject.surface, subject.skeleton, options).axes(2, 2), -1);
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

/// A room's corners, say.
TEST(FindPlan, SeesNoBodyWhereTheSurfaceIsNotMadeOfTubes) {
  const RigSubject subject = human();
  PlanOptions options;
  options.made_of_tubes = false;
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton, options);
  EXPECT_EQ(plan.plan, BodyKind::other);
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
    EXPECT_TRUE(find_plan(subject.surface, subject.skeleton, options).joints.empty());
    options.plan = BodyKind::none;
    EXPECT_EQ(find_plan(subject.surface, subject.skeleton, options).plan, BodyKind::none);
  }
}

}  // namespace
}  // namespace curveskel::plan_kind_laws
