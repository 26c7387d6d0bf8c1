// Runs this project's pipeline and CGAL's mean curvature flow skeletonization in turn on the same
// files and prints times, ratios and both certificates.
#include <CLI/CLI.hpp>
#include <chrono>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/skeleton_files.hpp>
#include "app/heap.hpp"
#include "bench/cgal_skeleton.hpp"
#include "skeleton/picture/picture.hpp"

namespace curveskel::bench {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<fs::path> files;
  fs::path meshes = CURVESKEL_SHARED_MESHES;
  fs::path csv;
  fs::path markdown;
  fs::path skeletons;
  fs::path pictures;  // of this project's skeletons
  bool cgal_only = false;
  bool ours_only = false;
  int resolution = ExtractOptions{}.resolution;
  int threads = 0;
};

struct Run {
  std::string program;
  std::string file;
  double seconds = 0;            // wall clock, reading included
  double processor_seconds = 0;  // of all threads together
  Eigen::Index nodes = 0;
  Eigen::Index edges = 0;
  CurveSkeleton skeleton;
  Certificate certificate;
  std::optional<CommonGround::Side> common;  // where the other one runs as well, if both ran
  std::string failure;                       // empty = none
};

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The closed, manifold, orientable entries of INDEX.csv, defects left out.
std::vector<fs::path> indexed_meshes(const fs::path& folder) {
  std::vector<fs::path> files;
  std::ifstream index(folder / "INDEX.csv");
  for (std::string line; std::getline(index, line);) {
    std::vector<std::string> cells;
    std::istringstream cut(line);
    for (std::string cell; cells.size() < 9 && std::getline(cut, cell, ',');) cells.push_back(cell);
    if (cells.size() < 9 || cells[0].starts_with("defects/")) continue;
    if (cells[6] == "y" && cells[7] == "y" && cells[8] == "y") files.push_back(folder / cells[0]);
  }
  return files;
}

template <typename Skeletonize>
Run timed(const std::string& program, const fs::path& file, const Surface& surface,
          const Options& options, const Skeletonize& skeletonize) {
  Run run;
  run.program = program;
  run.file = file.filename().string();
  CurveSkeleton& skeleton = run.skeleton;
  const double before = processor_seconds();
  const auto start = std::chrono::steady_clock::now();
  try {
    skeleton = skeletonize();
  } catch (const std::exception& error) {
    run.failure = error.what();
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.processor_seconds = processor_seconds() - before;
  if (!run.failure.empty()) return run;
  run.nodes = skeleton.nodes.rows();
  run.edges = skeleton.edges.rows();
  run.certificate = evaluate(surface, skeleton, {}, {});
  if (!options.skeletons.empty()) {
    fs::create_directories(options.skeletons);
    std::ofstream out(options.skeletons / (run.file + "." + program + ".cgal"));
    out << format_skeleton(skeleton, SkeletonFormat::cgal, {});
  }
  if (!options.pictures.empty() && program == "curveskel") {
    fs::create_directories(options.pictures);
    const PictureOptions small{640, 480};
    std::ofstream out(options.pictures / (file.stem().stem().string() + ".png"), std::ios::binary);
    out << png_picture(skeleton, surface, small);
  }
  return run;
}

Run run_ours(const fs::path& file, const Surface& surface, const Options& options) {
  return timed("curveskel", file, surface, options, [&] {
    ExtractOptions extraction;
    extraction.resolution = options.resolution;
    extraction.threads = options.threads;
    return extract(repair(read_polygons(file, {}), {}, {}).surface, extraction, {}).skeleton;
  });
}

Run run_cgal(const fs::path& file, const Surface& surface, const Options& options) {
  return timed("CGAL", file, surface, options, [&] { return cgal_skeleton(file); });
}

constexpr const char* columns =
    "file,components,cycle_rank,inside_fraction,deepest_exit,centredness_median,centredness_p90,"
    "coverage,reach,spurs,total_curvature,seconds,nodes,edges,processor_seconds,program,"
    "common_share,common_centredness";

std::string csv_row(const Run& run) {
  const Certificate& c = run.certificate;
  std::ostringstream row;
  row << std::setprecision(6) << run.file << ',' << c.components << ',' << c.cycle_rank << ','
      << c.inside_fraction << ',' << c.deepest_exit << ',' << c.centredness_median << ','
      << c.centredness_p90 << ',' << c.coverage << ',' << c.reach << ',' << c.spurs << ','
      << c.total_curvature << ',' << run.seconds << ',' << run.nodes << ',' << run.edges << ','
      << run.processor_seconds << ',' << run.program << (run.failure.empty() ? "" : " (failed)")
      << ',';
  if (run.common) row << run.common->share;
  row << ',';
  if (run.common) row << run.common->centredness_median;
  return row.str();
}

/// The median of centredness there, or a dash where nothing else ran.
std::string where_both_run(const Run& run) {
  if (!run.common) return "-";
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << run.common->centredness_median;
  return text.str();
}

/// The file's name, linked to its picture as seen from the folder of the table.
std::string linked_name(const Run& run, const Options& options) {
  if (options.pictures.empty() || run.program != "curveskel") return run.file;
  const fs::path picture = options.pictures / (fs::path(run.file).stem().stem().string() + ".png");
  return "[" + run.file + "](" +
         picture.lexically_relative(options.markdown.parent_path()).string() + ")";
}

std::string markdown_row(const Run& run, double ratio, const Options& options) {
  const Certificate& c = run.certificate;
  std::ostringstream row;
  row << std::fixed << "| " << linked_name(run, options) << " | " << run.program << " | ";
  if (!run.failure.empty()) {
    row << "failed: " << run.failure << " |";
    return row.str();
  }
  row << (c.topology_correct() ? "right" : "wrong") << " | " << std::setprecision(4)
      << c.inside_fraction << " | " << c.deepest_exit << " | " << std::setprecision(3)
      << c.centredness_median << " | " << c.centredness_p90 << " | " << where_both_run(run) << " | "
      << c.coverage << " | " << std::setprecision(4) << c.reach << " | " << c.spurs << " | "
      << std::setprecision(1) << c.total_curvature << " | " << std::setprecision(3) << run.seconds
      << " | ";
  if (ratio > 0) row << std::setprecision(1) << ratio;
  row << " |";
  return row.str();
}

constexpr const char* markdown_head =
    "| file | program | topology | inside | deepest exit / D | centredness, median | 90th "
    "percentile | where both run | coverage | reach / D | spurs | total curvature per D | seconds "
    "| ratio |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|";

void print(const Run& run) {
  std::cout << "  " << std::left << std::setw(10) << run.program << std::right << std::fixed;
  if (!run.failure.empty()) {
    std::cout << "failed: " << run.failure << '\n';
    return;
  }
  const Certificate& c = run.certificate;
  std::cout << std::setprecision(3) << run.seconds << " s (" << run.processor_seconds
            << " s of processor)  " << run.nodes << " nodes  components " << c.components << '/'
            << c.components_of_surface << "  cycles " << c.cycle_rank << '/' << c.genus
            << std::setprecision(4) << "  inside " << c.inside_fraction << "  exit "
            << c.deepest_exit << std::setprecision(3) << "  centredness " << c.centredness_median
            << ' ' << c.centredness_p90 << "  (where both run " << where_both_run(run)
            << ")  coverage " << c.coverage << std::setprecision(4) << "  reach " << c.reach
            << "  tips " << c.tips << "  junctions " << c.junctions << "  spurs " << c.spurs
            << std::setprecision(2) << "  total curvature " << c.total_curvature << '\n';
}

void compare(const Options& options) {
  std::ofstream csv;
  std::ofstream markdown;
  if (!options.csv.empty()) (csv = std::ofstream(options.csv)) << columns << '\n';
  if (!options.markdown.empty())
    (markdown = std::ofstream(options.markdown)) << markdown_head << '\n';
  for (const fs::path& file :
       options.files.empty() ? indexed_meshes(options.meshes) : options.files) {
    const Surface surface = repair(read_polygons(file, {}), {}, {}).surface;
    std::cout << file.filename().string() << ": " << surface.positions.rows() << " vertices\n";
    std::vector<Run> runs;
    if (!options.cgal_only) runs.push_back(run_ours(file, surface, options));
    if (!options.ours_only) runs.push_back(run_cgal(file, surface, options));
    if (runs.size() == 2 && runs[0].failure.empty() && runs[1].failure.empty()) {
      const CommonGround common =
          common_ground(SurfaceTree(surface), bounding_box_diagonal(surface.positions),
                        runs[0].skeleton, runs[1].skeleton, {}, {});
      runs[0].common = common.a;
      runs[1].common = common.b;
    }
    const double ratio = runs.size() == 2 ? runs[1].seconds / runs[0].seconds : 0;
    for (const Run& run : runs) {
      print(run);
      csv << csv_row(run) << std::endl;
      markdown << markdown_row(run, &run == &runs.front() ? ratio : 0, options) << std::endl;
    }
    if (ratio > 0) {
      std::cout << "  CGAL takes " << std::setprecision(1) << ratio << " times as long and "
                << runs[1].processor_seconds / runs[0].processor_seconds
                << " times the processor's time\n";
    }
    std::cout << std::flush;
  }
}

}  // namespace
}  // namespace curveskel::bench

int main(int argc, char** argv) {
  curveskel::use_large_pages();
  using curveskel::bench::Options;
  Options options;
  CLI::App app("Compares curveskel with CGAL's mean curvature flow skeletonization");
  app.add_option("files", options.files, "surfaces; none = all closed ones of --meshes");
  app.add_option("--meshes", options.meshes, "folder with INDEX.csv")->capture_default_str();
  app.add_option("--csv", options.csv, "write a table, one row for each run");
  app.add_option("--markdown", options.markdown, "write a table for reading");
  app.add_option("--save-skeletons", options.skeletons, "folder for the skeletons as .cgal");
  app.add_option("--pictures", options.pictures,
                 "folder for a picture of each of curveskel's skeletons, linked from the table");
  app.add_option("--resolution", options.resolution, "working vertices of curveskel, 0 = full")
      ->capture_default_str();
  app.add_option("--threads", options.threads, "of curveskel, 0 = one per core")
      ->capture_default_str();
  auto* cgal_only = app.add_flag("--cgal-only", options.cgal_only, "leave curveskel out");
  app.add_flag("--ours-only", options.ours_only, "leave CGAL out")->excludes(cgal_only);
  CLI11_PARSE(app, argc, argv);
  try {
    curveskel::bench::compare(options);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
