// Laws of components that meet: bodies made of boxes hang together as a person would hang them.
#include "rig/joints/contacts.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stop_token>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rig_polygons.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::contact_laws {
namespace {

struct Box {
  Eigen::Vector3d low, high;
};

/// Each a component of six sides, or of five without its top.
PolygonSoup soup_of_boxes(const std::vector<Box>& boxes, bool is_open, const Eigen::Affine3d& to) {
  constexpr std::int32_t sides[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                        {0, 2, 6, 4}, {1, 5, 7, 3}, {2, 3, 7, 6}};
  PolygonSoup soup;
  soup.positions.resize(static_cast<Eigen::Index>(8 * boxes.size()), 3);
  soup.offsets.push_back(0);
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const auto first = static_cast<std::int32_t>(8 * k);
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d place((corner & 4) != 0 ? boxes[k].high.x() : boxes[k].low.x(),
                                  (corner & 2) != 0 ? boxes[k].high.y() : boxes[k].low.y(),
                                  (corner & 1) != 0 ? boxes[k].high.z() : boxes[k].low.z());
      soup.positions.row(first + corner) = (to * place).transpose();
    }
    for (int side = 0; side < (is_open ? 5 : 6); ++side) {
      for (const std::int32_t corner : sides[side]) soup.corners.push_back(first + corner);
      soup.offsets.push_back(static_cast<std::int64_t>(soup.corners.size()));
    }
  }
  return soup;
}

void add_pair(std::vector<Box>& boxes, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  boxes.push_back({low, high});
  boxes.push_back({{-high.x(), low.y(), low.z()}, {-low.x(), high.y(), high.z()}});
}

/// As of Minetest: the head a cube, arms and legs lie along trunk and each other.
std::vector<Box> blocky(double gap, double arm) {
  std::vector<Box> boxes{{{-4, 12, -2}, {4, 24, 2}}, {{-4, 24 + gap, -4}, {4, 32 + gap, 4}}};
  add_pair(boxes, {4 + gap, 24 - arm, -2}, {8 + gap, 24, 2});
  add_pair(boxes, {std::max(0.0, 0.5 * gap), 0, -2}, {4, 12 - gap, 2});
  return boxes;
}

int joint_of(const Rig& rig, const std::string& role) {
  const auto found = std::find(rig.names.begin(), rig.names.end(), role);
  return found == rig.names.end() ? -1 : static_cast<int>(found - rig.names.begin());
}

bool hangs_from(const Rig& rig, int joint, int above) {
  while (joint >= 0 && joint != above) joint = rig.parents[joint];
  return joint >= 0;
}

void expect_human(const PolygonSoup& soup) {
  const PolygonsRig found = rig_polygons(soup);
  const Rig& rig = found.character.rig;
  ASSERT_EQ(found.character.plan.plan, BodyKind::humanoid) << found.character.plan.reason;
  const int hips = joint_of(rig, "hips");
  const int chest = joint_of(rig, "chest");
  EXPECT_TRUE(hangs_from(rig, chest, hips));
  EXPECT_TRUE(hangs_from(rig, joint_of(rig, "head"), chest));
  for (const std::string side : {".L", ".R"}) {
    const int leg = joint_of(rig, "upper_leg" + side);
    const int hand = joint_of(rig, "hand" + side);
    ASSERT_GE(hand, 0);
    EXPECT_TRUE(hangs_from(rig, hand, chest));
    EXPECT_FALSE(hangs_from(rig, hand, leg));
    EXPECT_TRUE(hangs_from(rig, joint_of(rig, "foot" + side), leg));
    const Eigen::RowVector3d shoulder = rig.joints.row(joint_of(rig, "upper_arm" + side));
    const Eigen::RowVector3d head = rig.joints.row(joint_of(rig, "head"));
    EXPECT_LT((shoulder - head).norm(), (rig.joints.row(hand) - head).norm());
  }
}

TEST(Contacts, MakeAHumanOfBoxesThatTouchOverlapOrNearlyTouch) {
  for (const double gap : {0.0, 0.3, -0.4}) {
    for (const double arm : {11.0, 12.0}) {
      SCOPED_TRACE(testing::Message() << gap << ' ' << arm);
      expect_human(soup_of_boxes(blocky(gap, arm), false, Eigen::Affine3d::Identity()));
    }
  }
}

/// Crowds have hundreds of thousands of pairs.
TEST(Contacts, AreLookedForUntilSomebodyStopsThat) {
  const PolygonSoup soup = soup_of_boxes(blocky(0, 12), false, Eigen::Affine3d::Identity());
  const RepairedSurface repaired = repair(soup);
  const CurveSkeleton skeleton = extract(repaired.surface).skeleton;
  std::stop_source stopped;
  EXPECT_FALSE(contacts_of(repaired.surface, skeleton, stopped.get_token()).empty());
  stopped.request_stop();
  EXPECT_THROW((void)contacts_of(repaired.surface, skeleton, stopped.get_token()), Cancelled);
}

/// The arms reach down beside the thighs.
TEST(Contacts, LeaveAHandOnItsArmThatIsNearTheThigh) {
  for (const double gap : {0.0, 0.3}) {
    for (const double arm : {13.0, 14.0}) {
      SCOPED_TRACE(testing::Message() << gap << ' ' << arm);
      expect_human(soup_of_boxes(blocky(gap, arm), false, Eigen::Affine3d::Identity()));
    }
  }
}

TEST(Contacts, MakeAHumanOfOpenBoxes) {
  expect_human(soup_of_boxes(blocky(0.2, 12), true, Eigen::Affine3d::Identity()));
}

TEST(Contacts, AreTheSameOfATurnedAScaledAndAMirroredBody) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::AngleAxisd lying(0.5 * std::numbers::pi, Eigen::Vector3d::UnitX());
  const Eigen::AngleAxisd aside(0.5 * std::numbers::pi, Eigen::Vector3d::UnitY());
  const Eigen::DiagonalMatrix<double, 3> mirrored(-1, 1, 1);
  for (const auto& boxes : {blocky(0, 12), blocky(0.3, 14)}) {
    expect_human(soup_of_boxes(boxes, false, Eigen::Affine3d(lying)));
    expect_human(soup_of_boxes(boxes, false, Eigen::Affine3d(aside)));
    expect_human(soup_of_boxes(boxes, false, Eigen::Affine3d(Eigen::Scaling(0.01))));
    expect_human(soup_of_boxes(boxes, false, Eigen::Translation3d(3 * z) * Eigen::Scaling(100.0)));
    expect_human(soup_of_boxes(boxes, false, Eigen::Affine3d(mirrored.toDenseMatrix())));
  }
}

/// A cube has no axis: its bone goes on from the neck, not across.
TEST(Contacts, TurnACubeToWhatItHangsFrom) {
  for (const double gap : {0.0, 0.3}) {
    const PolygonsRig found =
        rig_polygons(soup_of_boxes(blocky(gap, 12), false, Eigen::Affine3d::Identity()));
    const Rig& rig = found.character.rig;
    const int head = joint_of(rig, "head");
    ASSERT_GE(head, 0);
    for (Eigen::Index joint = 0; joint < rig.joints.rows(); ++joint) {
      if (!hangs_from(rig, static_cast<int>(joint), head)) continue;
      EXPECT_LT(std::abs(rig.joints(joint, 0)), 0.4) << rig.names[idx(static_cast<int>(joint))];
      EXPECT_LT(std::abs(rig.joints(joint, 2)), 0.4) << rig.names[idx(static_cast<int>(joint))];
    }
  }
}

/// The farthest that a joint lies from both curves.
double farthest_from(const Rig& rig, const Positions& one, const Positions& other) {
  double farthest = 0;
  for (const auto& joint : rig.joints.rowwise()) {
    const double off = std::min((one.rowwise() - joint).rowwise().norm().minCoeff(),
                                (other.rowwise() - joint).rowwise().norm().minCoeff());
    farthest = std::max(farthest, off);
  }
  return farthest;
}

/// As trousers below a shirt, or a snake's coil behind its head: such a part spreads across the
/// line through its tips as far as along it, like a cube, but its curve says where it goes.
TEST(Contacts, LeaveABentPartOnItsCourse) {
  constexpr double radius = 0.3;
  for (const double degrees : {120.0, 180.0, 240.0, 300.0}) {
    SCOPED_TRACE(degrees);
    const auto bend = shapes::arc(1.5, degrees * std::numbers::pi / 180);
    const shapes::Shape part = shapes::tube("bend", bend, shapes::constant(radius), 16);
    const Eigen::Vector3d middle = bend(0.5);
    const Eigen::Vector3d away = (2 * middle - bend(0) - bend(1)).normalized();
    const auto trunk = [&](double t) {
      return Eigen::Vector3d(middle + (1.9 * radius + 3 * t) * away);
    };
    const shapes::Shape above = shapes::tube("trunk", trunk, shapes::constant(radius), 16);
    const PolygonsRig found = rig_polygons(soup_of(shapes::together("", {part, above}).surface));
    const Rig& rig = found.character.rig;
    EXPECT_GT(rig.joints.rows(), 6);
    EXPECT_LT(farthest_from(rig, part.axis.nodes, above.axis.nodes), radius);
  }
}

}  // namespace
}  // namespace curveskel::contact_laws
