#include "app/verbs/rig_options.hpp"

#include <limits>
#include <string>

#include <curveskel/read.hpp>
#include "app/arguments.hpp"
#include "app/kernel_cache.hpp"
#include "app/rig_sources.hpp"

namespace curveskel {
namespace {

/// Options that leave others without effect.
struct SourceOptions {
  CLI::Option* skeleton = nullptr;
  CLI::Option* keep = nullptr;
  CLI::Option* given = nullptr;
};

void add_files(CLI::App& parser, RigArguments& arguments) {
  add_mesh(parser, arguments.mesh);
  parser
      .add_option("-o,--output", arguments.outputs,
                  "rig file, its format by the extension; may be given several times")
      ->required()
      ->type_name("OUT.glb")
      ->allow_extra_args(false);
}

SourceOptions add_sources(CLI::App& parser, RigArguments& arguments) {
  SourceOptions found;
  found.skeleton =
      parser
          .add_option("--skeleton", arguments.skeleton,
                      "rig this one (of extract or view, corrected by hand, or of another program) "
                      "instead of extracting one")
          ->type_name("FILE");
  CLI::Option* const bare =
      parser.add_flag("--bare", arguments.bare,
                      "write the surface alone, as viewers show it, without materials and all else "
                      "that the file has, instead of the file itself with the rig in it");
  found.keep =
      parser.add_flag("--keep-rig", arguments.keep_rig,
                      "make no joints, but weights for those that the glTF, FBX or DAE file has");
  parser
      .add_flag("--as-shown", arguments.as_shown,
                "rig a glTF, FBX or DAE file whose old joints rest in another pose than they were "
                "bound in as viewers show it; its vertices are written anew")
      ->excludes(found.keep)
      ->excludes(bare);
  found.given =
      parser
          .add_option("--joints", arguments.joints,
                      "make no joints, but weights for these: glTF with a skin, FBX, DAE, .json of "
                      "this program, "
                      "RigNet's .txt; in the surface's coordinates")
          ->type_name("FILE")
          ->excludes(found.keep);
  return found;
}

void add_plan(CLI::App& parser, RigArguments& arguments) {
  parser
      .add_option("--report", arguments.report,
                  "plan, roles, parts, joints and checks of the weights, as JSON")
      ->type_name("FILE.json");
  add_choice(parser, "--plan", arguments.plan.plan, body_kinds,
             "how the body is built; a humanoid has legs or arms that are not seen, as in a robe, "
             "by proportion");
  add_choice(parser, "--up", arguments.plan.up, directions, "the body's up; auto = found");
  add_choice(parser, "--front", arguments.plan.front, directions,
             "where the body looks; auto = found");
  add_choice(parser, "--names", arguments.names, name_styles, "what joints are called");
  add_choice(parser, "--pose", arguments.pose, rest_poses,
             "in which the rig rests; vertices stay as they are");
  parser.add_flag("--ground-root", arguments.ground_root,
                  "one more joint, on the ground, that all hangs from");
  parser.add_flag("--no-ends", arguments.no_ends,
                  "no joints at tips without a role, which move nothing");
}

void add_joints(CLI::App& parser, RigArguments& arguments) {
  JointOptions& joints = arguments.rig.joints;
  add_number(parser, "--root", joints.root, -1, std::numeric_limits<int>::max(),
             "node of the skeleton, counted from 0 as in its JSON file, that all hangs from, "
             "without a plan; -1 = chosen");
  add_number(parser, "--bone-length", joints.bone_length, 0.5, 1000.0,
             "of straight limbs, in their radius: smaller gives more joints");
  add_number(
      parser, "--joint-budget", arguments.joint_budget, 0, 1000000,
      "of a figure, at most: joints that move the least of the surface are left out; 0 = all");
  add_number(
      parser, "--follow", arguments.parts.follow, 0.0, 100.0,
      "parts that reach out of the body no farther than this, in its thickness there, follow "
      "it without joints of their own; 0 = none");
  add_number(parser, "--softness", arguments.rig.skin.softness, 0.05, 20.0,
             "how gently the skin goes over from one joint to the next, in radii");
}

void add_extraction(CLI::App& parser, RigArguments& arguments) {
  add_number(parser, "--detail", arguments.extract.embed.detail, 0.0, 1.0,
             "0..1: how small a branch may be");
  add_number(parser, "--fair", arguments.fair_iterations, 0, 1000000,
             "iterations of fairing before the contraction, for noisy surfaces");
  arguments.extract.contraction.program_cache = kernel_cache();
  arguments.extract.fair.program_cache = kernel_cache();
}

/// One table for every door; see rig_sources.hpp.
void exclude_idle(CLI::App& parser, const SourceOptions& sources) {
  const auto option = [&](const char* name) { return parser.get_option("--" + std::string(name)); };
  for (const char* name : idle_beside_skeleton) option(name)->excludes(sources.skeleton);
  for (const char* name : idle_beside_joints) {
    option(name)->excludes(sources.keep)->excludes(sources.given);
  }
  for (const char* name : idle_beside_kept_rig) option(name)->excludes(sources.keep);
  option("no-ends")->excludes(sources.keep);
}

}  // namespace

void add_rig_options(CLI::App& parser, RigArguments& arguments) {
  add_files(parser, arguments);
  const SourceOptions sources = add_sources(parser, arguments);
  add_vrm_meta(parser, arguments.vrm);
  add_plan(parser, arguments);
  add_joints(parser, arguments);
  add_extraction(parser, arguments);
  exclude_idle(parser, sources);
  add_threads(parser, arguments.threads);
  add_repair(parser, arguments.repair);
  add_time_limit(parser, arguments.time_limit_seconds);
  parser.add_flag("-q,--quiet", arguments.quiet, "print errors only");
  parser.footer(meanings("Formats", rig_formats) + meanings("Plans", body_kinds) +
                meanings("Names", name_styles) + meanings("Poses", rest_poses));
}

}  // namespace curveskel
