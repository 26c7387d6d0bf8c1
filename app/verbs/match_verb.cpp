// curveskel match: which branch, junction and vertex of one surface is which in another.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include <curveskel/extract_repaired.hpp>
#include <curveskel/match.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include "app/arguments.hpp"
#include "app/certificate_table.hpp"
#include "app/command_line.hpp"
#include "app/counted.hpp"
#include "app/kernel_cache.hpp"
#include "app/match_report.hpp"
#include "app/output_files.hpp"
#include "app/surface_input.hpp"
#include "app/verbs/verbs.hpp"

namespace curveskel {
namespace {

struct MatchArguments {
  std::filesystem::path a;
  std::filesystem::path b;
  std::string output;
  bool by_shape = false;
  bool quiet = false;
  double time_limit_seconds = 0;
  RepairOptions repair;
  ExtractOptions extract;
};

struct Extracted {
  PolygonSoup soup;
  RepairedSurface repaired;
  CurveSkeleton skeleton;
};

/// Says all that its certificate lacks.
Extracted extracted(const std::filesystem::path& file, const MatchArguments& arguments,
                    Session& session) {
  const Monitor monitor = session.monitor();
  const int threads = arguments.extract.threads;
  Extracted result;
  result.soup = read_surface(file, monitor);
  result.repaired = repair(result.soup, arguments.repair, monitor, threads);
  RepairedExtraction found =
      extract_repaired(result.repaired, arguments.repair, arguments.extract, monitor);
  if (found.repaired_again) result.repaired = std::move(*found.repaired_again);
  const std::string failed =
      all_failures(found.extraction.certificate, arguments.extract.certificate);
  if (!failed.empty()) session.terminal.warn(name_of_input(file) + ": " + failed);
  result.skeleton = std::move(found.extraction.skeleton);
  return result;
}

std::string summary(const MatchRecord& record) {
  const auto& pairs = record.found.match.branches;
  const UnmatchedBranches alone =
      unmatched_branches(record.skeleton_a, record.skeleton_b, record.found.match);
  const auto ambiguous = std::count_if(pairs.begin(), pairs.end(),
                                       [](const BranchPair& pair) { return pair.ambiguous; });
  const auto vertices = (record.found.vertex_of_a.array() >= 0).count();
  const auto count = static_cast<std::int64_t>(pairs.size());
  const auto branches_of = [count](const std::vector<int>& without_partner) {
    return count_of(count + static_cast<std::int64_t>(without_partner.size()), "branch",
                    "branches");
  };
  std::string text =
      fmt::format("{}: {}; {}: {}; {}, {} ambiguous\n", record.file_a, branches_of(alone.of_a),
                  record.file_b, branches_of(alone.of_b), count_of(count, "pair"), ambiguous);
  if (!alone.of_a.empty()) {
    text +=
        fmt::format("without a partner in {}: {}\n", record.file_a, fmt::join(alone.of_a, ", "));
  }
  if (!alone.of_b.empty()) {
    text +=
        fmt::format("without a partner in {}: {}\n", record.file_b, fmt::join(alone.of_b, ", "));
  }
  const auto junctions = static_cast<std::int64_t>(record.found.match.junctions.size());
  text +=
      fmt::format("{}, {} of {}\n", count_of(junctions, "pair of junctions", "pairs of junctions"),
                  vertices, count_of(record.found.vertex_of_a.size(), "vertex", "vertices"));
  if (record.found.by_vertices) {
    text +=
        "both files have the same faces: paired by their vertices (--by-shape: by shape alone)\n";
  }
  return text;
}

int run_match(MatchArguments arguments, Session& session) {
  if (arguments.quiet) session.terminal.be_quiet();
  require_extension(arguments.output, "match", "json");
  if (is_standard_input(arguments.a) && is_standard_input(arguments.b)) {
    throw UsageError("- is standard input, which gives one surface; name a file for the other");
  }
  check_outputs({arguments.output}, {arguments.a, arguments.b});
  if (arguments.output == "-") session.terminal.keep_output_clean();
  session.interruption.limit(arguments.time_limit_seconds);
  arguments.extract.fairing = false;
  const Extracted a = extracted(arguments.a, arguments, session);
  const Extracted b = extracted(arguments.b, arguments, session);
  const InputMatch match =
      match_inputs({a.soup, a.repaired, a.skeleton}, {b.soup, b.repaired, b.skeleton},
                   {arguments.extract.threads, arguments.by_shape}, session.monitor());
  const std::string file_a = name_of_input(arguments.a);
  const std::string file_b = name_of_input(arguments.b);
  const MatchRecord record{file_a, file_b, a.skeleton, b.skeleton, match};
  write_outputs({{arguments.output, match_json(record)}}, session);
  if (!arguments.quiet) {
    std::string text = summary(record);
    if (arguments.output != "-") text += fmt::format("wrote {}\n", arguments.output);
    session.terminal.result(text);
  }
  return ExitCode::done;
}

}  // namespace

Verb add_match(CLI::App& program) {
  const auto arguments = std::make_shared<MatchArguments>();
  CLI::App* parser = program.add_subcommand(
      "match", "Say which branch, junction and vertex of one surface is which in another");
  parser
      ->add_option("A", arguments->a,
                   "surface file: " + names_in(surface_formats) +
                       ", vrm, or one of these gzipped; - is standard input")
      ->required()
      ->type_name("");
  parser
      ->add_option(
          "B", arguments->b,
          "another: the same body in another pose, one of its kind, a later step of growth")
      ->required()
      ->type_name("");
  parser
      ->add_option("-o,--output", arguments->output,
                   "pairs of branches, junctions and vertices; - is standard output")
      ->required()
      ->type_name("OUT.json");
  parser->add_flag(
      "--by-shape", arguments->by_shape,
      "compare shapes alone, also where both files have the same faces, whose vertices "
      "are taken for the same");
  ExtractOptions& options = arguments->extract;
  options.fair.iterations = 0;
  options.contraction.program_cache = kernel_cache();
  add_number(*parser, "--detail", options.embed.detail, 0.0, 1.0,
             "0..1: how small a branch may be");
  add_threads(*parser, options.threads);
  add_repair(*parser, arguments->repair);
  add_time_limit(*parser, arguments->time_limit_seconds);
  parser->add_flag("-q,--quiet", arguments->quiet, "print errors only");
  return {parser, [arguments](Session& session) { return run_match(*arguments, session); }};
}

}  // namespace curveskel
