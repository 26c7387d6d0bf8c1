// curveskel rig: a surface file in, the same surface with joints and skin weights out.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/body_plan.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rest_pose.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/rig_parts.hpp>
#include <curveskel/rig_polygons.hpp>
#include <curveskel/skeleton_files.hpp>
#include "app/arguments.hpp"
#include "app/command_line.hpp"
#include "app/counted.hpp"
#include "app/output_files.hpp"
#include "app/report.hpp"
#include "app/rig_findings.hpp"
#include "app/rig_report.hpp"
#include "app/rig_sources.hpp"
#include "app/surface_input.hpp"
#include "app/verbs/rig_options.hpp"
#include "app/verbs/rig_summary.hpp"
#include "app/verbs/verbs.hpp"

namespace curveskel {
namespace {

namespace fs = std::filesystem;

OldRig old_rig_in(const RigArguments& arguments) {
  return arguments.keep_rig ? OldRig::kept : OldRig::replaced;
}

/// There is no file for the rig, or nothing else of it is wanted.
bool writes_surface_alone(const RigArguments& arguments) {
  return arguments.bare || is_standard_input(arguments.mesh);
}

/// Joints of the file's own are as it shows them, and the surface with them.
bool reads_as_bound(const RigArguments& arguments) {
  std::error_code ignored;
  const bool has_own_joints =
      !arguments.joints.empty() && fs::equivalent(arguments.joints, arguments.mesh, ignored);
  return !writes_surface_alone(arguments) && !arguments.keep_rig && !arguments.as_shown &&
         !has_own_joints;
}

/// Where the file itself gets the rig, in the pose in which its vertices are stored.
PolygonSoup read_to_rig(const RigArguments& arguments, const Monitor& monitor, Session& session) {
  if (!writes_surface_alone(arguments)) {
    require_editable(arguments.mesh, old_rig_in(arguments), monitor);
    if (const auto finding = look_finding(arguments.mesh)) session.terminal.warn(*finding);
  }
  if (is_standard_input(arguments.mesh)) {
    bool loses_look = false;
    PolygonSoup soup = read_standard_input(monitor, loses_look);
    if (loses_look && !arguments.bare) {
      session.terminal.warn(
          "from standard input comes the surface alone; name a file to keep its materials");
    }
    return soup;
  }
  PolygonSoup soup = read_polygons(arguments.mesh, monitor, {arguments.as_bound});
  if (arguments.as_bound && soup.posed) {
    const auto finding = bind_pose_finding(arguments.mesh, soup, monitor);
    if (finding) session.terminal.warn(*finding);
  }
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
  std::set<std::string> said;  // several formats have the same notes
  for (std::size_t i = 0; i < formats.size(); ++i) {
    monitor.report("write", static_cast<double>(i) / static_cast<double>(formats.size()));
    std::optional<EditedFile> edited;
    if (!writes_surface_alone(arguments)) {
      edited = format_rig_into(
          arguments.mesh, rig,
          {formats[i], old_rig_in(arguments), name.string() + " rig", program_and_version(),
           arguments.vrm, arguments.as_bound, picture_folder_of(arguments.outputs[i])},
          monitor);
    }
    if (!edited) {
      const Surface given{soup.positions, triangulate(soup)};
      edited = EditedFile{
          format_rig(given, rig, formats[i], name.string(), program_and_version(), arguments.vrm),
          {}};
    }
    for (const std::string& note : edited->notes) {
      if (!said.insert(note).second) continue;
      session.terminal.warn(arguments.mesh.filename().string() + ": " + note);
    }
    if (edited->joints_replaced > 0) {
      summary = fmt::format("replaced: a rig of {}, {} of animations\n",
                            count_of(edited->joints_replaced, "joint"),
                            count_of(edited->channels_removed, "channel"));
    }
    files.push_back(
        {arguments.outputs[i], std::move(edited->bytes), std::move(edited->side_files)});
  }
  return files;
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

/// The formats of the outputs; all that can be refused before anything is read.
std::vector<RigFormat> checked_formats(RigArguments& arguments) {
  std::vector<RigFormat> formats;
  for (const std::string& name : arguments.outputs) {
    formats.push_back(format_of(name, rig_formats));
    require_pose(formats.back(), arguments.pose, name);
  }
  const VrmMeta& vrm = arguments.vrm;
  const bool has_meta = !(vrm.name + vrm.author + vrm.licence_url).empty();
  if (has_meta && std::count(formats.begin(), formats.end(), RigFormat::vrm) == 0) {
    throw UsageError("--vrm-name, --vrm-author and --vrm-licence are for a .vrm file");
  }
  require_root_alone(arguments.rig.joints.root, arguments.plan);
  if (is_standard_input(arguments.mesh)) {
    if (arguments.keep_rig) throw UsageError("--keep-rig needs a file, not standard input");
  }
  std::vector<std::string> names = arguments.outputs;
  require_extension(arguments.report, "--report", "json");
  if (!arguments.report.empty()) names.push_back(arguments.report);
  check_outputs(names, {arguments.mesh, arguments.joints, arguments.skeleton});
  if (std::count(formats.begin(), formats.end(), RigFormat::vrm) > 0) {
    arguments.vrm = vrm_meta_for(arguments.mesh, old_rig_in(arguments), arguments.vrm);
  }
  return formats;
}

RigSources sources_of(const RigArguments& arguments, const PolygonSoup& soup, Session& session) {
  const Monitor monitor = session.monitor();
  RigSources sources;
  if (arguments.keep_rig) sources.joints = rig_in(arguments.mesh, soup.format, monitor);
  if (!arguments.joints.empty()) {
    GivenJoints given = joints_for(arguments.joints, soup, monitor);
    if (!given.finding.empty()) session.terminal.warn(given.finding);
    sources.joints = std::move(given.rig);
  }
  if (!arguments.skeleton.empty()) {
    sources.skeleton = read_skeleton(arguments.skeleton);
    require_skeleton_of(soup, *sources.skeleton, arguments.skeleton);
  }
  return sources;
}

void warn_of(const PolygonsRig& found, const RigPolygonsOptions& options, bool joints_are_given,
             bool as_vrm, const RigArguments& arguments, Session& session) {
  const std::string failed = skeleton_findings(found, options);
  if (!failed.empty()) session.terminal.warn(failed);
  if (!joints_are_given) {
    for (const std::string& finding : rig_findings(found.character, options.character)) {
      session.terminal.warn(finding);
    }
  }
  if (!as_vrm) return;
  const auto finding = posture_finding(
      found.character, {arguments.mesh, old_rig_in(arguments), joints_are_given, arguments.pose});
  if (finding) session.terminal.warn(*finding);
}

std::string summary_of(const RigArguments& arguments, const PolygonSoup& soup, const Rig& written,
                       const CharacterRig& character) {
  std::string text =
      fmt::format("{}: {}\nrig: {}\n", name_of_input(arguments.mesh),
                  count_of(soup.positions.rows(), "vertex", "vertices"), joints_in_words(written));
  if (character.joints_left_out > 0) {
    text +=
        fmt::format("left out: {} the least (--joint-budget 0: all)\n",
                    count_of(character.joints_left_out, "joint that moves", "joints that move"));
  }
  text += parts_in_words(character.parts) + plan_in_words(character.plan);
  for (std::size_t k = 0; k < character.other_plans.size(); ++k) {
    text += fmt::format("figure {}, {}", k + 2, plan_in_words(character.other_plans[k]));
  }
  return text;
}

int run_rig(RigArguments arguments, Session& session) {
  if (arguments.quiet) session.terminal.be_quiet();
  if (arguments.report == "-") session.terminal.keep_output_clean();
  const std::vector<RigFormat> formats = checked_formats(arguments);
  session.interruption.limit(arguments.time_limit_seconds);

  const auto begin = std::chrono::steady_clock::now();
  const Monitor monitor = session.monitor();
  arguments.as_bound = reads_as_bound(arguments);
  const PolygonSoup soup = read_to_rig(arguments, monitor, session);
  const RigSources sources = sources_of(arguments, soup, session);
  const bool joints_are_given = sources.joints.has_value();
  const RigPolygonsOptions options = options_of(arguments);
  const PolygonsRig found = rig_polygons(soup, sources, options, monitor);
  const bool as_vrm = std::count(formats.begin(), formats.end(), RigFormat::vrm) > 0;
  warn_of(found, options, joints_are_given, as_vrm, arguments, session);
  const Surface given{soup.positions, triangulate(soup)};
  const Rig written =
      rig_for_export(found.character.rig, found.character.plan, given,
                     {arguments.pose, arguments.ground_root, !arguments.no_ends, joints_are_given},
                     found.character.other_plans);
  if (as_vrm && joints_are_given)
    require_human_roles(arguments.mesh, written, old_rig_in(arguments));
  std::string old_rig_in_words;
  std::vector<OutputFile> files =
      rig_files(arguments, soup, written, formats, session, old_rig_in_words);
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  if (!arguments.report.empty()) {
    files.push_back(
        {arguments.report, rig_report_json({given, found.character, written,
                                            name_of_input(arguments.mesh), seconds()})});
  }
  write_outputs(files, session);
  if (arguments.quiet) return ExitCode::done;
  std::string text = summary_of(arguments, soup, written, found.character) + old_rig_in_words;
  for (const OutputFile& file : files) text += fmt::format("wrote {}\n", file.name);
  session.terminal.result(text + fmt::format("{:.2f} s\n", seconds()));
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
