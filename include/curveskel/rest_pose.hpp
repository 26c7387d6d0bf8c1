// The pose in which a rig rests, and joints that some programs want or do not want.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/advanced/names.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

enum class RestPose : std::uint8_t { input, t };
inline constexpr NameTable<RestPose, 2> rest_poses{{
    {RestPose::input, "input", "as the file is"},
    {RestPose::t, "t", "VRM's T pose, of humanoids: arms level and held out, legs straight down"},
}};

/// Sets `turns` so that a human rests in VRM's T pose: arms along x, level, hands in line with
/// them, legs down, feet as they were. Joints and weights stay as they are, and with them the
/// vertices of the file: what is at rest is where `turns` take them. `other_plans` are those of a
/// scene's other figures, of which the humans take the pose, too. Throws Error(Fault::input) where
/// no plan is a humanoid's. O(joints).
void rest_in_t_pose(Rig& rig, const BodyPlan& plan, const std::vector<BodyPlan>& other_plans = {});

/// The rig below one more joint, which moves nothing: on the ground below its first root, named
/// "root". Precondition: `up` of length 1. O(#V + joints).
[[nodiscard]] Rig with_ground_root(const Rig& rig, const Surface& surface,
                                   const Eigen::RowVector3d& up);

/// The same where there are several roots, of bodies that stand apart; else the rig as it is.
[[nodiscard]] Rig with_one_root(const Rig& rig, const Surface& surface,
                                const Eigen::RowVector3d& up);

/// Without the joints that move nothing, have none below them and are called .._end. O(#V +
/// joints).
[[nodiscard]] Rig without_ends(const Rig& rig);

struct ExportOptions {
  RestPose pose = RestPose::input;
  bool ground_root = false;  ///< one more joint that all hangs from
  bool ends = true;          ///< joints at tips, which move nothing
  bool as_given = false;     ///< somebody's joints: no root is made where there are several
};
/// A rig as the program that it is for wants it: the functions above, in their order. Errors as
/// `rest_in_t_pose`, which joints that are given cannot.
[[nodiscard]] Rig rig_for_export(Rig rig, const BodyPlan& plan, const Surface& surface,
                                 const ExportOptions& options,
                                 const std::vector<BodyPlan>& other_plans = {});

}  // namespace curveskel
