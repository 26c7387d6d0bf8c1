// Laws of the way a body stands: its up and its front, and the file in which it is upright.
#include <curveskel/body_plan.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/error.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/rig_polygons.hpp>
#include "rig/joints/placed_rig.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/plan_subjects.hpp"
#include "tests/soups.hpp"

namespace curveskel::plan_frame_laws {
namespace {

using Eigen::RowVector3d;

/// The usual plan of a body that stands in these axes instead.
void expect_turned(const BodyPlan& found, const BodyPlan& usual, const Eigen::Matrix3d& axes) {
  ASSERT_EQ(found.plan, usual.plan) << found.reason;
  EXPECT_LT((found.axes - axes).norm(), 1e-12) << found.axes;
  ASSERT_EQ(found.joints.size(), usual.joints.size());
  for (std::size_t k = 0; k < found.joints.size(); ++k) {
    EXPECT_EQ(found.joints[k].role, usual.joints[k].role);
    EXPECT_LT((found.joints[k].position - usual.joints[k].position * axes).norm(), 0.4);
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

/// With y or z up, looking along any other axis.
std::vector<Eigen::Matrix3d> standing_frames() {
  using Eigen::Vector3d;
  std::vector<Eigen::Matrix3d> frames;
  for (const double side : {1.0, -1.0}) {
    frames.push_back(frame(Vector3d::UnitY(), side * Vector3d::UnitZ()));
    frames.push_back(frame(Vector3d::UnitY(), side * Vector3d::UnitX()));
    frames.push_back(frame(Vector3d::UnitZ(), side * Vector3d::UnitY()));
    frames.push_back(frame(Vector3d::UnitZ(), side * Vector3d::UnitX()));
  }
  return frames;
}

TEST(FindPlan, UpAndFrontAreFound) {
  const std::vector<Eigen::Matrix3d> frames = standing_frames();
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
      expect_turned(found, usual, axes);
    }
  }
}

/// Ends of limbs, ears and heels, which have no role, are the body's own left and right, too.
TEST(PlannedRigs, JointsBeyondThePlanLieOnTheSideOfTheirName) {
  for (const RigSubject& subject : {human(), beast(1)}) {
    for (const Eigen::Matrix3d& axes : standing_frames()) {
      SCOPED_TRACE(testing::Message() << subject.name << "\n" << axes);
      const RigSubject stands = standing_in(subject, axes);
      BodyPlan plan = find_plan(stands.surface, stands.skeleton);
      ASSERT_LT((plan.axes - axes).norm(), 1e-12);
      const Rig rig = make_planned_rig(stands.surface, stands.skeleton, plan);
      int named = 0;
      for (std::size_t joint = plan.joints.size(); joint < rig.names.size(); ++joint) {
        const RowVector3d out = rig.joints.row(Eigen::Index(joint)) - rig.joints.row(0);
        const std::string& name = rig.names[joint];
        const int side = name.ends_with(".L") ? 1 : name.ends_with(".R") ? -1 : 0;
        EXPECT_GE(side * out.dot(axes.row(0)), 0) << name;
        named += side > 0 ? 1 : 0;
      }
      EXPECT_GT(named, 0);
    }
  }
}

/// A long thing is one from somewhere, so no more frames are looked at; nor is one that stands.
TEST(FindPlan, FishAreFoundWithZUpToo) {
  using Eigen::Vector3d;
  const RigSubject subject = fish(1);
  const BodyPlan usual = find_plan(subject.surface, subject.skeleton);
  EXPECT_EQ(find_plan(baluster().surface, baluster().skeleton).plan, BodyKind::fish)
      << "as it lies";
  for (const double side : {1.0, -1.0}) {
    const Eigen::Matrix3d axes = frame(Vector3d::UnitZ(), side * Vector3d::UnitY());
    const RigSubject stands = standing_in(subject, axes);
    expect_turned(find_plan(stands.surface, stands.skeleton), usual, axes);
    const RigSubject column = standing_in(baluster(), axes);
    EXPECT_EQ(find_plan(column.surface, column.skeleton).plan, BodyKind::other);
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
      expect_turned(found, usual, axes);
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

/// A front that is said holds, in shoes with the longer end behind, too.
TEST(FindPlan, AThinTailIsNoHeadHoweverHighItStands) {
  for (const double front : {1.0, -1.0}) {
    for (const double top : {9.0, 13.0, 18.0}) {
      BodyCurve figure;
      const int rump = figure.add({0, 8, -6 * front}, 1.4);
      const int withers = figure.add({0, 8, 5 * front}, 1.4, rump);
      const int neck = figure.add({0, 10.5, 8 * front}, 0.8, withers);
      figure.add({0, 11, 10.5 * front}, 1, neck);
      const int tail = figure.add({0, 8.5, -7.2 * front}, 0.4, rump);
      figure.add({0, top, -7.4 * front}, 0.3, tail);
      for (const double z : {-6.0, 5.0}) {
        figure.add_pair(z < 0 ? rump : withers, {{1.5, 6, z * front}, {1.5, 0.5, z * front}}, 0.5);
      }
      const RigSubject subject = subject_of("lifted tail", figure);
      const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
      ASSERT_EQ(plan.plan, BodyKind::quadruped) << plan.reason;
      ASSERT_NE(joint_of(plan, "head"), nullptr);
      EXPECT_GT(joint_of(plan, "head")->position.z() * front, 5) << "tail up to " << top;
      ASSERT_NE(joint_of(plan, "spine"), nullptr);
      EXPECT_LT(std::abs(joint_of(plan, "spine")->position.y() - 8), 1) << "tail up to " << top;
    }
  }
}

TEST(FindPlan, ABirdOnItsLegsIsOneWithZUpToo) {
  BodyCurve figure;
  const int hips = figure.add({0, 5, 0}, 1.2);
  const int chest = figure.add({0, 6, 2}, 1.2, hips);
  figure.add({0, 8.6, 5.6}, 0.8, figure.add({0, 8, 4}, 0.5, chest));
  figure.add({0, 4.6, -5}, 0.5, hips);
  figure.add_pair(hips, {{1, 3.5, 0}, {1, 0.5, 0}, {1, 0.4, 1.2}}, 0.3);
  figure.add_pair(chest, {{2, 6.5, 2}, {6, 7, 1.5}, {11, 7, 0}}, 0.4);
  const RigSubject bird = subject_of("bird", figure);
  for (const bool is_z_up : {false, true}) {
    const Eigen::Vector3d up = Eigen::Vector3d::Unit(is_z_up ? 2 : 1);
    const Eigen::Vector3d front = is_z_up ? Eigen::Vector3d(0, -1, 0) : Eigen::Vector3d(0, 0, 1);
    const RigSubject turned = standing_in(bird, frame(up, front));
    const BodyPlan plan = find_plan(turned.surface, turned.skeleton);
    EXPECT_EQ(plan.plan, BodyKind::bird) << plan.reason;
    EXPECT_LT((plan.axes - frame(up, front)).norm(), 1e-12) << plan.axes;
  }
}

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

}  // namespace
}  // namespace curveskel::plan_frame_laws
