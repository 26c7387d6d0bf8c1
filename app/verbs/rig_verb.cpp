// curveskel rig: a surface file in, the same surface with joints and skin weights out.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rest_pose.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/rig_parts.hpp>
#include <curveskel/rig_polygons.hpp>
#include <curveskel/role_names.hpp>
#include "app/arguments.hpp"
#include "app/certificate_table.hpp"
#include "app/command_line.hpp"
#include "app/output_files.hpp"
#include "app/report.hpp"
#include "app/rig_report.hpp"
#include "app/surface_input.hpp"
#include "app/verbs/rig_options.hpp"
#include "app/verbs/rig_sources.hpp"
#include "app/verbs/rig_summary.hpp"
#include "app/verbs/verbs.hpp"

namespace curveskel {
namespace {

namespace fs = std::filesystem;

/// VRM's figures look along z, their arms held out.
void warn_of_posture(const BodyPlan& plan, const Eigen::Matrix3d& to_y_up, Session& session) {
  if (plan.plan != BodyKind::humanoid) return;
  const double ahead = (to_y_up * plan.axes.row(2).transpose()).normalized().z();
  const auto place = [&](const char* role) -> Eigen::RowVector3d {
    const auto found = std::find_if(plan.joints.begin(), plan.joints.end(),
                                    [&](const PlannedJoint& joint) { return joint.role == role; });
    return found == plan.joints.end() ? Eigen::RowVector3d::Zero() : found->position;
  };
  const Eigen::Vector3d arm = to_y_up * (place("leftHand") - place("leftUpperArm")).transpose();
  constexpr double held_out = 0.94;  // cos of 20 degrees
  constexpr double along = 0.99;     // up to rounding: plans have the file's axes
  if (ahead < along) {
    session.terminal.warn("VRM's figures look along z, this one does not: turn it first");
  } else if (arm.x() < held_out * arm.norm()) {
    session.terminal.warn(
        "VRM's figures rest with their arms held out level, this one does not: give --pose t");
  }
}

OldRig old_rig_in(const RigArguments& arguments) {
  return arguments.keep_rig ? OldRig::kept : OldRig::replaced;
}

/// Of formats whose look is not read.
void warn_of_looks(const RigArguments& arguments, Session& session) {
  fs::path name = arguments.mesh;
  if (name.extension() == ".gz") name = name.stem();
  for (const char* extension : {".3mf", ".vtp", ".vtk"}) {
    if (name.extension() != extension) continue;
    session.terminal.warn(arguments.mesh.filename().string() +
                          ": materials and texture coordinates are not taken from such a file; "
                          "to keep them export it as glTF");
  }
}

/// Unless hardly anything moves by it.
void warn_of_bind_pose(const RigArguments& arguments, const PolygonSoup& bound,
                       const Monitor& monitor, Session& session) {
  constexpr double visible = 1e-3;
  const PolygonSoup shown = read_polygons(arguments.mesh, monitor);
  const double farthest =
      (shown.positions - bound.positions).rowwise().norm().maxCoeff<Eigen::PropagateNumbers>();
  const double share = farthest / bounding_box_diagonal(shown.positions);
  if (share < visible) return;
  session.terminal.warn(
      fmt::format("the joints rest in another pose than they were bound in, by up to {:.2g} % of "
                  "the size; the new rig rests in the pose in which the old one was bound "
                  "(--as-shown: in the one at rest)",
                  100 * share));
}

/// Joints of the file's own are as it shows them, and the surface with them.
bool reads_as_bound(const RigArguments& arguments) {
  std::error_code ignored;
  const bool has_own_joints =
      !arguments.joints.empty() && fs::equivalent(arguments.joints, arguments.mesh, ignored);
  return !arguments.bare && !arguments.keep_rig && !arguments.as_shown && !has_own_joints;
}

/// Where the file itself gets the rig, in the pose in which its vertices are stored.
PolygonSoup read_to_rig(const RigArguments& arguments, const Monitor& monitor, Session& session) {
  if (!arguments.bare) {
    require_editable(arguments.mesh, old_rig_in(arguments), monitor);
    warn_of_looks(arguments, session);
  }
  if (is_standard_input(arguments.mesh)) {
    session.terminal.warn(
        "from standard input comes the surface alone; name a file to keep its materials");
    return read_surface(arguments.mesh, monitor);
  }
  PolygonSoup soup = read_polygons(arguments.mesh, monitor, {arguments.as_bound});
  if (arguments.as_bound && soup.posed) warn_of_bind_pose(arguments, soup, monitor, session);
  return soup;
}

/// `summary` gets a line about an old rig.
std::vector<OutputFile> rig_files(const RigArguments& arguments, const PolygonSoup& soup,
                                  const Rig& rig, const std::vector<RigFormat>& formats,
                                  Session& session, std::string& summary) {
  const Monitor monitor = session.monitor();
  fs::path name = is_standard_input(arguments.mesh) ? "surface" : arguments.mesh.stem();
  if (arguments.mesh.extension() == ".gz") name = name.stem();
  std::vector<OutputFile> files;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    monitor.report("write", static_cast<double>(i) / static_cast<double>(formats.size()));
    std::optional<EditedFile> edited;
    if (!arguments.bare) {
      edited = format_rig_into(arguments.mesh, rig,
                               {formats[i], old_rig_in(arguments), name.string() + " rig",
                                program_and_version(), arguments.vrm, arguments.as_bound},
                               monitor);
    }
    if (!edited) {
      const Surface given{soup.positions, triangulate(soup)};
      edited = EditedFile{
          format_rig(given, rig, formats[i], name.string(), program_and_version(), arguments.vrm),
          {}};
    }
    for (const std::string& note : edited->notes) {
      if (i == 0) session.terminal.warn(arguments.mesh.filename().string() + ": " + note);
    }
    if (edited->joints_replaced > 0) {
      summary = fmt::format("replaced: a rig of {} joints, {} channels of animations\n",
                            edited->joints_replaced, edited->channels_removed);
    }
    files.push_back({arguments.outputs[i], std::move(edited->bytes)});
  }
  return files;
}

void warn_of_budget(const CharacterRig& character, int budget, Session& session) {
  if (character.joints_over_budget == 0) return;
  session.terminal.warn(
      fmt::format("--joint-budget {}: {} joints stay, roots and those that a body needs", budget,
                  budget + character.joints_over_budget));
}

void warn_of_names(const BodyPlan& plan, NameStyle style, Session& session) {
  if (has_words(style, plan.plan)) return;
  session.terminal.warn(
      fmt::format("--names {} has no words for the plan {}; joints have readable names instead",
                  name_of(name_styles, style), name_of(body_kinds, plan.plan)));
}

RigPolygonsOptions options_of(const RigArguments& arguments) {
  RigPolygonsOptions options;
  options.repair = arguments.repair;
  options.extract = arguments.extract;
  options.extract.fairing = arguments.fair_iterations > 0;
  options.extract.fair.iterations = arguments.fair_iterations;
  options.character = {arguments.rig, arguments.parts, arguments.plan, arguments.names,
                       arguments.joint_budget};
  options.threads = arguments.threads;
  return options;
}

int run_rig(RigArguments arguments, Session& session) {
  if (arguments.quiet) session.terminal.be_quiet();
  std::vector<RigFormat> formats;
  for (const std::string& name : arguments.outputs) formats.push_back(format_of(name, rig_formats));
  if (std::find(formats.begin(), formats.end(), RigFormat::vrm) != formats.end()) {
    require_whole(arguments.vrm);
  }
  for (std::size_t k = 0; k < formats.size() && arguments.pose == RestPose::t; ++k) {
    if (keeps_the_file(formats[k]) || formats[k] == RigFormat::usda) continue;
    throw UsageError(arguments.outputs[k] +
                     ": has no pose at rest apart from the surface's; --pose t is for glb, gltf, "
                     "vrm, fbx and usda");
  }
  if (is_standard_input(arguments.mesh)) {
    if (arguments.keep_rig) throw UsageError("--keep-rig needs a file, not standard input");
    arguments.bare = true;
  }
  std::vector<std::string> names = arguments.outputs;
  if (!arguments.report.empty()) names.push_back(arguments.report);
  check_outputs(names, arguments.mesh);
  session.interruption.limit(arguments.time_limit_seconds);

  const auto begin = std::chrono::steady_clock::now();
  const Monitor monitor = session.monitor();
  arguments.as_bound = reads_as_bound(arguments);
  const PolygonSoup soup = read_to_rig(arguments, monitor, session);
  std::optional<Rig> old_rig;
  if (arguments.keep_rig &&
      (soup.format == SurfaceFormat::fbx || soup.format == SurfaceFormat::dae)) {
    arguments.keep_rig = false;  // such a file becomes another one, with the joints that it had
    arguments.joints = arguments.mesh.string();
  }
  if (arguments.keep_rig) old_rig = rig_in(arguments.mesh, monitor);
  if (!arguments.joints.empty()) old_rig = joints_for(arguments.joints, soup, session);
  RigSources sources;
  if (!arguments.skeleton.empty()) sources.skeleton = skeleton_for(arguments.skeleton, soup);
  sources.joints = std::move(old_rig);
  PolygonsRig found = rig_polygons(soup, sources, options_of(arguments), monitor);
  const BodyPlan& plan = found.character.plan;
  if (found.certificate) {
    const std::string failed = all_failures(*found.certificate, arguments.extract.certificate);
    if (!failed.empty()) session.terminal.warn(failed);
  }
  warn_of_budget(found.character, arguments.joint_budget, session);
  if (!sources.joints) warn_of_names(plan, arguments.names, session);
  const bool is_asked_for = arguments.plan.plan != BodyKind::automatic &&
                            arguments.plan.plan != BodyKind::other &&
                            arguments.plan.plan != BodyKind::none;
  if (is_asked_for && plan.plan == BodyKind::other) session.terminal.warn(plan.reason);
  const Surface given{soup.positions, triangulate(soup)};
  if (std::find(formats.begin(), formats.end(), RigFormat::vrm) != formats.end()) {
    if (arguments.pose == RestPose::input) {
      warn_of_posture(plan, found.character.rig.to_y_up, session);
    }
  }
  const Rig written = rig_for_export(
      found.character.rig, plan, given,
      {arguments.pose, arguments.ground_root, !arguments.no_ends, sources.joints.has_value()},
      found.character.other_plans);
  std::string old_rig_in_words;
  std::vector<OutputFile> files =
      rig_files(arguments, soup, written, formats, session, old_rig_in_words);
  if (!arguments.report.empty()) {
    const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - begin;
    files.push_back(
        {arguments.report,
         rig_report_json({given, found.character, name_of_input(arguments.mesh), so_far.count()})});
  }
  write_outputs(files, session);
  if (arguments.quiet) return ExitCode::done;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  std::string text = fmt::format("{}: {} vertices\nrig: {}\n", name_of_input(arguments.mesh),
                                 soup.positions.rows(), joints_in_words(written));
  if (found.character.joints_left_out > 0) {
    text += fmt::format("left out: {} joints that move the least (--joint-budget 0: all)\n",
                        found.character.joints_left_out);
  }
  text += parts_in_words(found.character.parts);
  text += plan_in_words(plan);
  for (std::size_t k = 0; k < found.character.other_plans.size(); ++k) {
    text += fmt::format("figure {}, {}", k + 2, plan_in_words(found.character.other_plans[k]));
  }
  text += old_rig_in_words;
  for (const OutputFile& file : files) text += fmt::format("wrote {}\n", file.name);
  session.terminal.result(text + fmt::format("{:.2f} s\n", taken.count()));
  return ExitCode::done;
}

}  // namespace

Verb add_rig(CLI::App& program) {
  const auto arguments = std::make_shared<RigArguments>();
  CLI::App* parser = program.add_subcommand(
      "rig",
      "Give a surface joints and skin weights, as glTF that Blender opens, or for another program");
  add_rig_options(*parser, *arguments);
  return {parser, [arguments](Session& session) { return run_rig(*arguments, session); }};
}

}  // namespace curveskel
