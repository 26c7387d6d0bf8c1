// Bones lie along their limbs.
#include "rig/bone_axes.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "meshes/random.hpp"
#include "surface/element_index.hpp"

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
    rig.parents[joint] = joint == 0 ? -1 : static_cast<int>(random.index(at(joint)));
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
      const Eigen::Quaterniond& turned = axes[at(joint)];
      EXPECT_NEAR(turned.norm(), 1, 1e-12);
      const Eigen::Vector3d bone = turned * Eigen::Vector3d::UnitY();
      const auto children = children_of(rig, joint);
      if (children.empty() && joint > 0) {
        EXPECT_LT(turned.angularDistance(axes[at(rig.parents[joint])]), 1e-7);
      }
      if (children.size() != 1) continue;
      const Eigen::Vector3d wanted = way(rig, joint, children[0]);
      if (wanted.norm() > 0) {
        EXPECT_GT(bone.dot(wanted.normalized()), 1 - 1e-9);
      }
    }
  }
}

TEST(BoneAxes, OfSeveralChildrenPointToTheOneThatMostHangFrom) {
  Rig rig = any_rig(1, 6);
  rig.joints << 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 2, -1, 0, 0, 0, 1, 1;
  rig.parents << -1, 0, 0, 2, 0, 3;
  const Eigen::Vector3d bone = bone_axes(rig)[0] * Eigen::Vector3d::UnitY();
  EXPECT_LT((bone - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
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
