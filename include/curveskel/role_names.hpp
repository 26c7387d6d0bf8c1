// What a rig's joints are called, in the words of the program that the rig is for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <curveskel/advanced/names.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/rig.hpp>

namespace curveskel {

enum class NameStyle : std::uint8_t {
  automatic,
  neutral,
  vrm,
  mixamo,
  unreal,
  unity,
  godot,
  rigify
};
inline constexpr NameTable<NameStyle, 8> name_styles{{
    {NameStyle::automatic, "auto", "readable words with .L and .R, as Blender mirrors them"},
    {NameStyle::neutral, "neutral", "joint_001 and so on"},
    {NameStyle::vrm, "vrm", "VRM 1.0, of humanoids"},
    {NameStyle::mixamo, "mixamo", "Mixamo, of humanoids"},
    {NameStyle::unreal, "unreal", "Unreal's mannequin, of humanoids"},
    {NameStyle::unity, "unity", "Unity, of humanoids"},
    {NameStyle::godot, "godot", "Godot, of humanoids"},
    {NameStyle::rigify, "rigify", "Rigify's human or wolf"},
}};

/// True if the style has words for the plan; else `name_roles` takes the readable ones.
[[nodiscard]] bool has_words(NameStyle style, BodyKind kind);

/// Names the joints of the plan, which are the rig's first ones, and the others by the joint of the
/// plan that they hang from (tail_1, ear_end.L, toe2_1.R); without a plan joints keep their names,
/// but in the neutral style. No two joints are called the same.
void name_roles(Rig& rig, const BodyPlan& plan, NameStyle style);

/// A human's role of each joint, or "", that somebody else's names say in the words of one of these
/// styles, whatever their case, separators and namespace (mixamorig:LeftArm, UpperArm.L); the spine
/// may have any name. Nothing where a bone that VRM requires is not found, or hangs from another
/// than VRM wants. O(joints).
[[nodiscard]] std::vector<std::string> roles_by_name(const Rig& rig);

/// The roles that a joint of such a body may have; none where there is no plan.
[[nodiscard]] std::vector<std::string> roles_of(BodyKind kind);

/// Corrects what a joint is. The joint that had the role takes this one's role and name, so that no
/// two have the same; `role` "" = nothing that is known. `plan.missing` follows. Precondition: the
/// joint is one of the rig's. O(joints).
void assign_role(Rig& rig, BodyPlan& plan, int joint, const std::string& role, NameStyle style);

}  // namespace curveskel
