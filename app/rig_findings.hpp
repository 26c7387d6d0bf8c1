// Sentences about a rig that whoever asked for it should read: warnings of every door.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <curveskel/body_plan.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/read.hpp>
#include <curveskel/rest_pose.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/rig_polygons.hpp>

namespace curveskel {

/// How the skeleton's certificate failed; empty where it holds or somebody gave the skeleton.
[[nodiscard]] std::string skeleton_findings(const PolygonsRig& found,
                                            const RigPolygonsOptions& options);

/// A plan that was asked for and is not to be had, names without words for the plan, a budget of
/// joints that is not met. Precondition: the joints were made.
[[nodiscard]] std::vector<std::string> rig_findings(const CharacterRig& character,
                                                    const CharacterOptions& options);

/// How the joints of a rig came to be.
struct RigOrigin {
  std::filesystem::path mesh;
  OldRig old_rig = OldRig::replaced;
  bool joints_are_given = false;  ///< or kept
  RestPose pose = RestPose::input;
};

/// VRM's figures look along z, their arms held out; this one does not. In a pose that is made, and
/// of a VRM that keeps its joints, nothing.
[[nodiscard]] std::optional<std::string> posture_finding(const CharacterRig& character,
                                                         const RigOrigin& origin);

/// Of formats whose look is not read.
[[nodiscard]] std::optional<std::string> look_finding(const std::filesystem::path& mesh);

/// Of joints that rest in another pose than they were bound in, unless hardly anything moves by it.
/// `bound` is the file as it was bound.
[[nodiscard]] std::optional<std::string> bind_pose_finding(const std::filesystem::path& mesh,
                                                           const PolygonSoup& bound,
                                                           const Monitor& monitor);

/// Throws Error(Fault::usage) for a format that has no pose at rest apart from the surface's.
void require_pose(RigFormat format, RestPose pose, const std::string& output);

/// The texts of a .vrm file: where the rig of a VRM 1.0 file is kept, those that are not given are
/// the file's. Throws Error(Fault::usage) where one is missing, or is given for a VRM 0.x file that
/// keeps its rig, and so what it says.
[[nodiscard]] VrmMeta vrm_meta_for(const std::filesystem::path& mesh, OldRig old_rig,
                                   const VrmMeta& given);

/// Throws Error(Fault::input) where joints that are not made here, but given or kept as `mesh` has
/// them, lack a role that VRM requires; what is a VRM already and keeps its joints has them.
void require_human_roles(const std::filesystem::path& mesh, const Rig& rig, OldRig old_rig);

/// Throws Error(Fault::usage) for a plan that is named beside a root, as the joints are made
/// without one, and for a front where no plan is made.
void require_root_alone(int root, const PlanOptions& options);

}  // namespace curveskel
