// The two surgeries side by side on the same contraction: own with the embedding, CGAL's with the
// embedding and CGAL's alone. No second tries. Tables for reading on standard output.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <curveskel/extract.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>

namespace curveskel::bench {
namespace {

namespace fs = std::filesystem;

struct Way {
  const char* name;
  SurgeryMethod surgery;
  EmbedMethod embed;
};

constexpr std::array<Way, 3> ways{{
    {"own, embedded", SurgeryMethod::own, EmbedMethod::own},
    {"CGAL, embedded", SurgeryMethod::cgal, EmbedMethod::own},
    {"CGAL alone", SurgeryMethod::cgal, EmbedMethod::none},
}};

struct Run {
  Certificate certificate;
  double seconds = 0;
  std::string cut;  ///< how the graph came about
};

/// "1st", or the tries that components' cuts needed beyond the first.
std::string cut_of(const std::vector<Try>& history) {
  const bool level_sets = is_kept(history, try_level_sets);
  const bool gentler = is_kept(history, try_gentler);
  if (!level_sets && !gentler) return "1st";
  return fmt::format("{}{}{}", level_sets ? "level sets" : "", level_sets && gentler ? ", " : "",
                     gentler ? "2nd" : "");
}

Run run(const Surface& surface, const Way& way, int threads) {
  ExtractOptions options;
  options.surgery.method = way.surgery;
  options.embed.method = way.embed;
  options.threads = options.certificate.threads = threads;
  options.fair_if_outside = options.all_vertices_if_failed = false;
  const auto start = std::chrono::steady_clock::now();
  const Extraction found = extract(surface, options, {});
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  return {found.certificate, taken.count(), cut_of(found.history)};
}

std::string row(const std::string& file, const Way& way, const Run& run) {
  const Certificate& c = run.certificate;
  return fmt::format(
      "| {} | {} | {} | {}/{} | {}/{} | {:.4f} | {:.3f} | {:.3f} | {} | {} | {:.2f} |\n", file,
      way.name, run.cut, c.components, c.components_of_surface, c.cycle_rank, c.genus,
      c.inside_fraction, c.centredness_median, c.coverage, c.tips, c.spurs, run.seconds);
}

/// The mean of what is finite.
double mean(const std::vector<Run>& runs, const std::function<double(const Run&)>& value) {
  double sum = 0;
  int count = 0;
  for (const Run& one : runs) {
    if (!std::isfinite(value(one))) continue;
    sum += value(one);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

std::string summary(const std::array<std::vector<Run>, ways.size()>& runs) {
  std::string text = fmt::format("| over {} surfaces |", runs[0].size());
  for (const Way& way : ways) text += fmt::format(" {} |", way.name);
  text += "\n|---|---|---|---|\n";
  const auto line = [&](const std::string& name, int digits, double factor,
                        const std::function<double(const Run&)>& value) {
    text += "| " + name + " |";
    for (const auto& one : runs) {
      const double times = factor > 0 ? factor : static_cast<double>(one.size());
      text += fmt::format(" {:.{}f} |", mean(one, value) * times, digits);
    }
    text += "\n";
  };
  constexpr double in_the_mean = 1;
  constexpr double in_all = 0;
  line("components and cycles right on", 0, in_all, [](const Run& r) {
    const Certificate& c = r.certificate;
    return c.components == c.components_of_surface && c.cycle_rank == c.genus ? 1.0 : 0.0;
  });
  line("the same, and round every handle", 0, in_all,
       [](const Run& r) { return r.certificate.topology_correct() ? 1.0 : 0.0; });
  line("cut at the first try on", 0, in_all,
       [](const Run& r) { return r.cut == "1st" ? 1.0 : 0.0; });
  line("inside, mean", 4, in_the_mean, [](const Run& r) { return r.certificate.inside_fraction; });
  line("all inside on", 0, in_all,
       [](const Run& r) { return r.certificate.inside_fraction >= 1 ? 1.0 : 0.0; });
  line("centredness, mean of the finite medians", 4, in_the_mean,
       [](const Run& r) { return r.certificate.centredness_median; });
  line("coverage, mean", 4, in_the_mean, [](const Run& r) { return r.certificate.coverage; });
  line("tips in all", 0, in_all, [](const Run& r) { return double(r.certificate.tips); });
  line("spurs in all", 0, in_all, [](const Run& r) { return double(r.certificate.spurs); });
  line("seconds in all", 1, in_all, [](const Run& r) { return r.seconds; });
  return text;
}

void compare(const std::vector<fs::path>& files, int threads) {
  std::array<std::vector<Run>, ways.size()> runs;
  std::string rows;
  for (const fs::path& file : files) {
    const Surface surface = repair(read_polygons(file, {}), {}, {}).surface;
    for (std::size_t w = 0; w < ways.size(); ++w) {
      runs[w].push_back(run(surface, ways[w], threads));
      rows += row(file.filename().string(), ways[w], runs[w].back());
      std::cerr << row(file.filename().string(), ways[w], runs[w].back());
    }
  }
  std::cout
      << summary(runs)
      << "\n| file | surgery | cut | components | cycles | inside | centredness, median | "
         "coverage | tips | spurs | seconds |\n|---|---|---|---|---|---|---|---|---|---|---|\n"
      << rows;
}

}  // namespace
}  // namespace curveskel::bench

int main(int argc, char** argv) {
  std::vector<std::filesystem::path> files;
  int threads = 0;
  CLI::App app("Compares the surgeries on closed surfaces");
  app.add_option("files", files, "surfaces")->required();
  app.add_option("--threads", threads, "0 = one per core")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    curveskel::bench::compare(files, threads);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
