// Laws of roles: what they are called, and by which joint they are held.
#include <curveskel/role_names.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/make_rig.hpp>
#include "rig/joints/bone_axes.hpp"
#include "rig/joints/sides.hpp"
#include "tests/rig/plan_subjects.hpp"

namespace curveskel::role_name_laws {
namespace {

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
  has(NameStyle::unity, {"LeftThumbProximal", "LeftThumbIntermediate", "RightThumbDistal",
                         "RightLittleIntermediate"});
  has(NameStyle::godot, {"LeftThumbMetacarpal", "LeftThumbProximal", "RightLittleIntermediate"});
  has(NameStyle::rigify, {"thumb.01.L", "f_pinky.02.R"});
  has(NameStyle::automatic, {"thumb_1.L", "thumb_3.L", "finger_pinky_2.R"});
}

/// A joint beside the plan was called "head" where the plan's had Mixamo's name.
TEST(RoleNames, AreTheRoleBearersAloneInAnyStyle) {
  const RigSubject subject = human_with_hands(3);
  const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  const Rig nameless = make_planned_rig(subject.surface, subject.skeleton, plan);
  ASSERT_GT(nameless.names.size(), plan.joints.size());
  for (const auto& style : name_styles) {
    Rig rig = nameless;
    rig.names.back() = "head";
    name_roles(rig, plan, style.value);
    for (std::size_t k = plan.joints.size(); k < rig.names.size(); ++k) {
      EXPECT_NE(rig.names[k], "head") << style.name;
    }
  }
}

TEST(RoleNames, AreUniqueAndOfTheirStyle) {
  for (const RigSubject& subject : {human(), human_with_hands(3), beast(1), tree()}) {
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    const Rig nameless = make_planned_rig(subject.surface, subject.skeleton, plan);
    for (const auto& style : name_styles) {
      Rig rig = nameless;
      name_roles(rig, plan, style.value);
      const std::set<std::string> names(rig.names.begin(), rig.names.end());
      EXPECT_EQ(names.size(), rig.names.size()) << subject.name << ' ' << style.name;
      const bool is_human = plan.plan == BodyKind::humanoid;
      EXPECT_EQ(names.count("mixamorig:LeftUpLeg") > 0,
                is_human && style.value == NameStyle::mixamo);
      EXPECT_EQ(names.count("calf_r") > 0, is_human && style.value == NameStyle::unreal);
      EXPECT_EQ(names.count("rightLowerLeg") > 0, is_human && style.value == NameStyle::vrm);
      EXPECT_EQ(names.count("RightLowerLeg") > 0,
                is_human && (style.value == NameStyle::unity || style.value == NameStyle::godot));
      EXPECT_EQ(names.count("forearm.R") > 0, is_human && style.value == NameStyle::rigify);
      EXPECT_EQ(names.count("upper_leg.L") > 0, is_human && style.value == NameStyle::automatic);
      // A limb is called after the joint of the plan that it hangs from.
      const bool says_limb = std::any_of(names.begin(), names.end(), [](const std::string& name) {
        return name.find("limb") != std::string::npos;
      });
      EXPECT_EQ(says_limb, plan.joints.empty() && style.value != NameStyle::neutral)
          << subject.name << ' ' << style.name;
    }
  }
}

// Axes and twins were those of the sides in the names, which other programs' words do not have.
TEST(RoleNames, LeaveAxesAndTwinsAsTheyAre) {
  for (const RigSubject& subject : {human(), human_with_hands(3), beast(1), tree()}) {
    const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
    const Rig nameless = make_planned_rig(subject.surface, subject.skeleton, plan);
    Rig rig = nameless;
    name_roles(rig, plan, NameStyle::automatic);
    const auto axes = bone_axes(rig);
    const std::vector<int> twins = twins_of(rig);
    for (const auto& style : name_styles) {
      Rig other = nameless;
      name_roles(other, plan, style.value);
      EXPECT_EQ(twins_of(other), twins) << subject.name << ' ' << style.name;
      const auto its = bone_axes(other);
      for (std::size_t joint = 0; joint < axes.size(); ++joint) {
        EXPECT_EQ(its[joint].coeffs(), axes[joint].coeffs()) << subject.name << ' ' << style.name;
      }
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

}  // namespace
}  // namespace curveskel::role_name_laws
