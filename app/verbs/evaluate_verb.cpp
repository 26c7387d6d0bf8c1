// curveskel evaluate: the certificate of any skeleton file, or a rig beside somebody's.
#include <fmt/core.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <curveskel/certificate.hpp>
#include <curveskel/compare_rigs.hpp>
#include <curveskel/evaluate_repaired.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/skeleton_files.hpp>
#include "app/arguments.hpp"
#include "app/certificate_table.hpp"
#include "app/command_line.hpp"
#include "app/output_files.hpp"
#include "app/report.hpp"
#include "app/rig_comparison_table.hpp"
#include "app/rig_sources.hpp"
#include "app/surface_input.hpp"
#include "app/verbs/verbs.hpp"

namespace curveskel {
namespace {

struct EvaluateArguments {
  std::filesystem::path mesh;
  std::filesystem::path skeleton;
  std::filesystem::path against;
  std::filesystem::path rig_truth;  ///< then `mesh` is a rig, and there is no skeleton
  std::string json;
  bool quiet = false;
  bool strict = false;
  double time_limit_seconds = 0;
  RepairOptions repair;
  CertificateOptions options;
};

std::string evaluation_table(const Evaluation& evaluation) {
  std::string text = certificate_table(evaluation.certificate, evaluation.options);
  const SkeletonComparison& comparison = evaluation.comparison;
  if (comparison.against.empty()) return text;
  text += fmt::format("  distance         {:>10.4f} D, Hausdorff; {:.4f} D in the mean; to {}\n",
                      comparison.hausdorff_distance, comparison.mean_distance, comparison.against);
  const auto& [own, other] = comparison.common_ground;
  text += fmt::format(
      "  where both run   {:>8.1f} %  of the length, {:.1f} % of the other's\n"
      "  centredness there{:>10.3f} median, the other's {:.3f}\n",
      100 * own.share, 100 * other.share, own.centredness_median, other.centredness_median);
  return text;
}

/// Of what `rig` writes.
void require_readable_rig(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  for (const char* const other : {"usda", "usdz", "npz", "bvh"}) {
    if (extension != other) continue;
    throw Error(Fault::input, path.string() + ": found a ." + other +
                                  " file, of which --rig-truth reads no rig, needed .glb, .gltf, "
                                  ".vrm, .fbx, .dae, .json or .txt; write one with curveskel rig, "
                                  "or with Blender");
  }
}

/// Joints without weights of all but glTF; without a surface where the format has none.
RiggedSurface rigged_surface(const std::filesystem::path& path, const Monitor& monitor) {
  require_readable_rig(path);
  const std::string extension = lower_extension(path);
  if (extension == "json" || extension == "txt") return {{}, read_joints(path, monitor)};
  const PolygonSoup soup = read_polygons(path, monitor);
  const Surface surface{soup.positions, triangulate(soup)};
  if (keeps_joints_alone(soup.format)) return {surface, read_joints(path, monitor)};
  std::optional<Rig> rig = read_rig(path, monitor);
  if (rig && rig->joints.rows() > 0) return {surface, std::move(*rig)};
  throw Error(Fault::input, path.string() +
                                ": found no rig, needed joints with weights, in a glTF file, "
                                "or joints in .fbx, .dae, .json or .txt; make one with curveskel "
                                "rig");
}

/// Lengths are over the truth's surface: of one without that of the rig, which is the same.
void give_surface(const EvaluateArguments& arguments, const RiggedSurface& rig,
                  RiggedSurface& truth) {
  if (truth.surface.positions.rows() > 0) return;
  if (rig.surface.positions.rows() == 0) {
    throw Error(Fault::input, arguments.rig_truth.string() + " and " + arguments.mesh.string() +
                                  ": found joints alone, needed a surface in one of the two, to "
                                  "measure lengths by; give one as .glb, .gltf, .fbx or .dae");
  }
  truth.surface = rig.surface;
}

int run_rig_truth(const EvaluateArguments& arguments, Session& session) {
  const Monitor monitor = session.monitor();
  const RiggedSurface rig = rigged_surface(arguments.mesh, monitor);
  RiggedSurface truth = rigged_surface(arguments.rig_truth, monitor);
  give_surface(arguments, rig, truth);
  const std::array<std::pair<const Rig*, std::filesystem::path>, 2> both{
      {{&rig.rig, arguments.mesh}, {&truth.rig, arguments.rig_truth}}};
  for (const auto& [one, file] : both) {
    const std::string finding =
        places_of(one->joints, "joints", truth.surface.positions, file).finding;
    if (!finding.empty()) session.terminal.warn(finding);
  }
  const RigComparison comparison = compare_rigs(rig, truth, monitor);
  session.terminal.end_progress();
  if (!arguments.json.empty()) {
    write_outputs({{arguments.json,
                    rig_comparison_json(arguments.mesh.filename().string(),
                                        arguments.rig_truth.filename().string(), comparison)}},
                  session);
  }
  if (!arguments.quiet) session.terminal.result(rig_comparison_table(comparison));
  return ExitCode::done;
}

void require_one_task(const EvaluateArguments& arguments) {
  const bool reads_rigs = !arguments.rig_truth.empty();
  for (const auto& file : {arguments.rig_truth, arguments.skeleton, arguments.against,
                           reads_rigs ? arguments.mesh : std::filesystem::path()}) {
    if (!is_standard_input(file)) continue;
    throw UsageError(reads_rigs ? "- is standard input, which gives a surface and no rig; name a "
                                  "file for each rig of --rig-truth"
                                : "- is standard input, which gives the surface alone; name a file "
                                  "for the skeleton");
  }
  if (arguments.skeleton.empty() == reads_rigs) return;
  throw UsageError(arguments.skeleton.empty()
                       ? "SKELETON is required, or --rig-truth with another rig"
                       : "--rig-truth compares rigs; leave out SKELETON");
}

/// Two rigs are compared as they are.
void require_effect_on_rigs(const CLI::App& parser) {
  if (parser.count("--rig-truth") == 0) return;
  for (const char* name : {"--against", "--components", "--min-size", "--wrap", "--wrap-gap",
                           "--least-sheet", "--least-handle", "--merge-overlapping", "--strict"}) {
    if (parser.count(name) == 0) continue;
    throw UsageError(std::string(name) +
                     " has no effect beside --rig-truth; leave out one of the two");
  }
}

int run_evaluate(const EvaluateArguments& arguments, Session& session) {
  if (arguments.quiet) session.terminal.be_quiet();
  require_one_task(arguments);
  require_extension(arguments.json, "--json", "json");
  if (!arguments.json.empty()) {
    check_outputs({arguments.json},
                  {arguments.mesh, arguments.skeleton, arguments.rig_truth, arguments.against});
  }
  if (arguments.json == "-") session.terminal.keep_output_clean();

  session.interruption.limit(arguments.time_limit_seconds);
  if (!arguments.rig_truth.empty()) return run_rig_truth(arguments, session);
  const Monitor monitor = session.monitor();
  const CurveSkeleton skeleton = read_skeleton(arguments.skeleton);
  RepairedSurface repaired = repair(read_surface(arguments.mesh, monitor), arguments.repair,
                                    monitor, arguments.options.threads);
  const std::string finding =
      places_of(skeleton.nodes, "nodes", repaired.surface.positions, arguments.skeleton).finding;
  if (!finding.empty()) session.terminal.warn(finding);
  Evaluation evaluation;
  evaluation.options = arguments.options;
  RepairedEvaluation found =
      evaluate_repaired(repaired, arguments.repair, skeleton, arguments.options, monitor);
  if (found.repaired_again) repaired = std::move(*found.repaired_again);
  evaluation.repairs = repaired.repairs;
  evaluation.certificate = found.certificate;
  const Certificate& certificate = evaluation.certificate;
  if (!arguments.against.empty()) {
    evaluation.comparison = compare_skeletons(skeleton, read_skeleton(arguments.against),
                                              repaired.surface, arguments.options, monitor);
    evaluation.comparison.against = arguments.against.filename().string();
  }

  session.terminal.end_progress();
  if (!arguments.json.empty()) {
    write_outputs(
        {{arguments.json, evaluation_json(name_of_input(arguments.mesh),
                                          arguments.skeleton.filename().string(), evaluation)}},
        session);
  }
  if (!arguments.quiet) session.terminal.result(evaluation_table(evaluation));
  return exit_code_of(certificate, arguments.options, arguments.strict, session);
}

}  // namespace

Verb add_evaluate(CLI::App& program) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* parser = program.add_subcommand(
      "evaluate", "Print the certificate of a skeleton file, or compare two rigs");
  parser
      ->add_option(
          "MESH", arguments->mesh,
          "the surface that it is the skeleton of, - is standard input; with --rig-truth a rig")
      ->required()
      ->type_name("");
  parser
      ->add_option("SKELETON", arguments->skeleton,
                   "skeleton file: obj, ply, cgal, swc, vtp, graphml or json")
      ->type_name("");
  parser->add_option("--json", arguments->json, "the certificate as JSON; - is standard output")
      ->type_name("FILE");
  parser
      ->add_option("--against", arguments->against,
                   "another skeleton file: distances to it, and which of both is more central "
                   "where both run")
      ->type_name("SKELETON");
  parser
      ->add_option("--rig-truth", arguments->rig_truth,
                   "the rig that somebody has made of the same surface: how near the joints of "
                   "MESH come to it, and of two glTF files its weights and how it bends; both are "
                   "glTF, FBX, DAE, .json of this program or RigNet's .txt")
      ->type_name("RIG");
  add_repair(*parser, arguments->repair);
  add_time_limit(*parser, arguments->time_limit_seconds);
  parser->add_flag("--strict", arguments->strict,
                   "a skeleton that leaves the surface or stops half-way through a limb, a surface "
                   "not made of tubes, or a wrap of another shape is an error, too (exit 5), as a "
                   "wrong topology always is");
  add_threads(*parser, arguments->options.threads);
  parser->add_flag("-q,--quiet", arguments->quiet, "print errors only");
  return {parser, [arguments, parser](Session& session) {
            require_effect_on_rigs(*parser);
            return run_evaluate(*arguments, session);
          }};
}

}  // namespace curveskel
