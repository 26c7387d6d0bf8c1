// curveskel evaluate: the certificate of any skeleton file.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>

#include "app/arguments.hpp"
#include "app/certificate_table.hpp"
#include "app/command_line.hpp"
#include "app/output_files.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "skeleton/certificate.hpp"
#include "skeleton/skeleton_files.hpp"
#include "surface/clean.hpp"
#include "surface/read.hpp"

namespace curveskel {
namespace {

struct EvaluateArguments {
  std::filesystem::path mesh;
  std::filesystem::path skeleton;
  std::string json;
  bool quiet = false;
  CertificateOptions options;
};

int run_evaluate(const EvaluateArguments& arguments, Session& session) {
  if (arguments.quiet) session.terminal.be_quiet();
  if (!arguments.json.empty()) {
    check_outputs({arguments.json}, arguments.mesh);
    check_outputs({arguments.json}, arguments.skeleton);
  }
  if (arguments.json == "-") session.terminal.keep_output_clean();

  const Monitor monitor = session.monitor();
  const CurveSkeleton skeleton = read_skeleton(arguments.skeleton);
  const CleanSurface cleaned = clean(read_polygons(arguments.mesh, monitor), monitor);
  const Certificate certificate = evaluate(cleaned.surface, skeleton, arguments.options, monitor);

  session.terminal.end_progress();
  if (!arguments.json.empty()) {
    write_outputs({{arguments.json, evaluation_json(arguments.mesh.filename().string(),
                                                    arguments.skeleton.filename().string(),
                                                    certificate, arguments.options)}},
                  session);
  }
  if (!arguments.quiet) {
    session.terminal.result(certificate_table(certificate, arguments.options));
  }
  return ExitCode::done;
}

}  // namespace

Verb add_evaluate(CLI::App& program) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* parser = program.add_subcommand(
      "evaluate", "Print the certificate of a skeleton file, this program's or another's");
  parser->add_option("MESH", arguments->mesh, "the surface that it is the skeleton of")
      ->required()
      ->type_name("");
  parser
      ->add_option("SKELETON", arguments->skeleton,
                   "skeleton file: obj, ply, cgal, swc, vtp, graphml or json")
      ->required()
      ->type_name("");
  parser->add_option("--json", arguments->json, "the certificate as JSON; - is standard output")
      ->type_name("FILE");
  add_number(*parser, "--threads", arguments->options.threads, 0, 4096,
             "at most; 0 = one per core; the result does not depend on it");
  parser->add_flag("-q,--quiet", arguments->quiet, "print errors only");
  return {parser, [arguments](Session& session) { return run_evaluate(*arguments, session); }};
}

}  // namespace curveskel
