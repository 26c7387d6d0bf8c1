// Left and right: names of joints that are each other's mirror images.
#include "rig/joints/sides.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "meshes/random.hpp"

namespace curveskel::sides_laws {
namespace {

/// A trunk of five joints in the plane, with `limbs` of four joints on each side of it; what is
/// left of it has lower numbers if `left_first`.
Rig two_sided(int axis, int limbs, bool left_first, double skew = 0) {
  std::vector<Eigen::RowVector3d> places;
  Rig rig;
  std::vector<int> parents;
  const auto add = [&](const Eigen::RowVector3d& place, int parent) {
    places.push_back(place);
    parents.push_back(parent);
    rig.names.push_back("joint" + std::to_string(places.size()));
    return static_cast<int>(places.size()) - 1;
  };
  const Eigen::RowVector3d up = Eigen::RowVector3d::Unit((axis + 1) % 3);
  const Eigen::RowVector3d aside = Eigen::RowVector3d::Unit(axis);
  int trunk = add(7 * aside, -1);
  for (int k = 1; k < 5; ++k) trunk = add(7 * aside + k * up, trunk);
  for (int limb = 0; limb < limbs; ++limb) {
    for (const int side : {left_first ? 1 : -1, left_first ? -1 : 1}) {
      int joint = limb % 5;
      const double height = joint + 0.3 * static_cast<double>(limb >= 5) + skew * side;
      for (int k = 1; k <= 4; ++k) {
        const Eigen::RowVector3d root = 7 * aside + height * up;
        joint = add(root + 0.8 * side * k * aside + 0.1 * k * k * up, joint);
      }
    }
  }
  rig.joints.resize(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t k = 0; k < places.size(); ++k) {
    rig.joints.row(static_cast<Eigen::Index>(k)) = places[k];
  }
  rig.parents = Eigen::Map<Eigen::VectorXi>(parents.data(), rig.joints.rows());
  return rig;
}

std::string base_of(const std::string& name) { return name.substr(0, name.size() - 2); }

TEST(Sides, ArePairsOnEitherSideOfThePlane) {
  for (const int axis : {0, 1, 2}) {
    for (const bool left_first : {true, false}) {
      for (const int limbs : {1, 2, 7}) {
        SCOPED_TRACE(axis + 10 * limbs);
        Rig rig = two_sided(axis, limbs, left_first);
        name_sides(rig);
        std::set<std::string> left;
        std::set<std::string> right;
        for (std::size_t joint = 0; joint < rig.names.size(); ++joint) {
          const double aside = rig.joints(static_cast<Eigen::Index>(joint), axis) - 7;
          const std::string& name = rig.names[joint];
          if (joint < 5) {
            EXPECT_EQ(name, "joint" + std::to_string(joint + 1)) << "in the plane";
          } else if (aside > 0) {
            EXPECT_TRUE(name.ends_with(".L")) << name;
            left.insert(base_of(name));
          } else {
            EXPECT_TRUE(name.ends_with(".R")) << name;
            right.insert(base_of(name));
          }
        }
        EXPECT_EQ(left, right);
        EXPECT_EQ(left.size(), static_cast<std::size_t>(4 * limbs));
      }
    }
  }
}

TEST(Sides, OfAFigureThatLooksAlongMinusZChangePlacesInXAlone) {
  for (const int axis : {0, 1, 2}) {
    Rig rig = two_sided(axis, 3, true);
    Rig turned = rig;
    name_sides(rig);
    name_sides(turned, -Eigen::Vector3d::UnitX());
    for (std::size_t joint = 0; joint < rig.names.size(); ++joint) {
      std::string expected = rig.names[joint];
      if (axis == 0 && expected.ends_with(".L")) {
        expected.back() = 'R';
      } else if (axis == 0 && expected.ends_with(".R")) {
        expected.back() = 'L';
      }
      EXPECT_EQ(turned.names[joint].back(), expected.back()) << axis << ' ' << joint;
    }
  }
}

TEST(Sides, OfAPairHangFromAPairOrFromOneJoint) {
  Rig rig = two_sided(0, 6, true);
  name_sides(rig);
  const auto number_of = [&](const std::string& name) {
    return static_cast<int>(std::find(rig.names.begin(), rig.names.end(), name) -
                            rig.names.begin());
  };
  int pairs = 0;
  for (int joint = 0; joint < rig.joints.rows(); ++joint) {
    const std::string& name = rig.names[static_cast<std::size_t>(joint)];
    if (!name.ends_with(".L")) continue;
    ++pairs;
    const int other = number_of(base_of(name) + ".R");
    ASSERT_LT(other, rig.joints.rows());
    const std::string& above = rig.names[static_cast<std::size_t>(rig.parents[joint])];
    const std::string& above_other = rig.names[static_cast<std::size_t>(rig.parents[other])];
    EXPECT_TRUE(above == above_other || base_of(above) == base_of(above_other));
  }
  EXPECT_EQ(pairs, 24);
}

TEST(Sides, AreNotWhereThereIsNoMirrorImage) {
  Rig skewed = two_sided(0, 5, true, 0.6);
  const std::vector<std::string> names = skewed.names;
  name_sides(skewed);
  EXPECT_EQ(skewed.names, names);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    shapes::Random random(seed);
    Rig rig = two_sided(0, 5, true);
    for (double& coordinate : rig.joints.reshaped()) coordinate = random.uniform(0, 10);
    name_sides(rig);
    EXPECT_EQ(rig.names, names) << "seed " << seed;
  }
}

void insert(Rig& rig, int index, const Eigen::RowVector3d& place, int parent, const char* name) {
  const Eigen::Index after = rig.joints.rows() - index;
  const Positions joints = rig.joints;
  const Eigen::VectorXi parents =
      rig.parents.unaryExpr([index](int joint) { return joint >= index ? joint + 1 : joint; });
  rig.joints.resize(joints.rows() + 1, 3);
  rig.joints << joints.topRows(index), place, joints.bottomRows(after);
  rig.parents.resize(parents.size() + 1);
  rig.parents << parents.head(index), parent, parents.tail(after);
  rig.names.insert(rig.names.begin() + index, name);
}

int count_ending(const Rig& rig, const std::string& ending) {
  return static_cast<int>(
      std::count_if(rig.names.begin(), rig.names.end(),
                    [&](const std::string& name) { return name.ends_with(ending); }));
}

TEST(Sides, AreThoseOfTheFigureWhereverItsRootIs) {
  for (const int axis : {0, 1, 2}) {
    for (const double off : {-3.0, -1.5, 0.4, 2.0}) {
      SCOPED_TRACE(axis + 10 * off);
      Rig rig = two_sided(axis, 4, true);
      const Eigen::RowVector3d below = rig.joints.row(0) - Eigen::RowVector3d::Unit((axis + 1) % 3);
      insert(rig, 0, below + off * Eigen::RowVector3d::Unit(axis), -1, "root");
      rig.parents[1] = 0;
      name_sides(rig);
      EXPECT_EQ(count_ending(rig, ".L"), 16);
      EXPECT_EQ(count_ending(rig, ".R"), 16);
      for (std::size_t joint = 0; joint < rig.names.size(); ++joint) {
        const double aside = rig.joints(static_cast<Eigen::Index>(joint), axis) - 7;
        const bool is_left = rig.names[joint].ends_with(".L");
        EXPECT_EQ(is_left, joint > 5 && aside > 0) << rig.names[joint];
      }
    }
  }
}

/// One leg hangs from the trunk, the other from a part beside it that has no counterpart.
TEST(Sides, OfLimbsThatHangDifferentlyAreNamed) {
  Rig rig = two_sided(0, 2, true);
  const Eigen::RowVector3d beside = rig.joints.row(0) + Eigen::RowVector3d(1.5, 0, -2);
  const int leg = 5;
  insert(rig, leg, beside, rig.parents[leg], "washer");
  rig.parents[leg + 1] = leg;
  insert(rig, static_cast<int>(rig.joints.rows()), beside, leg, "screw");
  name_sides(rig);
  EXPECT_EQ(count_ending(rig, ".L"), 8);
  EXPECT_EQ(count_ending(rig, ".R"), 8);
}

TEST(Sides, OfOneJointAreNone) {
  Rig rig = two_sided(0, 0, true);
  rig.joints.conservativeResize(1, 3);
  rig.parents.conservativeResize(1);
  rig.names.resize(1);
  name_sides(rig);
  EXPECT_EQ(rig.names.front(), "joint1");
}

}  // namespace
}  // namespace curveskel::sides_laws
