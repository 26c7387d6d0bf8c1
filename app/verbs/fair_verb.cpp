// curveskel fair: the surface smoothed, its connectivity and volume kept.
#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/fair_polygons.hpp>
#include <curveskel/read.hpp>
#include <curveskel/write_surface.hpp>
#include "app/arguments.hpp"
#include "app/command_line.hpp"
#include "app/fair_rules.hpp"
#include "app/kernel_cache.hpp"
#include "app/output_files.hpp"
#include "app/report.hpp"
#include "app/surface_input.hpp"
#include "app/verbs/verbs.hpp"

namespace curveskel {
namespace {

namespace fs = std::filesystem;

struct FairArguments {
  fs::path mesh;
  std::string output;
  bool quiet = false;
  double time_limit_seconds = 0;
  FairOptions options;
};

/// The largest motion of a vertex, over the bounding box's diagonal.
std::string moved(const Positions& from, const Positions& to) {
  const double diagonal = bounding_box_diagonal(from);
  if (!(diagonal > 0)) return {};
  const Eigen::VectorXd shares = ((to - from) / diagonal).rowwise().norm();
  const double mean = std::sqrt(shares.squaredNorm() / static_cast<double>(shares.size()));
  return fmt::format("moved {:.2e} D root mean square, {:.2e} D at most\n", mean,
                     shares.maxCoeff());
}

int run_fair(const FairArguments& arguments, Session& session) {
  if (arguments.quiet) session.terminal.be_quiet();
  const SurfaceFormat format = format_of(arguments.output, written_surface_formats);
  check_outputs({arguments.output}, {arguments.mesh});

  session.interruption.limit(arguments.time_limit_seconds);
  const Monitor monitor = session.monitor();
  const PolygonSoup soup = read_surface(arguments.mesh, monitor);
  const Surface result = fair_polygons(soup, arguments.options, monitor);
  const std::string provenance =
      program_and_version() + ", " + name_of_input(arguments.mesh) + ", faired";
  write_outputs({{arguments.output, format_surface(result, format, provenance)}}, session);

  if (!arguments.quiet) {
    session.terminal.result(
        fmt::format("{} iterations by {}: ", arguments.options.iterations,
                    name_of(fair_methods, choose_fair_method(arguments.options.method))) +
        moved(soup.positions, result.positions) + fmt::format("wrote {}\n", arguments.output));
  }
  return ExitCode::done;
}

}  // namespace

Verb add_fair(CLI::App& program) {
  const auto arguments = std::make_shared<FairArguments>();
  FairOptions& options = arguments->options;
  options.program_cache = kernel_cache();
  CLI::App* parser = program.add_subcommand(
      "fair", "Smooth a noisy surface by local Laplacian flow, its volume kept");
  add_mesh(*parser, arguments->mesh);
  parser
      ->add_option(
          "-o,--output", arguments->output,
          "the faired surface, its format by the extension: " + names_in(written_surface_formats))
      ->required()
      ->type_name("OUT");
  add_choice(*parser, "--method", options.method, fair_methods, "how the flow is computed");
  add_number(*parser, "--iterations", options.iterations, 0, 1000000, "of the flow");
  add_number(*parser, "--smoothing", options.smoothing, 0.0, 1e6,
             "mu = W_L / W_H of each patch: 0.5 to 2 takes noise away");
  add_number(*parser, "--rings", options.rings, 1, 1000000,
             "K: a vertex's patch has the vertices within K edges");
  const CLI::Option* const solver = add_choice(*parser, "--local-solver", options.local_solver,
                                               local_solvers, "how the centre of a patch is found");
  add_choice(*parser, "--volume", options.volume, volume_rules, "what becomes of the volume");
  const CLI::Option* const precision =
      add_choice(*parser, "--precision", options.double_precision, precisions, "single or double");
  add_threads(*parser, options.threads);
  add_time_limit(*parser, arguments->time_limit_seconds);
  parser->add_flag("-q,--quiet", arguments->quiet, "print errors only");
  parser->footer(meanings("Methods", fair_methods) + meanings("Local solvers", local_solvers) +
                 meanings("Volume", volume_rules) + meanings("Precision", precisions));
  return {parser, [=](Session& session) {
            require_closed_form(arguments->options, solver->count() > 0);
            require_single_on_device(arguments->options, precision->count() > 0);
            return run_fair(*arguments, session);
          }};
}

}  // namespace curveskel
