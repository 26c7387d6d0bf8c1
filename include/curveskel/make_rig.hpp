// From a surface and its curve skeleton to a rig: joints, their hierarchy, skin weights.
#pragma once

#include <Eigen/Core>

#include <curveskel/advanced/joints.hpp>
#include <curveskel/advanced/skin_weights.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct RigOptions {
  JointOptions joints;
  SkinOptions skin;
  bool faces_minus_z = false;  ///< the figure looks along -z: its left is where x is smaller
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const RigOptions& options);

/// The skeleton with more nodes, after those given, half a radius apart or less, for joints and
/// skin on straight stretches; vertices go to the nearest about theirs. With the places at which
/// its components meet (`contacts`). Edges follow the curve: they are not sorted as `Edges` says.
/// Throws Error(Fault::input) for a skeleton whose numbers are none of its nodes, or whose
/// node_of_vertex is of another surface; Cancelled on a stop. O(#V + nodes made), and a million
/// nearest points for contacts.
[[nodiscard]] CurveSkeleton dense_skeleton(const Surface& surface, const CurveSkeleton& skeleton,
                                           const Monitor& monitor = {});

/// `place_joints`, `skin_weights`, then the sides: limbs that mirror each other end in .L and .R.
/// A vertex that has no node (or none has) goes to the one whose ball is nearest. Precondition: a
/// clean surface; node_of_vertex by its vertices, if there is one. Errors as of `place_joints`,
/// Cancelled on a stop.
[[nodiscard]] Rig make_rig(const Surface& surface, const CurveSkeleton& skeleton,
                           const RigOptions& options = {}, const Monitor& monitor = {});

/// The same with the joints of a plan, which keep the names of their roles; the sides of the others
/// are those of the plan's axes. The plan is of the same skeleton.
[[nodiscard]] Rig make_planned_rig(const Surface& surface, const CurveSkeleton& skeleton,
                                   const BodyPlan& plan, const RigOptions& options = {},
                                   const Monitor& monitor = {});

/// The same joints with new weights: `skin_weights` of their bones, a node of the
/// skeleton with the nearest. For joints that somebody has placed; `given.weights` is
/// not read. Errors as `make_rig`, and Error(Fault::input) for joints at places that are not
/// finite.
[[nodiscard]] Rig weights_on_joints(const Surface& surface, const CurveSkeleton& skeleton,
                                    const Rig& given, const SkinOptions& options = {},
                                    const Monitor& monitor = {});

/// The skeleton with node_of_vertex, if it has one, by the vertices of the surface that was
/// repaired instead of those given; -1 for vertices that only the repair made. `vertex_of_input` is
/// as in RepairedSurface, `vertices` those of the surface.
/// Throws Error(Fault::input) where node_of_vertex is of another number of vertices.
[[nodiscard]] CurveSkeleton skeleton_of_repaired(CurveSkeleton skeleton,
                                                 const Eigen::VectorXi& vertex_of_input,
                                                 Eigen::Index vertices);

/// The rig of the surface as a rig of the whole file: `vertex_of_input` is as in RepairedSurface,
/// `given` is the file's surface in triangles, `skeleton` the one of the rig. A vertex without a
/// vertex of the surface follows the body: with all that hangs together with it (by faces, or in
/// one place) rigidly, with the mean weights of the body where the two are nearest (over a tenth),
/// as an eye or a button does; or each for itself as the nearest place of the body, where what
/// hangs together is more than five radii of the body long, or sewn to it, as clothes are. A
/// follower beyond a joint with a role that moves nothing of the body itself moves with it alone,
/// in place of the joint before: a head, where the body ends at the neck. Of `options` most_joints
/// holds for followers. Throws as `require_valid` does. O((#V + #F) log #F).
[[nodiscard]] Rig rig_of_given(const Rig& rig, const Surface& surface,
                               const CurveSkeleton& skeleton,
                               const Eigen::VectorXi& vertex_of_input, const Surface& given,
                               const SkinOptions& options = {});

/// Of each vertex of the file, true if it follows in `rig_of_given`.
[[nodiscard]] std::vector<bool> followers_of(const Eigen::VectorXi& vertex_of_input);

}  // namespace curveskel
