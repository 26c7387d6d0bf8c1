// Bones lie along their limbs.
#include "rig/joints/bone_axes.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "meshes/random.hpp"

namespace curveskel::bone_axes_laws {
namespace {

/// Any hierarchy, some of whose joints lie in one place.
Rig any_rig(std::uint64_t seed, int joints) {
  shapes::Random random(seed);
  Rig rig;
  rig.joints.resize(joints, 3);
  rig.parents.resize(joints);
  for (int joint = 0; joint < joints; ++joint) {
    for (int axis = 0; axis < 3; ++axis) rig.joints(joint, axis) = random.uniform(-1, 1);
    rig.parents[joint] = joint == 0 ? -1 : static_cast<int>(random.index(idx(joint)));
    if (joint > 0 && random.uniform(0, 1) < 0.1) {
      rig.joints.row(joint) = rig.joints.row(rig.parents[joint]);
    }
    rig.names.push_back(std::to_string(joint));
  }
  return rig;
}

std::vector<int> children_of(const Rig& rig, int joint) {
  std::vector<int> children;
  for (int other = 0; other < rig.parents.size(); ++other) {
    if (rig.parents[other] == joint) children.push_back(other);
  }
  return children;
}

Eigen::Vector3d way(const Rig& rig, int from, int to) {
  return (rig.joints.row(to) - rig.joints.row(from)).transpose();
}

TEST(BoneAxes, PointToTheOnlyChildAndAtTipsStraightOn) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Rig rig = any_rig(seed, 30);
    const auto axes = bone_axes(rig);
    ASSERT_EQ(axes.size(), 30U);
    for (int joint = 0; joint < 30; ++joint) {
      const Eigen::Quaterniond& turned = axes[idx(joint)];
      EXPECT_NEAR(turned.norm(), 1, 1e-12);
      const Eigen::Vector3d bone = turned * Eigen::Vector3d::UnitY();
      const auto children = children_of(rig, joint);
      if (children.empty() && joint > 0) {
        EXPECT_LT(turned.angularDistance(axes[idx(rig.parents[joint])]), 1e-7);
      }
      if (children.size() != 1) continue;
      const Eigen::Vector3d wanted = way(rig, joint, children[0]);
      if (wanted.norm() > 0) {
        EXPECT_GT(bone.dot(wanted.normalized()), 1 - 1e-9);
      }
    }
  }
}

Rig rig_of(const std::vector<Eigen::RowVector3d>& joints, const std::vector<int>& parents,
           const std::vector<std::string>& names) {
  Rig rig;
  rig.joints.resize(static_cast<Eigen::Index>(joints.size()), 3);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    rig.joints.row(static_cast<Eigen::Index>(k)) = joints[k];
  }
  rig.parents = Eigen::Map<const Eigen::VectorXi>(parents.data(), rig.joints.rows());
  rig.names = names;
  return rig;
}

Eigen::Vector3d bone_of(const Rig& rig, int joint) {
  return bone_axes(rig)[idx(joint)] * Eigen::Vector3d::UnitY();
}

TEST(BoneAxes, OfARootPointToTheLongestLimb) {
  const Rig rig = rig_of({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 2}, {-1, 0, 0}}, {-1, 0, 0, 2, 0},
                         {"a", "b", "c", "d", "e"});
  EXPECT_LT((bone_of(rig, 0) - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

/// A palm with a thumb and three fingers, all as long; then a heel behind a long foot.
TEST(BoneAxes, OfSeveralChildrenPointToTheStraightestOrMuchLonger) {
  const Rig hand =
      rig_of({{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {.5, 1.8, 0}, {0, 2, 0}, {-.5, 1.8, 0}},
             {-1, 0, 1, 1, 1, 1}, {"arm", "palm", "thumb", "index", "middle", "little"});
  EXPECT_LT((bone_of(hand, 1) - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  const Rig foot = rig_of({{0, 4, 0}, {0, 1, 0}, {0, .7, -.4}, {0, .6, .8}, {0, .5, 2}},
                          {-1, 0, 1, 1, 3}, {"shin", "ankle", "heel", "foot", "toes"});
  EXPECT_GT(bone_of(foot, 1).z(), 0.5);
}

/// The neck is one short bone; each arm is longer, and one has more joints than the other.
TEST(BoneAxes, OfJointsInTheMirrorPlaneStayInIt) {
  const Rig chest = rig_of({{0, 0, 0}, {0, 2, 0}, {3, 2, 0}, {6, 2, 0}, {-6, 2, 0}, {0, 2.5, 0.5}},
                           {-1, 0, 1, 2, 1, 1}, {"hip", "chest", "a.L", "b.L", "a.R", "neck"});
  EXPECT_LT((bone_of(chest, 1) - Eigen::Vector3d(0, 1, 1).normalized()).norm(), 1e-12);
  const Rig ears = rig_of({{0, 0, 0}, {0, 2, 0}, {1, 3, 0}, {1, 4, 0}, {-1, 3, 0}},
                          {-1, 0, 1, 2, 1}, {"neck", "head", "ear.L", "tip.L", "ear.R"});
  EXPECT_LT((bone_of(ears, 1) - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  const Rig cross = rig_of({{0, 0, 0}, {0, 2, 0}, {3, 2, 0.1}, {-3, 2, 0.1}}, {-1, 0, 1, 1},
                           {"spine", "chest", "arm.L", "arm.R"});
  EXPECT_LT((bone_of(cross, 1) - Eigen::Vector3d::UnitY()).norm(), 1e-12) << "straight on";
}

TEST(BoneAxes, OfLimbsThatMirrorEachOtherAreMirrored) {
  const Eigen::Vector3d mirror(-1, 1, 1);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Rig left = any_rig(seed, 12);
    Rig right = left;
    right.joints.col(0) *= -1;
    const auto of_left = bone_axes(left);
    const auto of_right = bone_axes(right);
    for (std::size_t joint = 0; joint < of_left.size(); ++joint) {
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
        const Eigen::Vector3d seen = mirror.cwiseProduct(of_left[joint] * unit);
        const double sign = axis == 0 ? -1 : 1;  // a mirror image of axes is left-handed
        EXPECT_LT((sign * seen - of_right[joint] * unit).norm(), 1e-6) << "seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace curveskel::bone_axes_laws
