// A rig whose numbers are numbers of its own joints, checked where it enters.
#pragma once

#include <string_view>

#include <curveskel/rig.hpp>

namespace curveskel {

/// Throws Error(Fault::input) that begins with `purpose` unless there is a parent for each joint,
/// which comes before it or is -1. O(joints).
void require_hierarchy(const Rig& rig, std::string_view purpose);

/// The same, and there must be a name for each joint, as many roles, turns and readable names or
/// none, and weights of as many joints or without rows. O(joints).
void require_sound(const Rig& rig, std::string_view purpose);

/// For files: as `require_sound`, and there must be a joint, joints and weights must be finite, and
/// no weight below 0. O(joints + weights).
void require_writable(const Rig& rig, std::string_view purpose);

/// Throws Error(Fault::input) that begins with `purpose` unless the weights have a row for each of
/// so many vertices. O(1).
void require_weights_of(const Rig& rig, Eigen::Index vertices, std::string_view purpose);

}  // namespace curveskel
