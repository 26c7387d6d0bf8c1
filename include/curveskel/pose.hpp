// A surface moved by the joints of its rig.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// j, of each joint about itself, in the surface's coordinates, before those above it turn.
using JointTurns = std::vector<Eigen::Quaterniond>;

/// j, from the surface as it is to where the joints take it: each joint's motion is its parent's
/// after its own turn. Precondition: a turn for each joint, of length 1. O(joints).
[[nodiscard]] std::vector<Eigen::Isometry3d> joint_motions(const Rig& rig, const JointTurns& turns);

/// j x 3, the joints where the motions take them.
[[nodiscard]] Positions moved_joints(const Rig& rig, const std::vector<Eigen::Isometry3d>& motions);

/// n x 3, linear blend skinning: of each vertex the mean of the places where its joints' motions
/// take it, by their weights. One that no joint moves stays. Precondition: the rig's weights are
/// for these positions. O(weights).
[[nodiscard]] Positions moved_surface(const Positions& positions, const Rig& rig,
                                      const std::vector<Eigen::Isometry3d>& motions);

}  // namespace curveskel
