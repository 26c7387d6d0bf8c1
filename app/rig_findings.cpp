#include "app/rig_findings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include <curveskel/advanced/file_names.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/names.hpp>
#include <curveskel/error.hpp>
#include <curveskel/role_names.hpp>
#include "app/certificate_table.hpp"

namespace curveskel {
namespace {

constexpr double held_out = 0.94;  // cos of 20 degrees, of what VRM wants to lie along x

std::optional<std::string> posture_of_planned(const BodyPlan& plan, const Eigen::Matrix3d& to_y_up,
                                              RestPose pose) {
  if (plan.plan != BodyKind::humanoid || pose != RestPose::input) return {};
  const double ahead = (to_y_up * plan.axes.row(2).transpose()).normalized().z();
  const auto place = [&](const char* role) -> Eigen::RowVector3d {
    const auto found = std::find_if(plan.joints.begin(), plan.joints.end(),
                                    [&](const PlannedJoint& joint) { return joint.role == role; });
    return found == plan.joints.end() ? Eigen::RowVector3d::Zero() : found->position;
  };
  const Eigen::Vector3d arm = to_y_up * (place("leftHand") - place("leftUpperArm")).transpose();
  constexpr double along = 0.99;  // up to rounding: plans have the file's axes
  if (ahead < along) return "VRM's figures look along z, this one does not: turn it first";
  if (arm.x() >= held_out * arm.norm()) return {};
  return "VRM's figures rest with their arms held out level, this one does not: give --pose t";
}

/// Nothing where they have not a human's roles.
std::optional<std::string> posture_of_given(const Rig& given) {
  const auto way = [&](const char* from, const char* to) -> Eigen::Vector3d {
    const auto place = [&](const char* role) -> Eigen::RowVector3d {
      const auto found = std::find(given.roles.begin(), given.roles.end(), role);
      if (found == given.roles.end()) return Eigen::RowVector3d::Zero();
      return given.joints.row(found - given.roles.begin());
    };
    return given.to_y_up * (place(to) - place(from)).transpose();
  };
  const Eigen::Vector3d left = way("rightUpperLeg", "leftUpperLeg");
  const Eigen::Vector3d arm = way("leftUpperArm", "leftHand");
  if (left.x() < held_out * left.norm()) {
    return "VRM's figures look along z, with y up, this one does not: turn it first";
  }
  if (arm.x() >= held_out * arm.norm()) return {};
  return "VRM's figures rest with their arms held out level, these joints do not: turn them so "
         "first, in the program that placed them";
}

}  // namespace

std::string skeleton_findings(const PolygonsRig& found, const RigPolygonsOptions& options) {
  if (found.certificate) return all_failures(*found.certificate, options.extract.certificate);
  if (found.given_inside >= options.extract.certificate.inside_needed) return "";
  return fmt::format(
      "{:.3g} % of the length of the skeleton given is inside the surface, needed {:.3g} %; give "
      "one of this surface, in its pose",
      100 * found.given_inside, 100 * options.extract.certificate.inside_needed);
}

namespace {

bool shows_limb(const BodyPlan& plan, const std::string& role) {
  return std::any_of(plan.joints.begin(), plan.joints.end(), [&](const PlannedJoint& joint) {
    return joint.role == role && !joint.reason.starts_with("by proportion");
  });
}

}  // namespace

std::vector<std::string> rig_findings(const CharacterRig& character,
                                      const CharacterOptions& options) {
  const BodyPlan& plan = character.plan;
  std::vector<std::string> findings;
  if (character.joints_over_budget > 0) {
    findings.push_back(fmt::format(
        "the joint budget of {} is not met: {} joints stay, roots and those that a body "
        "needs",
        options.joint_budget, options.joint_budget + character.joints_over_budget));
  }
  if (!has_words(options.names, plan.plan)) {
    findings.push_back(fmt::format(
        "the names {} have no words for the plan {}; joints have readable names instead",
        name_of(name_styles, options.names), name_of(body_kinds, plan.plan)));
  }
  if (plan.by_proportion && !shows_limb(plan, "leftUpperLeg") &&
      !shows_limb(plan, "leftUpperArm")) {
    findings.emplace_back(
        "neither legs nor arms are seen: all are placed where a human has them who stands upright, "
        "which is wrong for one who sits or lies");
  }
  const BodyKind asked = options.plan.plan;
  const bool is_asked_for =
      asked != BodyKind::automatic && asked != BodyKind::other && asked != BodyKind::none;
  if (is_asked_for && plan.plan == BodyKind::other) findings.push_back(plan.reason);
  return findings;
}

std::optional<std::string> posture_finding(const CharacterRig& character, const RigOrigin& origin) {
  if (origin.joints_are_given) {
    const bool is_vrm = origin.old_rig == OldRig::kept && read_vrm(origin.mesh);
    return is_vrm ? std::nullopt : posture_of_given(character.rig);
  }
  return posture_of_planned(character.plan, character.rig.to_y_up, origin.pose);
}

std::optional<std::string> look_finding(const std::filesystem::path& mesh) {
  const std::string own = lower_extension(without_gz(mesh));
  for (const char* extension : {"3mf", "vtp", "vtk"}) {
    if (own != extension) continue;
    return mesh.filename().string() +
           ": materials and texture coordinates are not taken from such a file; to keep them "
           "export it as glTF";
  }
  return {};
}

std::optional<std::string> bind_pose_finding(const std::filesystem::path& mesh,
                                             const PolygonSoup& bound, const Monitor& monitor) {
  constexpr double visible = 1e-3;
  const PolygonSoup shown = read_polygons(mesh, monitor);
  const double farthest =
      (shown.positions - bound.positions).rowwise().norm().maxCoeff<Eigen::PropagateNumbers>();
  const double share = farthest / bounding_box_diagonal(shown.positions);
  if (share < visible) return {};
  return fmt::format(
      "the joints rest in another pose than they were bound in, by up to {:.2g} % of the size; the "
      "new rig rests in the pose in which the old one was bound (--as-shown: in the one at rest)",
      100 * share);
}

void require_pose(RigFormat format, RestPose pose, const std::string& output) {
  if (pose != RestPose::t || keeps_the_file(format)) return;
  throw Error(Fault::usage,
              output +
                  ": has no pose at rest apart from the surface's; --pose t is for glb, gltf, vrm, "
                  "fbx, usda and usdz");
}

VrmMeta vrm_meta_for(const std::filesystem::path& mesh, OldRig old_rig, const VrmMeta& given) {
  const auto old = old_rig == OldRig::kept ? read_vrm(mesh) : std::nullopt;
  const bool has_some = !(given.name + given.author + given.licence_url).empty();
  if (old && old->is_version_0 && has_some) {
    throw Error(Fault::usage, mesh.string() +
                                  ": is VRM 0.x and stays so beside --keep-rig, with its own name, "
                                  "author and licence; leave out --vrm-name, --vrm-author and "
                                  "--vrm-licence");
  }
  if (old && old->is_version_0) return {};
  VrmMeta meta = given;
  if (old) {
    if (meta.name.empty()) meta.name = old->meta.name;
    if (meta.author.empty()) meta.author = old->meta.author;
    if (meta.licence_url.empty()) meta.licence_url = old->meta.licence_url;
  }
  require_whole(meta);
  return meta;
}

void require_human_roles(const std::filesystem::path& mesh, const Rig& rig, OldRig old_rig) {
  if (old_rig == OldRig::kept && read_vrm(mesh)) return;
  std::string missing;
  for (const char* const role : required_human_roles) {
    if (std::find(rig.roles.begin(), rig.roles.end(), role) != rig.roles.end()) continue;
    missing += (missing.empty() ? "" : ", ") + std::string(role);
  }
  if (missing.empty()) return;
  const std::string remedy =
      old_rig == OldRig::kept
          ? "call the joints as VRM, Mixamo, Unreal, Unity or Rigify do, leave out --keep-rig to "
            "have joints made, or write .glb"
          : "call the joints as VRM, Mixamo, Unreal, Unity or Rigify do, give the joints of the "
            ".json file these roles, leave out --joints to have joints made, or write .glb";
  throw Error(Fault::input, "a .vrm file is of a human, found no joint with the role " + missing +
                                ", needed one for each; " + remedy);
}

void require_root_alone(int root, const PlanOptions& options) {
  const bool is_planned = options.plan != BodyKind::automatic && options.plan != BodyKind::none;
  if (root >= 0 && is_planned) {
    throw Error(Fault::usage, fmt::format("--root {}: a root that is chosen needs joints without a "
                                          "plan, found --plan {}; leave out one of the two",
                                          root, name_of(body_kinds, options.plan)));
  }
  if (options.front == Direction::automatic) return;
  if (root < 0 && options.plan != BodyKind::none) return;
  throw Error(Fault::usage, fmt::format("--front {} needs a plan, and {} makes none; leave out one "
                                        "of the two",
                                        name_of(directions, options.front),
                                        root >= 0 ? "--root" : "--plan none"));
}

}  // namespace curveskel
