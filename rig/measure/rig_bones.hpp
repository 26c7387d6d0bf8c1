// The joints and bones of a rig that are compared with another's.
#pragma once

#include <utility>
#include <vector>

#include <curveskel/rig.hpp>

namespace curveskel {

/// Of each joint: it moves some vertex.
[[nodiscard]] std::vector<bool> moving_joints(const Rig& rig);

struct RigBones {
  Positions places;                       ///< of the joints, each place once
  std::vector<std::pair<int, int>> ends;  ///< of each bone, parent and child
};

/// Left out are topmost joints that have no vertex' greatest weight and one child (a handle on the
/// ground); those in one place, to `tolerance`, are one.
[[nodiscard]] RigBones rig_bones(const Rig& rig, double tolerance);

/// The joint from which all hang, handles left out; of several the one with most joints below.
[[nodiscard]] int root_joint(const Rig& rig);

/// Places along the bones, about `step` apart, ends included; the joints where there is no bone.
[[nodiscard]] Positions samples_of(const RigBones& bones, double step);

/// From each of these places to the nearest of the others, in the mean. O(#places * #others).
[[nodiscard]] double mean_nearest(const Positions& places, const Positions& others);

}  // namespace curveskel
