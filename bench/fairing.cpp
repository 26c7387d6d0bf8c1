// Times one iteration of the local flow by every method on the same surfaces. Each figure is the
// best of several repeats, as other programs may be using the machine.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <curveskel/advanced/device.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/read.hpp>
#include "contraction/fairing/local_flow.hpp"
#include "meshes/shapes.hpp"

namespace curveskel::bench {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<fs::path> files;
  int subdivisions = 0;
  int repeats = 10;
  int iterations = 30;
  double smoothing = 1;
};

struct NamedSurface {
  std::string name;
  Surface surface;
};

/// Compulsory traffic of an iteration of the wide kernel, caches taken as ideal: per neighbour its
/// place (4 bytes), per vertex a position read and one written (16 bytes each).
double bytes_per_iteration(double vertices, double neighbours) {
  return 32 * vertices + 4 * neighbours;
}

/// Of the wide kernel, an addition, product, quotient or root counted as one: 138 for each row but
/// the last and 88 for the last and the patch as a whole, that is 778 for a ring of 6.
double flops_per_iteration(double vertices, double neighbours) {
  return 138 * neighbours - 50 * vertices;
}

template <typename Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of all threads together; other programs' load shows less in it.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Work>
double best_seconds(int repeats, const Work& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) best = std::min(best, seconds(work));
  return best;
}

/// Near the origin with a diagonal of 1, as `fair` hands it on.
Surface normalised(Surface surface) {
  const Eigen::RowVector3d middle =
      (surface.positions.colwise().minCoeff() + surface.positions.colwise().maxCoeff()) / 2;
  const double diagonal = bounding_box_diagonal(surface.positions);
  surface.positions = (surface.positions.rowwise() - middle) / diagonal;
  return surface;
}

/// Level sets, whose valences are 4 to 8, with vertices in random order.
std::vector<NamedSurface> generated() {
  std::vector<NamedSurface> surfaces;
  const auto add = [&](double spacing, int subdivisions) {
    shapes::Shape shape = shapes::algebraic_double_torus(spacing);
    for (int i = 0; i < subdivisions; ++i) shape = shapes::subdivided(shape);
    surfaces.push_back({"double torus", shapes::renumbered(shape, 1).surface});
  };
  add(0.0398, 0);  // about 15k vertices
  add(0.0466, 2);  // 173k
  add(0.0466, 3);  // 692k
  return surfaces;
}

NamedSurface from_file(const fs::path& file, int subdivisions) {
  shapes::Shape shape;
  shape.surface = clean(read_polygons(file, {}), {}).surface;
  for (int i = 0; i < subdivisions; ++i) shape = shapes::subdivided(shape);
  return {file.stem().string(), shape.surface};
}

struct Timing {
  std::string method;
  double set_up = 0;         // all before the first iteration, kernels from the cache
  double one_iteration = 0;  // steady state
  double processor = 0;      // of an iteration, all threads together
  double run = 0;            // `iterations` of them, until the last is done
  double read_back = 0;
};

template <typename Make>
Timing timed(const std::string& method, int repeats, int iterations, const Make& make) {
  Timing timing{.method = method};
  std::unique_ptr<LocalFlow> flow;
  timing.set_up = seconds([&] { flow = make(); });
  if (repeats > 1) flow->advance(1, {});
  timing.run = timing.processor = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) {
    const double before = processor_seconds();
    timing.run = std::min(timing.run, seconds([&] { flow->advance(iterations, {}); }));
    timing.processor = std::min(timing.processor, (processor_seconds() - before) / iterations);
  }
  timing.one_iteration = timing.run / iterations;
  timing.read_back = seconds([&] { (void)flow->positions(); });
  return timing;
}

void print(const Timing& timing, const Timing& reference, double vertices, double neighbours) {
  const double s = timing.one_iteration;
  std::cout << "  " << std::left << std::setw(15) << timing.method << std::right << std::fixed
            << std::setprecision(3) << std::setw(10) << 1e3 * s << " ms/iteration (processor "
            << 1e3 * timing.processor << ")" << std::setprecision(1) << std::setw(8)
            << reference.one_iteration / s << " x cpu" << std::setw(7)
            << 1e-9 * bytes_per_iteration(vertices, neighbours) / s << " GB/s" << std::setw(7)
            << 1e-9 * flops_per_iteration(vertices, neighbours) / s << " GFlop/s"
            << "   set-up" << std::setw(8) << 1e3 * timing.set_up << " ms   read back"
            << std::setw(6) << 1e3 * timing.read_back << " ms\n";
}

void measure(const NamedSurface& named, const Options& options) {
  const Surface surface = normalised(named.surface);
  OneRings rings;
  const double ring_seconds =
      best_seconds(3, [&] { rings = one_rings(surface.triangles, surface.positions.rows()); });
  const auto vertices = static_cast<double>(surface.positions.rows());
  const auto neighbours = static_cast<double>(rings.neighbours.size());
  std::cout << named.name << ": " << surface.positions.rows() << " vertices, one-rings in "
            << std::fixed << std::setprecision(1) << 1e3 * ring_seconds << " ms\n";

  FairOptions fairing;
  fairing.smoothing = options.smoothing;
  const Timing reference = timed("cpu", vertices < 1e5 ? 5 : 1, 1,
                                 [&] { return make_cpu_flow(surface, rings, fairing); });
  print(reference, reference, vertices, neighbours);
  print(timed("host", options.repeats, 3, [&] { return make_host_flow(surface, rings, fairing); }),
        reference, vertices, neighbours);
  const auto opencl = [&] { return make_opencl_flow(surface, rings, fairing); };
  const Timing single = timed("opencl, single", options.repeats, options.iterations, opencl);
  print(single, reference, vertices, neighbours);
  std::cout << "    " << options.iterations << " iterations in " << std::setprecision(2)
            << 1e3 * single.run << " ms\n";
  fairing.double_precision = true;
  print(timed("opencl, double", options.repeats, 3, opencl), reference, vertices, neighbours);
  std::cout << std::flush;
}

/// The whole of one iteration on a small surface, whose kernels are compiled the first time.
void measure_compilation() {
  const Surface ball = normalised(shapes::ellipsoid({1, 1, 1}, 2).surface);
  const OneRings rings = one_rings(ball.triangles, ball.positions.rows());
  for (const bool double_precision : {false, true}) {
    FairOptions fairing;
    fairing.double_precision = double_precision;
    const auto once = [&] { make_opencl_flow(ball, rings, fairing)->advance(1, {}); };
    const double first = seconds(once);
    std::cout << "kernels in " << (double_precision ? "double" : "single")
              << " precision: first run " << std::setprecision(3) << std::fixed << first
              << " s, cached " << best_seconds(3, once) << " s\n";
  }
}

int run(const Options& options) {
  // PoCL's cache of kernels: empty, so that the first run compiles.
  const fs::path cache = fs::temp_directory_path() / "curveskel-fairing-bench";
  fs::remove_all(cache);
  fs::create_directories(cache);
  setenv("POCL_CACHE_DIR", cache.c_str(), 1);
  for (const Device& device : devices()) {
    std::cout << "OpenCL device " << device.name << ", " << device.compute_units
              << " compute units\n";
  }
  measure_compilation();
  if (options.files.empty()) {
    for (const NamedSurface& surface : generated()) measure(surface, options);
  }
  for (const fs::path& file : options.files) {
    measure(from_file(file, options.subdivisions), options);
  }
  fs::remove_all(cache);
  return 0;
}

}  // namespace
}  // namespace curveskel::bench

int main(int argc, char** argv) {
  curveskel::bench::Options options;
  CLI::App program{"Times the local flow by each method"};
  program.add_option("FILES", options.files, "surface files; none = generated surfaces");
  program.add_option("--subdivide", options.subdivisions,
                     "each triangle of a file into four, times");
  program.add_option("--repeats", options.repeats, "of which the best counts");
  program.add_option("--iterations", options.iterations, "of the OpenCL methods in one repeat");
  program.add_option("--smoothing", options.smoothing, "mu");
  CLI11_PARSE(program, argc, argv);
  try {
    return curveskel::bench::run(options);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
