// curveskel extract: a surface file in, its curve skeleton out.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>

#include <curveskel/branch_profiles.hpp>
#include <curveskel/branch_territories.hpp>
#include <curveskel/extract_repaired.hpp>
#include <curveskel/html_page.hpp>
#include <curveskel/labelled_surface.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/skeleton_files.hpp>
#include "app/arguments.hpp"
#include "app/certificate_table.hpp"
#include "app/command_line.hpp"
#include "app/counted.hpp"
#include "app/kernel_cache.hpp"
#include "app/output_files.hpp"
#include "app/report.hpp"
#include "app/skeleton_levels.hpp"
#include "app/surface_input.hpp"
#include "app/verbs/verbs.hpp"

namespace curveskel {
namespace {

namespace fs = std::filesystem;

struct ExtractArguments {
  fs::path mesh;
  std::vector<std::string> outputs;
  std::optional<SkeletonFormat> format;
  std::string report;
  std::string profiles;
  double spacing = 0;
  std::string junctions;
  std::vector<std::string> labelled;
  std::string html;
  int levels = 1;
  bool quiet = false;
  bool strict = false;
  double time_limit_seconds = 0;
  Preset preset = Preset::standard;
  RepairOptions repair;
  ExtractOptions options;
};

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

template <typename Work>
auto timed(std::vector<StageTime>& times, const char* stage, const Work& work) {
  const auto begin = Clock::now();
  auto result = work();
  times.push_back({stage, seconds_since(begin), {}});
  return result;
}

/// "tried faired: not better (1.25 s)", of the whole surface: a note tells of what was kept.
std::string tries_in_vain(const std::vector<Try>& history) {
  std::string text;
  for (std::size_t number = 1; number < history.size(); ++number) {
    const Try& one = history[number];
    if (one.part_of >= 0 || one.outcome == Outcome::kept) continue;
    text +=
        fmt::format("  also tried {}: {}{} ({:.2f} s)\n", one.name, name_of(outcomes, one.outcome),
                    one.message.empty() ? "" : ", " + one.message, one.seconds);
  }
  return text;
}

std::string summary(const ExtractArguments& arguments, const ExtractionRecord& record) {
  const CurveSkeleton& skeleton = record.extraction.skeleton;
  const Certificate& certificate = record.extraction.certificate;
  const Surface& surface = record.repaired.surface;
  std::string text =
      fmt::format("{}: {}, {}; {}, genus {}\n", name_of_input(arguments.mesh),
                  count_of(surface.positions.rows(), "vertex", "vertices"),
                  count_of(surface.triangles.rows(), "triangle"),
                  count_of(certificate.components_of_surface, "component"), certificate.genus);
  if (record.preset != Preset::standard)
    text += fmt::format("  preset: {}\n", name_of(presets, record.preset));
  for (const std::string& line : record.repaired.changes.lines)
    text += fmt::format("  changed: {}\n", line);
  for (const std::string& line : record.repaired.repairs.lines)
    text += fmt::format("  repaired: {}\n", line);
  for (const std::string& line : record.notes) text += fmt::format("  {}\n", line);
  text += tries_in_vain(record.extraction.history);
  text += fmt::format("skeleton: {}, {}\n", count_of(skeleton.nodes.rows(), "node"),
                      count_of(skeleton.edges.rows(), "edge"));
  return text + certificate_table(certificate, arguments.options.certificate);
}

/// Components run side by side, so that their stages may take longer than the run.
std::string time_line(const std::vector<StageTime>& times, double seconds, bool one_component) {
  std::string parts;
  for (const StageTime& time : times) {
    parts += fmt::format("{}{} {:.2f}", parts.empty() ? "" : ", ", time.stage, time.seconds);
  }
  return fmt::format("{:.2f} s ({}{}); {:.0f} MB at most\n", seconds,
                     one_component ? "" : "summed over components: ", parts,
                     static_cast<double>(peak_memory_bytes()) / 1e6);
}

/// "arm.ply" of level 2 of several: "arm.2.ply", the finest is 1.
std::string name_of_level(const std::string& output, int level) {
  fs::path name(output);
  const std::string extension = name.extension().string();
  return name.replace_extension("." + std::to_string(level) + extension).string();
}

/// All names that may be written.
std::vector<std::string> skeleton_names(const ExtractArguments& arguments) {
  if (arguments.levels == 1) return arguments.outputs;
  std::vector<std::string> names;
  for (const std::string& output : arguments.outputs) {
    if (output == "-") throw UsageError("--levels writes a file for each level, so not to -");
    for (int level = 1; level <= arguments.levels; ++level) {
      names.push_back(name_of_level(output, level));
    }
  }
  return names;
}

std::string provenance_of(const ExtractArguments& arguments) {
  return program_and_version() + ", " + name_of_input(arguments.mesh);
}

/// Of the finest level.
void format_tables(const ExtractArguments& arguments, const ExtractionRecord& record,
                   Session& session, std::vector<OutputFile>& files) {
  const Surface& surface = record.repaired.surface;
  const CurveSkeleton& skeleton = record.extraction.skeleton;
  if (!arguments.profiles.empty()) {
    const ProfileOptions options{arguments.spacing, arguments.options.threads,
                                 record.repaired.rims};
    files.push_back({arguments.profiles, format_profiles(branch_profiles(surface, skeleton, options,
                                                                         session.monitor()))});
  }
  if (!arguments.junctions.empty()) {
    files.push_back({arguments.junctions, format_junctions(skeleton)});
  }
  if (arguments.labelled.empty()) return;
  const BranchLabels labels = labels_of_input(record.soup, record.repaired, skeleton);
  for (const std::string& name : arguments.labelled) {
    files.push_back(
        {name, format_labelled_surface(record.soup, labels, format_of(name, labelled_formats),
                                       provenance_of(arguments))});
  }
}

std::string page_of(const ExtractArguments& arguments, const ExtractionRecord& record) {
  const Certificate& certificate = record.extraction.certificate;
  const CertificateOptions& options = arguments.options.certificate;
  return html_page(
      record.repaired.surface, record.extraction.skeleton,
      {name_of_input(arguments.mesh), certificate_table(certificate, options),
       all_failures(certificate, options), history_in_lines(record, provenance_of(arguments)),
       record.repaired.rims, customary_up(record.soup.format, record.soup.to_gltf)},
      arguments.options.threads);
}

/// One file in each of the formats.
void format_one(const ExtractionRecord& record, const std::vector<SkeletonFormat>& formats,
                const std::vector<std::string>& names, const ExtractArguments& arguments,
                std::vector<OutputFile>& files) {
  const Surface& surface = record.repaired.surface;
  const CurveSkeleton& skeleton = record.extraction.skeleton;
  SkeletonContext context;
  context.surface = &surface;
  context.up = customary_up(record.soup.format, record.soup.to_gltf);
  context.provenance = provenance_of(arguments);
  context.report_json = result_json(record);
  const CurveSkeleton of_input = on_input_vertices(record.repaired, skeleton);
  std::optional<BranchTerritories> territories;
  if (std::count(formats.begin(), formats.end(), SkeletonFormat::csv) > 0) {
    territories = branch_territories(surface, skeleton);
    context.territories = &*territories;
  }
  for (std::size_t i = 0; i < formats.size(); ++i) {
    files.push_back({names[i], format_skeleton(of_input, formats[i], context)});
  }
}

std::vector<OutputFile> format_outputs(const ExtractArguments& arguments,
                                       const std::vector<SkeletonFormat>& formats,
                                       const ExtractionRecord& record, Session& session) {
  std::vector<OutputFile> files;
  const Monitor monitor = session.monitor();
  monitor.report("write", 0);
  if (arguments.levels == 1) {
    format_one(record, formats, arguments.outputs, arguments, files);
    return files;
  }
  const auto levels = levels_of(record.repaired, record.extraction, record.options.certificate,
                                arguments.levels, monitor);
  for (const ExtractionLevel& one : levels) {
    std::vector<std::string> names;
    names.reserve(arguments.outputs.size());
    for (const std::string& output : arguments.outputs) {
      names.push_back(name_of_level(output, one.level.number));
    }
    format_one({record.soup, record.repaired, record.repair_options, record.options, one.extraction,
                record.notes, record.preset, one.level},
               formats, names, arguments, files);
  }
  const auto count = static_cast<int>(levels.size());
  if (count < arguments.levels) {
    session.terminal.warn(fmt::format("the skeleton has {}, fewer than the {} of --levels",
                                      count_of(count, "level"), arguments.levels));
  }
  return files;
}

/// "labelled.ply" and "arm.labelled.ply" among the outputs are the surface with its branches.
void take_labelled(ExtractArguments& arguments) {
  const auto is_labelled = [](const std::string& output) {
    const fs::path stem = fs::path(output).stem();
    return stem == "labelled" || stem.extension() == ".labelled";
  };
  std::vector<std::string>& outputs = arguments.outputs;
  const auto first =
      std::stable_partition(outputs.begin(), outputs.end(), std::not_fn(is_labelled));
  arguments.labelled.insert(arguments.labelled.end(), first, outputs.end());
  outputs.erase(first, outputs.end());
}

/// Fails before hours of work rather than after; a result on standard output is alone there.
void check_names(const ExtractArguments& arguments, Session& session) {
  require_extension(arguments.report, "--report", "json");
  require_extension(arguments.profiles, "--profiles", "csv");
  require_extension(arguments.junctions, "--junctions", "csv");
  require_extension(arguments.html, "--html", "html");
  std::vector<std::string> names = skeleton_names(arguments);
  for (const std::string& table :
       {arguments.report, arguments.profiles, arguments.junctions, arguments.html}) {
    if (!table.empty()) names.push_back(table);
  }
  for (const std::string& name : arguments.labelled) {
    (void)format_of(name, labelled_formats);
    names.push_back(name);
  }
  check_outputs(names, {arguments.mesh});
  const bool to_output = std::count(names.begin(), names.end(), "-") > 0;
  if (to_output) session.terminal.keep_output_clean();
}

int run_extract(ExtractArguments arguments, Session& session) {
  const auto begin = Clock::now();
  if (arguments.quiet) session.terminal.be_quiet();
  take_labelled(arguments);
  const auto formats = formats_of(arguments.outputs, arguments.format);
  check_names(arguments, session);
  if (const auto idle = detail_finding(arguments.options.embed)) session.terminal.warn(*idle);
  arguments.options.fairing = arguments.options.fair.iterations > 0;
  session.interruption.limit(arguments.time_limit_seconds);

  std::vector<std::string> notes;
  Monitor monitor = session.monitor();
  monitor.note = nullptr;  // the summary has these
  std::vector<StageTime> times;
  const PolygonSoup soup =
      timed(times, "read", [&] { return read_surface(arguments.mesh, monitor); });
  RepairedSurface repaired = timed(times, "repair", [&] {
    return repair(soup, arguments.repair, monitor, arguments.options.threads);
  });
  monitor.note = [&notes](std::string_view line) { notes.emplace_back(line); };
  RepairedExtraction found =
      extract_repaired(repaired, arguments.repair, arguments.options, monitor);
  if (found.repaired_again) repaired = std::move(*found.repaired_again);
  const Extraction& extraction = found.extraction;
  times.insert(times.end(), extraction.times.begin(), extraction.times.end());

  const ExtractionRecord record{soup,       repaired, arguments.repair, arguments.options,
                                extraction, notes,    arguments.preset, {}};
  auto files = timed(times, "write", [&] {
    auto formatted = format_outputs(arguments, formats, record, session);
    format_tables(arguments, record, session, formatted);
    if (!arguments.html.empty()) {
      formatted.push_back({arguments.html, page_of(arguments, record)});
    }
    return formatted;
  });
  if (!arguments.report.empty()) {
    std::vector<std::string> names;
    names.reserve(files.size());
    for (const OutputFile& file : files) names.push_back(file.name);
    files.push_back({arguments.report, report_json(record, {times, seconds_since(begin), names})});
  }
  write_outputs(files, session);

  if (!arguments.quiet) {
    std::string text = summary(arguments, record);
    for (const OutputFile& file : files) {
      if (file.name != "-") text += fmt::format("wrote {}\n", file.name);
    }
    session.terminal.result(
        text + time_line(times, seconds_since(begin), extraction.components.size() == 1));
  }
  return exit_code_of(extraction.certificate, arguments.options.certificate, arguments.strict,
                      session);
}

/// MESH and all names of files that are written.
void add_files(CLI::App& parser, ExtractArguments& arguments) {
  add_mesh(parser, arguments.mesh);
  parser
      .add_option("-o,--output", arguments.outputs,
                  "skeleton file, its format by the extension; may be given several times; - is "
                  "standard output; NAME.labelled.ply, .vtp or .glb is as --labelled")
      ->required()
      ->type_name("OUT")
      ->allow_extra_args(false);
  parser
      .add_option_function<std::string>(
          "--format",
          [&arguments](const std::string& name) {
            arguments.format = choice_of(skeleton_formats, name);
            if (!arguments.format) {
              throw CLI::ValidationError("--format",
                                         name + " is none of: " + names_in(skeleton_formats));
            }
          },
          "format of standard output")
      ->type_name("NAME");
  parser
      .add_option("--report", arguments.report, "what was changed, decided and measured, as JSON")
      ->type_name("FILE.json");
  CLI::Option* const profiles =
      parser
          .add_option("--profiles", arguments.profiles,
                      "sections of the surface across the branches, at each node, as CSV")
          ->type_name("FILE.csv");
  add_number(parser, "--spacing", arguments.spacing, 0.0, std::numeric_limits<double>::max(),
             "of the sections along a branch, or the next smaller that divides it, in units of the "
             "model; 0 = at each node")
      ->needs(profiles);
  parser
      .add_option("--junctions", arguments.junctions,
                  "junctions with the angles between their branches, as CSV")
      ->type_name("FILE.csv");
  parser
      .add_option("--html", arguments.html,
                  "a page with the skeleton in its surface to turn, tables, plots, certificate; it "
                  "needs no network")
      ->type_name("FILE.html");
  parser
      .add_option("--labelled", arguments.labelled,
                  "the surface of the file coloured by its branches: " + names_in(labelled_formats))
      ->type_name("FILE")
      ->allow_extra_args(false);
}

void add_resolution(CLI::App& parser, ExtractOptions& options) {
  parser
      .add_option_function<std::string>(
          "--resolution",
          [&options](const std::string& text) {
            if (text == "full") {
              options.resolution = 0;
            } else if (!CLI::detail::lexical_cast(text, options.resolution) ||
                       options.resolution < options.least_resolution) {
              throw CLI::ValidationError(
                  "--resolution", fmt::format("needs full or a number of vertices from {} up, as "
                                              "many as a component has at least, not {}",
                                              options.least_resolution, text));
            }
          },
          fmt::format("working vertices of the whole surface, from {} up",
                      options.least_resolution))
      ->type_name("N|full")
      ->default_str(std::to_string(options.resolution));
}

}  // namespace

Verb add_extract(CLI::App& program) {
  const auto arguments = std::make_shared<ExtractArguments>();
  CLI::App* parser =
      program.add_subcommand("extract", "Extract the curve skeleton of a surface file");
  ExtractOptions& options = arguments->options;
  options.fair.iterations = 0;
  add_preset(*parser, arguments->preset, arguments->repair, options);
  add_files(*parser, *arguments);
  add_choice(*parser, "--flow", options.contraction.flow, flows, "contraction flow");
  options.contraction.program_cache = kernel_cache();
  options.fair.program_cache = kernel_cache();
  add_choice(*parser, "--solver", options.contraction.solver, solvers, "least-squares back end");
  add_resolution(*parser, options);
  add_surgery(*parser, options);
  add_number(
      *parser, "--detail", options.embed.detail, 0.0, 1.0,
      "0..1: how small a branch may be: below 0.5 the clearer ones of the skeleton, above it more "
      "beside them; nothing moves");
  add_number(*parser, "--levels", arguments->levels, 1, 100,
             "write so many levels, OUT.1.EXT the finest, as the widest gaps between the lives of "
             "the branches have them; tables and report are of the finest");
  add_number(
      *parser, "--fair", options.fair.iterations, 0, 1000000,
      "iterations of fairing before the contraction, for noisy surfaces: about ten times the "
      "noise in % of the diagonal");
  add_threads(*parser, options.threads);
  add_repair(*parser, arguments->repair);
  add_time_limit(*parser, arguments->time_limit_seconds);
  parser->add_flag(
      "--strict", arguments->strict,
      "a skeleton that leaves the surface or stops half-way through a limb, a surface not made of "
      "tubes, or a wrap of another shape is an error, too (exit 5), as a wrong topology always is");
  parser->add_flag("-q,--quiet", arguments->quiet, "print errors only");
  parser->footer(meanings("Presets", presets) + meanings("Flows", flows) +
                 meanings("Solvers", solvers) + meanings("Surgeries", surgery_methods) +
                 meanings("Embeddings", embed_methods) + meanings("Formats", skeleton_formats));
  return {parser, [arguments](Session& session) { return run_extract(*arguments, session); }};
}

}  // namespace curveskel
