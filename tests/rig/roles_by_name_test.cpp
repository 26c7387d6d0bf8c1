// Laws of roles that somebody else's names say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/role_names.hpp>
#include "tests/rig/plan_subjects.hpp"

namespace curveskel::roles_by_name_laws {
namespace {

Rig named_human(NameStyle style) {
  static const RigSubject subject = human_with_hands(4);
  static const BodyPlan plan = find_plan(subject.surface, subject.skeleton);
  static const Rig planned = make_planned_rig(subject.surface, subject.skeleton, plan);
  Rig rig = planned;
  name_roles(rig, plan, style);
  return rig;
}

std::size_t place_of(const Rig& rig, const std::string& role) {
  return idx(std::find(rig.roles.begin(), rig.roles.end(), role) - rig.roles.begin());
}

void replace_all(std::string& text, const std::string& found, const std::string& by) {
  for (std::size_t at = text.find(found); at != std::string::npos; at = text.find(found, at)) {
    text.replace(at, found.size(), by);
    at += by.size();
  }
}

TEST(RolesByName, AreTheRolesWhoseNamesTheJointsHaveInAnyStyle) {
  for (const auto& style : name_styles) {
    const Rig rig = named_human(style.value);
    const std::vector<std::string> none;
    EXPECT_EQ(roles_by_name(rig), style.value == NameStyle::neutral ? none : rig.roles)
        << style.name;
  }
}

TEST(RolesByName, AreTheSameInOtherCaseAndWithOtherSeparators) {
  const std::vector<std::function<void(std::string&)>> changes{
      [](std::string& name) {
        for (char& letter : name) {
          letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
        }
      },
      [](std::string& name) { replace_all(name, "_", " "); },
      [](std::string& name) { replace_all(name, "mixamorig:", "mixamorig_"); },
      [](std::string& name) { replace_all(name, "mixamorig:", "mixamorig7:"); },
      [](std::string& name) { replace_all(name, "mixamorig:", ""); },
      [](std::string& name) { name.insert(0, "hero:"); }};
  for (const NameStyle style : {NameStyle::automatic, NameStyle::mixamo, NameStyle::unreal}) {
    for (const auto& change : changes) {
      Rig rig = named_human(style);
      for (std::string& name : rig.names) change(name);
      EXPECT_EQ(roles_by_name(rig), rig.roles) << name_of(name_styles, style) << rig.names[0];
    }
  }
}

TEST(RolesByName, LeaveTheSpineToBeCalledAnything) {
  Rig rig = named_human(NameStyle::unity);
  rig.names[place_of(rig, "spine")] = "Abdomen";
  EXPECT_EQ(roles_by_name(rig), rig.roles);
}

/// The first joint above the hips was both, so the upper chest hung from no chest.
TEST(RolesByName, HaveNoJointTwice) {
  Rig rig = named_human(NameStyle::unity);
  rig.names[place_of(rig, "chest")] = "Torso";
  rig.names[place_of(rig, "spine")] = "Chest";
  rig.roles[place_of(rig, "chest")] = "";
  rig.roles[place_of(rig, "upperChest")] = "";
  EXPECT_EQ(roles_by_name(rig), rig.roles);
}

TEST(RolesByName, AreNoneWhereARequiredBoneIsCalledOtherwise) {
  for (const char* const role : required_human_roles) {
    if (std::string(role) == "spine") continue;
    Rig rig = named_human(NameStyle::unreal);
    rig.names[place_of(rig, role)] = "bone";
    EXPECT_TRUE(roles_by_name(rig).empty()) << role;
  }
}

TEST(RolesByName, AreNoneWhereTwoJointsHaveTheName) {
  Rig rig = named_human(NameStyle::unity);
  rig.names.back() = "head";
  EXPECT_TRUE(roles_by_name(rig).empty());
}

TEST(RolesByName, AreNoneWhereTheBonesHangOtherwise) {
  Rig rig = named_human(NameStyle::unity);
  const auto hand = static_cast<Eigen::Index>(place_of(rig, "leftHand"));
  rig.parents[hand] = static_cast<int>(place_of(rig, "hips"));
  EXPECT_TRUE(roles_by_name(rig).empty());
  EXPECT_TRUE(roles_by_name(Rig{}).empty());
}

}  // namespace
}  // namespace curveskel::roles_by_name_laws
