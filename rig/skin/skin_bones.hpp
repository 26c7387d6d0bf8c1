// The bones of a rig as straight pieces that hold the skin.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/advanced/joints.hpp>
#include <curveskel/advanced/skin_weights.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// The place on the bone that is nearest to `point`.
[[nodiscard]] Eigen::RowVector3d nearest_on(const Bone& bone, const Eigen::RowVector3d& point);

/// From each joint to each of its children, for the component of the skeleton that the joint is of:
/// bodies that overlap do not hold each other. A joint that moves no node is of its parent's.
/// O(joints + nodes).
[[nodiscard]] std::vector<Bone> bones_of_own(const CurveSkeleton& skeleton, const Joints& joints);

/// The same for all components: what lies about a bone is held by it, be it a robe or a plate.
[[nodiscard]] std::vector<Bone> bones_for_all(const Positions& joints,
                                              const Eigen::VectorXi& parents);

/// Of joints that somebody else has placed, for all components. One that lies outside of the
/// surface for more than half of its length (from a root on the ground to the hips, to a handle
/// beside the foot) holds nothing, unless it hangs from one that does, as of a toe that the bones
/// have left. A joint inside the surface from which nothing hangs has a bone of its own, straight
/// on from the one that leads to it, up to the surface, unless its name is an end's
/// (`is_end_name`); a joint without any other has one of no length. Where all that holds nothing,
/// all do. Precondition: parents before their children; a closed surface. O(#F log #F + joints log
/// #F).
[[nodiscard]] std::vector<Bone> bones_of_given(const Surface& surface, const Rig& given,
                                               int threads);

/// Of each node the joint of the nearest bone; of bones as near the last. At least one bone.
/// O(nodes * bones).
[[nodiscard]] Eigen::VectorXi joints_of_nodes(const CurveSkeleton& skeleton,
                                              const std::vector<Bone>& bones);

}  // namespace curveskel
