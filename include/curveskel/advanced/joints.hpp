// Joints on a curve skeleton, and their hierarchy.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include <curveskel/body_plan.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct JointOptions {
  int root = -1;           ///< a node of the skeleton; -1 = chosen, see `place_joints`
  double bone_length = 6;  ///< that a straight limb is cut into, of the radius along it; 0.01..1e6
  double bend =
      0.5;  ///< of the radius: a curve that is so far off a bone is worth a joint; same range
  // Of the longest side of the skeleton's box; 0..1.
  double straight_bone = 0.06;  ///< that a straight limb is cut into at least, however thin it is,
                                ///< by the default `bone_length` (others in proportion): fins,
                                ///< plates and spikes are no chains of beads
  double least_bone = 0.02;     ///< nothing shorter becomes a bone of its own
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const JointOptions& options);

/// A forest of joints.
struct Joints {
  Positions positions;             ///< j x 3, in model units
  Eigen::VectorXi parents;         ///< j, each before its children; -1 = a root
  std::vector<std::string> names;  ///< j, no two the same
  Eigen::VectorXi joint_of_node;   ///< #N of the skeleton: the joint that moves it
};

/// Joints at the junctions, where a limb leaves the inscribed ball of its junction, along limbs,
/// and at tips (these, named ".._end", move nothing: they say how long the last bone is).
///
/// The root is the junction with the least sum of ways to the whole curve, each piece weighted by
/// length times radius; without junctions the end with the larger ball, or the middle if other
/// components hang from it. A cycle is cut where the ways from the root meet. Twigs shorter than a
/// bone do not divide a limb, and move with where they hang. Along a limb the joints minimise, over
/// all choices (dynamic programming), the sum over bones of 1 + (length / (bone_length r))^2 +
/// (deviation / (bend r))^2, lengths measured in the radius r where they are (or in that of which
/// straight_bone is 6), deviation the largest distance of the curve from the bone. Components
/// hang from each other where they touch widely or are nearest, in a tree from the heaviest (length
/// times radius) or that of a wanted root, so that there is one root for what belongs together;
/// each is rooted where it hangs. Bodies that stand apart (by more than a quarter of the larger
/// one's diagonal) have roots of their own. Throws Error(Fault::usage) where the root is no node,
/// Error(Fault::input) without nodes. O(#N log #N), a hundred times as much where there are many
/// junctions.
[[nodiscard]] Joints place_joints(const CurveSkeleton& skeleton, const JointOptions& options = {});

/// The same with the planned joints first, under the names of their roles, from the first of them
/// as the root; what lies between them on the curve has no others. Straight bones elsewhere are not
/// much shorter than the median of those between planned joints. Beyond hands joints may lie half
/// as near to each other as elsewhere. Components with a node of `ground` have roots of their own,
/// and nothing hangs from them.
[[nodiscard]] Joints place_planned_joints(const CurveSkeleton& skeleton,
                                          const std::vector<PlannedJoint>& planned,
                                          const JointOptions& options = {},
                                          const std::vector<int>& ground = {},
                                          const Eigen::Vector3d& up = Eigen::Vector3d::UnitY());

}  // namespace curveskel
