#include <curveskel/role_names.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "base/option_ranges.hpp"
#include "rig/joints/sound_rig.hpp"
#include "rig/plan/limb_names.hpp"
#include "rig/plan/role_words.hpp"

namespace curveskel {
namespace {

/// The words for one role; of a side the left ones.
struct HumanWords {
  std::string_view role;
  std::string_view readable;
  std::string_view mixamo;
  std::string_view unreal;
  std::string_view unity;
  std::string_view rigify;
};

constexpr std::array<HumanWords, 16> human_words{{
    {"hips", "hips", "mixamorig:Hips", "pelvis", "Hips", "spine"},
    {"spine", "spine", "mixamorig:Spine", "spine_01", "Spine", "spine.001"},
    {"chest", "chest", "mixamorig:Spine1", "spine_02", "Chest", "spine.002"},
    {"upperChest", "upper_chest", "mixamorig:Spine2", "spine_03", "UpperChest", "spine.003"},
    {"neck", "neck", "mixamorig:Neck", "neck_01", "Neck", "spine.004"},
    {"head", "head", "mixamorig:Head", "head", "Head", "spine.006"},
    {"leftShoulder", "shoulder.L", "mixamorig:LeftShoulder", "clavicle_l", "LeftShoulder",
     "shoulder.L"},
    {"leftUpperArm", "upper_arm.L", "mixamorig:LeftArm", "upperarm_l", "LeftUpperArm",
     "upper_arm.L"},
    {"leftLowerArm", "lower_arm.L", "mixamorig:LeftForeArm", "lowerarm_l", "LeftLowerArm",
     "forearm.L"},
    {"leftHand", "hand.L", "mixamorig:LeftHand", "hand_l", "LeftHand", "hand.L"},
    {"leftUpperLeg", "upper_leg.L", "mixamorig:LeftUpLeg", "thigh_l", "LeftUpperLeg", "thigh.L"},
    {"leftLowerLeg", "lower_leg.L", "mixamorig:LeftLeg", "calf_l", "LeftLowerLeg", "shin.L"},
    {"leftFoot", "foot.L", "mixamorig:LeftFoot", "foot_l", "LeftFoot", "foot.L"},
    {"leftToes", "toes.L", "mixamorig:LeftToeBase", "ball_l", "LeftToes", "toe.L"},
    {"jaw", "jaw", "mixamorig:Jaw", "jaw", "Jaw", "jaw"},
    {"leftEye", "eye.L", "mixamorig:LeftEye", "eye_l", "LeftEye", "eye.L"},
}};

/// Of fingers; each joint has the word's number, counted from 1.
struct FingerWords {
  std::string_view role;  ///< after the side, before the joint
  std::string_view mixamo;
  std::string_view unreal;
  std::string_view rigify;
};

constexpr std::array<FingerWords, 5> finger_words{{
    {"Thumb", "Thumb", "thumb", "thumb"},
    {"Index", "Index", "index", "f_index"},
    {"Middle", "Middle", "middle", "f_middle"},
    {"Ring", "Ring", "ring", "f_ring"},
    {"Little", "Pinky", "pinky", "f_pinky"},
}};

struct BeastWords {
  std::string_view role;
  std::string_view readable;
  std::string_view wolf;
};

constexpr std::array<BeastWords, 7> beast_words{{
    {"spine", "hips", "spine.004"},
    {"spine.001", "spine.001", "spine.005"},
    {"spine.002", "spine.002", "spine.006"},
    {"chest", "chest", "spine.008"},
    {"neck", "neck", "spine.009"},
    {"neck.001", "neck.001", "spine.010"},
    {"head", "head", "spine.011"},
}};

/// Rigify's words for the limbs of animals; of pairs the left one.
constexpr std::array beast_limbs{"jaw",
                                 "tail",
                                 "tail.001",
                                 "tail.002",
                                 "tail.003",
                                 "tail.004",
                                 "tail.005",
                                 "tail.006",
                                 "pectoral_fin.L",
                                 "pectoral_fin.001.L",
                                 "pelvic_fin.L",
                                 "pelvic_fin.001.L",
                                 "fluke.L",
                                 "dorsal_fin",
                                 "anal_fin",
                                 "pelvis.L",
                                 "thigh.L",
                                 "shin.L",
                                 "foot.L",
                                 "toe.L",
                                 "front_thigh.L",
                                 "front_shin.L",
                                 "front_foot.L",
                                 "front_toe.L",
                                 "shoulder.L",
                                 "upper_arm.L",
                                 "forearm.L",
                                 "hand.L"};

std::string right_of(std::string name) {
  const auto swap_end = [&](std::string_view left, std::string_view right) {
    if (!name.ends_with(left)) return false;
    name.replace(name.size() - left.size(), left.size(), right);
    return true;
  };
  if (swap_end(".L", ".R") || swap_end("_l", "_r")) return name;
  const std::size_t at = name.find("Left");
  if (at != std::string::npos) name.replace(at, 4, "Right");
  return name;
}

std::string_view word(const HumanWords& words, NameStyle style) {
  switch (style) {
    case NameStyle::mixamo:
      return words.mixamo;
    case NameStyle::unreal:
      return words.unreal;
    case NameStyle::unity:
    case NameStyle::godot:
      return words.unity;
    case NameStyle::rigify:
      return words.rigify;
    default:
      return words.readable;
  }
}

/// Of a left finger's joint, or nothing.
std::string finger_name(std::string_view left, NameStyle style) {
  constexpr std::array<std::string_view, 5> joints{"Metacarpal", "Proximal", "Intermediate",
                                                   "Distal", ""};
  left.remove_prefix(std::min<std::size_t>(4, left.size()));
  for (const FingerWords& words : finger_words) {
    if (!left.starts_with(words.role)) continue;
    const auto at = std::find(joints.begin(), joints.end(), left.substr(words.role.size()));
    const auto joint = at - joints.begin();
    const std::string number =
        std::to_string(words.role == "Thumb" ? std::min<std::ptrdiff_t>(joint + 1, 3) : joint);
    const auto with = [&](std::string_view before, std::string_view word, std::string_view after) {
      return std::string(before).append(word).append(after);
    };
    switch (style) {
      case NameStyle::mixamo:
        return with("mixamorig:LeftHand", words.mixamo, number);
      case NameStyle::unreal:
        return with(words.unreal, "_0" + number, "_l");
      case NameStyle::unity:
        // Its thumbs have joints as the other fingers do.
        return words.role == "Thumb" && joint < 2
                   ? with("Left", words.role, joints[static_cast<std::size_t>(joint) + 1])
                   : with("Left", left, "");
      case NameStyle::godot:
        return with("Left", left, "");
      case NameStyle::rigify:
        return with(words.rigify, ".0" + number, ".L");
      default:
        return with(words.rigify == "thumb" ? "" : "finger_", words.unreal, "_" + number + ".L");
    }
  }
  return "";
}

std::string human_name(const std::string& role, NameStyle style) {
  if (style == NameStyle::vrm) return role;
  const bool is_right = role.starts_with("right");
  const std::string left = is_right ? "left" + role.substr(5) : role;
  for (const HumanWords& words : human_words) {
    if (words.role != left) continue;
    const std::string name(word(words, style));
    return is_right ? right_of(name) : name;
  }
  const std::string finger = finger_name(left, style);
  if (finger.empty()) return role;
  return is_right ? right_of(finger) : finger;
}

std::string beast_name(const std::string& role, NameStyle style) {
  for (const BeastWords& words : beast_words) {
    if (words.role == role) {
      return std::string(style == NameStyle::rigify ? words.wolf : words.readable);
    }
  }
  return role;
}

}  // namespace

std::string right_role(const std::string& role) {
  if (role.starts_with("left")) return "right" + role.substr(4);
  if (role.ends_with(".L")) return role.substr(0, role.size() - 1) + "R";
  return role;
}

std::string name_of_role(const std::string& role, BodyKind kind, NameStyle style) {
  if (kind == BodyKind::fish && role == "spine" && style != NameStyle::rigify) return "body";
  return kind == BodyKind::humanoid ? human_name(role, style) : beast_name(role, style);
}

namespace {

std::string numbered(std::size_t number) {
  std::array<char, 24> text{};
  const int length = std::snprintf(text.data(), text.size(), "joint_%03zu", number);
  return {text.data(), static_cast<std::size_t>(length)};
}

}  // namespace

bool has_words(NameStyle style, BodyKind kind) {
  if (style == NameStyle::automatic || style == NameStyle::neutral) return true;
  if (style == NameStyle::rigify) return kind == BodyKind::humanoid || kind == BodyKind::quadruped;
  return kind == BodyKind::humanoid;
}

namespace {

/// The plan's joints in the style's words; the others keep theirs.
void name_plan(std::vector<std::string>& names, const BodyPlan& plan, NameStyle words) {
  std::set<std::string> taken;
  for (std::size_t k = 0; k < plan.joints.size(); ++k) {
    names[k] = name_of_role(plan.joints[k].role, plan.plan, words);
    taken.insert(names[k]);
    // A hat on the head is no head in any style.
    taken.insert(name_of_role(plan.joints[k].role, plan.plan, NameStyle::automatic));
  }
  for (std::size_t k = plan.joints.size(); k < names.size(); ++k) {
    while (!taken.insert(names[k]).second) names[k].insert(0, "extra_");
  }
}

/// One joint's role is another. The namesake, if there is one, gets the name that it had.
void rename(std::vector<std::string>& names, std::size_t at, const std::string& name) {
  const auto namesake = std::find(names.begin(), names.end(), name);
  if (namesake != names.end()) *namesake = names[at];
  names[at] = name;
}

}  // namespace

void name_roles(Rig& rig, const BodyPlan& plan, NameStyle style) {
  OptionCheck("name_roles").choice("style", style, name_styles);
  require_sound(rig, "name_roles");
  if (plan.joints.size() > rig.names.size()) {
    throw Error(Fault::input, "name_roles: the plan has " + std::to_string(plan.joints.size()) +
                                  " joints, needed no more than the rig's " +
                                  std::to_string(rig.names.size()));
  }
  std::vector<std::string> readable;
  for (const PlannedJoint& joint : plan.joints) {
    readable.push_back(name_of_role(joint.role, plan.plan, NameStyle::automatic));
  }
  name_limbs(rig, plan, readable);
  std::vector<std::string> styled = rig.names;
  name_plan(rig.names, plan, NameStyle::automatic);
  rig.readable.clear();
  if (style == NameStyle::automatic) return;
  rig.readable = std::move(rig.names);
  if (style == NameStyle::neutral) {
    for (std::size_t k = 0; k < styled.size(); ++k) styled[k] = numbered(k + 1);
  } else {
    name_plan(styled, plan, has_words(style, plan.plan) ? style : NameStyle::automatic);
  }
  rig.names = std::move(styled);
}

std::vector<std::string> roles_of(BodyKind kind) {
  std::vector<std::string> roles;
  const auto add = [&](const std::string& role, const std::string& other_side) {
    roles.push_back(role);
    if (other_side != role) roles.push_back(other_side);
  };
  if (kind == BodyKind::none || kind == BodyKind::automatic) return roles;
  if (kind != BodyKind::humanoid) {
    for (const BeastWords& words : beast_words) roles.emplace_back(words.role);
    for (const std::string role : beast_limbs) add(role, right_role(role));
    return roles;
  }
  for (const HumanWords& words : human_words) {
    add(std::string(words.role), right_role(std::string(words.role)));
  }
  for (const FingerWords& words : finger_words) {
    const bool is_thumb = words.role == "Thumb";
    for (const char* joint :
         {is_thumb ? "Metacarpal" : "Proximal", is_thumb ? "Proximal" : "Intermediate", "Distal"}) {
      const std::string role = "left" + std::string(words.role) + joint;
      add(role, right_role(role));
    }
  }
  return roles;
}

void assign_role(Rig& rig, BodyPlan& plan, int joint, const std::string& role, NameStyle style) {
  OptionCheck("assign_role").choice("style", style, name_styles);
  require_sound(rig, "assign_role");
  if (joint < 0 || joint >= rig.joints.rows()) {
    throw Error(Fault::usage, "assign_role: found joint " + std::to_string(joint) +
                                  ", needed one of the rig's " + std::to_string(rig.joints.rows()));
  }
  rig.roles.resize(rig.names.size());
  const std::size_t at = idx(joint);
  const auto with = [](const std::vector<std::string>& texts, const std::string& text) {
    return static_cast<std::size_t>(std::find(texts.begin(), texts.end(), text) - texts.begin());
  };
  if (rig.roles[at] == role) return;
  const std::size_t holder = role.empty() ? rig.roles.size() : with(rig.roles, role);
  const bool has_other_names = style != NameStyle::neutral;
  if (holder < rig.roles.size()) {
    std::swap(rig.roles[at], rig.roles[holder]);
    if (has_other_names) std::swap(rig.names[at], rig.names[holder]);
    if (!rig.readable.empty()) std::swap(rig.readable[at], rig.readable[holder]);
  } else {
    rig.roles[at] = role;
    const NameStyle words = has_words(style, plan.plan) ? style : NameStyle::automatic;
    const auto name_in = [&](NameStyle its) {
      return role.empty() ? numbered(at + 1) : name_of_role(role, plan.plan, its);
    };
    if (has_other_names) rename(rig.names, at, name_in(words));
    if (!rig.readable.empty()) rename(rig.readable, at, name_in(NameStyle::automatic));
  }
  for (std::size_t k = 0; k < plan.joints.size(); ++k) {
    if (plan.joints[k].role != rig.roles[k]) plan.joints[k].reason = "chosen by hand";
    plan.joints[k].role = rig.roles[k];
  }
  plan.missing.clear();
  if (plan.plan != BodyKind::humanoid) return;
  for (const char* required : required_human_roles) {
    if (with(rig.roles, required) == rig.roles.size()) plan.missing.emplace_back(required);
  }
}

}  // namespace curveskel
