// A character with some of its joints.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include <curveskel/rig_character.hpp>

namespace curveskel {

/// Without these there is no body: what VRM requires of a human, the trunk, neck and head of
/// others.
[[nodiscard]] bool is_required(const CharacterRig& character, std::size_t joint);

/// Throws Error(Fault::input) that begins with `purpose` unless each plan's joints are as many of
/// the rig's, the first ones of their figure, with parents among them.
void require_planned_joints(const CharacterRig& character, std::string_view purpose);

/// Those that stay, in the plan, too. Precondition: the planned joints are the first of the rig;
/// roots stay, and so do the ancestors of planned joints that stay.
[[nodiscard]] CharacterRig with_joints(CharacterRig character, const std::vector<char>& stays);

}  // namespace curveskel
