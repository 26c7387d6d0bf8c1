// A rig without some of its joints.
#pragma once

#include <vector>

#include <curveskel/rig.hpp>

namespace curveskel {

/// Of each joint its number among those that stay, -1 = it goes.
[[nodiscard]] std::vector<int> numbers_of(const std::vector<char>& stays);

/// The ancestors of what stays, stay.
void mark_ancestors(const Rig& rig, std::vector<char>& stays);

/// The nearest ancestor that stays moves what a joint that goes has moved. Precondition: roots
/// stay. O(weights + joints).
[[nodiscard]] Rig keep_joints(const Rig& rig, const std::vector<int>& number);

}  // namespace curveskel
