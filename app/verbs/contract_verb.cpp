// curveskel contract: the contracted surface, and how it got there.
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/contract_repaired.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/write_surface.hpp>
#include "app/arguments.hpp"
#include "app/command_line.hpp"
#include "app/counted.hpp"
#include "app/kernel_cache.hpp"
#include "app/output_files.hpp"
#include "app/report.hpp"
#include "app/surface_input.hpp"
#include "app/verbs/verbs.hpp"

namespace curveskel {
namespace {

namespace fs = std::filesystem;

struct ContractArguments {
  fs::path mesh;
  std::string output;
  fs::path frames;
  bool quiet = false;
  double time_limit_seconds = 0;
  RepairOptions repair;
  ContractionOptions options;
};

/// A component's surface before the first and after each iteration.
using Frames = std::vector<Surface>;

Surface together(const std::vector<const Surface*>& parts) {
  Eigen::Index vertices = 0;
  Eigen::Index triangles = 0;
  for (const Surface* part : parts) {
    vertices += part->positions.rows();
    triangles += part->triangles.rows();
  }
  Surface whole{Positions(vertices, 3), Triangles(triangles, 3)};
  vertices = triangles = 0;
  for (const Surface* part : parts) {
    whole.positions.middleRows(vertices, part->positions.rows()) = part->positions;
    whole.triangles.middleRows(triangles, part->triangles.rows()) =
        part->triangles.array() + static_cast<int>(vertices);
    vertices += part->positions.rows();
    triangles += part->triangles.rows();
  }
  return whole;
}

std::string name_of_frame(std::size_t frame) { return fmt::format("{:04}.ply", frame); }

/// Frame k has every component after its iteration k, or its last one.
std::vector<OutputFile> frame_files(const std::vector<Frames>& components, const fs::path& folder,
                                    const std::string& provenance) {
  std::size_t count = 0;
  for (const Frames& frames : components) count = std::max(count, frames.size());
  std::vector<OutputFile> files;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<const Surface*> parts;
    parts.reserve(components.size());
    for (const Frames& frames : components)
      parts.push_back(&frames[std::min(k, frames.size() - 1)]);
    const Surface whole = together(parts);
    files.push_back({(folder / name_of_frame(k)).string(),
                     format_surface(whole, SurfaceFormat::ply, provenance)});
  }
  return files;
}

/// Throws UsageError if the file's name is one that a frame will have.
void require_no_frame(const fs::path& file, const fs::path& folder) {
  const std::string stem = file.stem().string();
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  std::error_code none;
  const fs::path within = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (stem.size() < 4 || !std::all_of(stem.begin(), stem.end(), is_digit) ||
      file.extension() != ".ply" || !fs::equivalent(within, folder, none)) {
    return;
  }
  throw UsageError(file.string() + ": --frames would write over it; name another folder");
}

/// The contraction of one component, in a line.
std::string outcome(const Contraction& contraction, int component) {
  const auto reason = std::find_if(stops.begin(), stops.end(),
                                   [&](const auto& one) { return one.value == contraction.stop; });
  const Step last = contraction.steps.empty() ? Step{} : contraction.steps.back();
  return fmt::format("component {}: {}, area {:.2e}, volume {:.2e}; {}\n", component,
                     count_of(static_cast<std::int64_t>(contraction.steps.size()), "iteration"),
                     last.area_ratio, last.volume_ratio, reason->meaning);
}

int run_contract(const ContractArguments& arguments, Session& session) {
  if (arguments.quiet) session.terminal.be_quiet();
  const std::string extension = lower_extension(arguments.output);
  if (extension != "ply" && extension != "om") {
    throw UsageError(arguments.output +
                     ": the contracted surface is written as ply or om; name a "
                     "file with that extension");
  }
  const SurfaceFormat format = format_of(arguments.output, surface_formats);
  check_outputs({arguments.output}, {arguments.mesh});
  if (!arguments.frames.empty()) {
    require_no_frame(arguments.mesh, arguments.frames);
    require_no_frame(arguments.output, arguments.frames);
    make_folder(arguments.frames);
  }

  session.interruption.limit(arguments.time_limit_seconds);
  Monitor monitor = session.monitor();
  const PolygonSoup soup = read_surface(arguments.mesh, monitor);
  const RepairedSurface repaired =
      repair(soup, arguments.repair, monitor, arguments.options.threads);
  std::vector<Frames> frames;
  if (!arguments.frames.empty()) {
    monitor.frame = [&frames](const Frame& now) {
      frames.resize(std::max(frames.size(), static_cast<std::size_t>(now.component) + 1));
      frames[static_cast<std::size_t>(now.component)].push_back(now.surface);
    };
  }
  const RepairedContraction result = contract_repaired(repaired, arguments.options, monitor);
  std::string text;
  for (std::size_t k = 0; k < result.components.size(); ++k) {
    text += outcome(result.components[k], static_cast<int>(k));
  }

  const Surface written = moved_vertices(soup, repaired, result.positions);
  const std::string provenance =
      program_and_version() + ", " + name_of_input(arguments.mesh) + ", contracted";
  auto files = arguments.frames.empty() ? std::vector<OutputFile>()
                                        : frame_files(frames, arguments.frames, provenance);
  files.push_back({arguments.output, format_surface(written, format, provenance)});
  write_outputs(files, session);
  if (files.size() > 1) {
    warn_of_older_files(arguments.frames, name_of_frame(files.size() - 1), session);
  }

  if (!arguments.quiet) {
    if (files.size() > 1) {
      text += fmt::format("wrote {} frames to {}\n", files.size() - 1, arguments.frames.string());
    }
    session.terminal.result(text + fmt::format("wrote {}\n", arguments.output));
  }
  return ExitCode::done;
}

}  // namespace

Verb add_contract(CLI::App& program) {
  const auto arguments = std::make_shared<ContractArguments>();
  CLI::App* parser = program.add_subcommand(
      "contract", "Write the contracted surface: every vertex of the file where it ends up");
  add_mesh(*parser, arguments->mesh);
  parser
      ->add_option("-o,--output", arguments->output,
                   "the contracted surface: the file's own vertices and faces")
      ->required()
      ->type_name("OUT.ply");
  add_choice(*parser, "--flow", arguments->options.flow, flows, "contraction flow");
  arguments->options.program_cache = kernel_cache();
  add_choice(*parser, "--solver", arguments->options.solver, solvers, "least-squares back end");
  add_number(*parser, "--iterations", arguments->options.max_iterations, 1, 1000000, "at most");
  parser
      ->add_option("--frames", arguments->frames,
                   "folder for one surface per iteration, 0000.ply the input; merged vertices "
                   "are gone from these")
      ->type_name("DIR");
  add_threads(*parser, arguments->options.threads);
  add_repair(*parser, arguments->repair);
  add_time_limit(*parser, arguments->time_limit_seconds);
  parser->add_flag("-q,--quiet", arguments->quiet, "print errors only");
  parser->footer(meanings("Flows", flows) + meanings("Solvers", solvers));
  return {parser, [arguments](Session& session) { return run_contract(*arguments, session); }};
}

}  // namespace curveskel
