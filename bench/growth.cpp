// Time and memory of one shape from a thousand to ten million vertices, beside the floor: reading
// the file, and looking at each triangle once.
// usage: growth MESH -o FILE.svg     (prints a table)
//        growth --one FILE           (one row of figures, for the above)
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/coarsen.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include "app/heap.hpp"
#include "bench/log_plot.hpp"
#include "meshes/shapes.hpp"

namespace {

using namespace curveskel;
namespace fs = std::filesystem;

struct Row {
  double vertices = 0;
  double floor = 0;      // seconds: reading, the area
  double seconds = 0;    // by the clock
  double processor = 0;  // of all threads together
  double megabytes = 0;  // at most
  double right = 0;      // topology
};

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Row measured(const fs::path& file) {
  Row row;
  auto start = std::chrono::steady_clock::now();
  {
    const PolygonSoup soup = read_polygons(file, {});
    Surface surface;
    surface.positions = soup.positions;
    surface.triangles = Eigen::Map<const Triangles>(
        soup.corners.data(), static_cast<Eigen::Index>(soup.corners.size() / 3), 3);
    row.vertices = static_cast<double>(surface.positions.rows());
    if (!(area(surface) > 0)) throw std::runtime_error(file.string() + " has no area");
  }
  row.floor = seconds_since(start);
  const double before = processor_seconds();
  start = std::chrono::steady_clock::now();
  const Extraction found = extract(repair(read_polygons(file, {}), {}, {}).surface, {}, {});
  row.seconds = seconds_since(start);
  row.processor = processor_seconds() - before;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  row.megabytes = static_cast<double>(usage.ru_maxrss) / 1e3;
  row.right = found.certificate.topology_correct() ? 1 : 0;
  return row;
}

/// Each size in processes of its own, so that the memory is that of the size; the least of the
/// runs, as other programs only ever add to a time.
Row measured_apart(const std::string& program, const fs::path& file) {
  constexpr double enough_seconds = 3;
  constexpr int most_runs = 9;
  Row least;
  double spent = 0;
  for (int run = 0; run < most_runs && spent < enough_seconds; ++run) {
    FILE* const pipe = popen((program + " --one '" + file.string() + "'").c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("no process for " + file.string());
    Row row;
    const int read = std::fscanf(pipe, "%lf %lf %lf %lf %lf %lf", &row.vertices, &row.floor,
                                 &row.seconds, &row.processor, &row.megabytes, &row.right);
    if (pclose(pipe) != 0 || read != 6) throw std::runtime_error(file.string() + " failed");
    spent += row.seconds;
    if (run == 0) {
      least = row;
      continue;
    }
    least.floor = std::min(least.floor, row.floor);
    least.seconds = std::min(least.seconds, row.seconds);
    least.processor = std::min(least.processor, row.processor);
    least.megabytes = std::max(least.megabytes, row.megabytes);
  }
  return least;
}

void write_ply(const Surface& surface, const fs::path& file) {
  std::ofstream out(file, std::ios::binary);
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << surface.positions.rows()
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
      << surface.triangles.rows() << "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto write = [&](const auto& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
    for (int axis = 0; axis < 3; ++axis) write(static_cast<float>(surface.positions(v, axis)));
  }
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    write(static_cast<unsigned char>(3));
    for (int k = 0; k < 3; ++k) write(surface.triangles(t, k));
  }
  if (!out.flush()) throw std::runtime_error(file.string() + " cannot be written");
}

/// The surface with about so many vertices. Added vertices lie off their faces by some hundredths
/// of an edge, as in a scan: coarsening has nothing for nothing.
Surface of_size(const Surface& given, int vertices) {
  shapes::Shape shape;
  shape.surface = given;
  while (shape.surface.positions.rows() < vertices) {
    shape = shapes::subdivided(std::move(shape));
    const double edge =
        std::sqrt(area(shape.surface) / static_cast<double>(shape.surface.triangles.rows()));
    shape = shapes::noisy(std::move(shape), 0.03 * edge, 1);
  }
  CoarsenOptions options;
  options.target_vertices = vertices;
  return coarsen(shape.surface, options).surface;
}

std::string plot(const std::vector<Row>& rows) {
  bench::Series seconds{"by the clock", {}, {}, {}};
  bench::Series processor{"of the processor", {}, {}, {}};
  bench::Series floor{"floor", {}, {}, {}};
  floor.other = true;
  for (const Row& row : rows) {
    for (bench::Series* series : {&seconds, &processor, &floor}) {
      series->x.push_back(row.vertices);
      series->predicted.push_back(false);
    }
    seconds.y.push_back(row.seconds);
    processor.y.push_back(row.processor);
    floor.y.push_back(row.floor);
  }
  return bench::log_log_plot("From file to certified skeleton, two cores", "vertices", "seconds",
                             {seconds, processor, floor});
}

void measure_all(const std::string& program, const fs::path& mesh, const fs::path& picture) {
  const Surface surface = repair(read_polygons(mesh, {}), {}, {}).surface;
  const fs::path file = fs::temp_directory_path() / "curveskel-growth.ply";
  std::vector<Row> rows;
  std::printf(
      "| vertices | s | of the processor | floor, s | times the floor | microseconds a vertex | MB "
      "| topology |\n|---|---|---|---|---|---|---|---|\n");
  for (const int vertices :
       {1000, 3000, 10000, 30000, 100000, 300000, 1000000, 3000000, 10000000}) {
    write_ply(of_size(surface, vertices), file);
    const Row row = measured_apart(program, file);
    std::printf("| %.0f | %.3f | %.3f | %.4f | %.0f | %.1f | %.0f | %s |\n", row.vertices,
                row.seconds, row.processor, row.floor, row.seconds / row.floor,
                1e6 * row.seconds / row.vertices, row.megabytes, row.right > 0 ? "right" : "WRONG");
    std::fflush(stdout);
    rows.push_back(row);
  }
  fs::remove(file);
  if (!picture.empty()) std::ofstream(picture) << plot(rows);
}

}  // namespace

int main(int count, char** values) {
  fs::path mesh;
  fs::path one;
  fs::path picture;
  CLI::App program("Seconds of one shape from a thousand to ten million vertices");
  program.add_option("MESH", mesh, "closed surface")->check(CLI::ExistingFile);
  program.add_option("-o,--output", picture, "SVG");
  program.add_option("--one", one, "measure this file alone")->check(CLI::ExistingFile);
  CLI11_PARSE(program, count, values);
  use_large_pages();
  if (!one.empty()) {
    const Row row = measured(one);
    std::printf("%.0f %.9g %.9g %.9g %.9g %.0f\n", row.vertices, row.floor, row.seconds,
                row.processor, row.megabytes, row.right);
    return EXIT_SUCCESS;
  }
  measure_all(values[0], mesh, picture);
  return EXIT_SUCCESS;
}
