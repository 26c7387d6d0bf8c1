// The negative result of the paper: the volume left of a surface after each iteration of the
// local flow (K = 1, 2, 3) and of the global one, as a table and as an SVG; then times per
// iteration.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <curveskel/advanced/device.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/contract.hpp>
#include <curveskel/fair.hpp>
#include <curveskel/read.hpp>

namespace curveskel::bench {
namespace {

namespace fs = std::filesystem;

struct Series {
  std::string name;
  std::string colour;
  std::vector<double> volume_ratios;  // after 0, 1, 2 ... iterations
};

Series local_series(const Surface& surface, int rings, int iterations, const std::string& colour) {
  FairOptions options;
  options.rings = rings;
  options.iterations = 1;
  options.volume = VolumeRule::keep;
  Series series{"local, K = " + std::to_string(rings), colour, {1}};
  Surface now = surface;
  for (int i = 0; i < iterations; ++i) {
    now = fair(now, options, {});
    series.volume_ratios.push_back(volume(now) / volume(surface));
  }
  return series;
}

Series global_series(const Surface& surface) {
  ContractionOptions options;
  options.flow = Flow::paper;
  Series series{"global", "#b5179e", {1}};
  for (const Step& step : contract(surface, {}, options, {}).steps) {
    series.volume_ratios.push_back(step.volume_ratio);
  }
  return series;
}

// The plot's area in the picture.
constexpr double left = 70;
constexpr double top = 20;
constexpr double width = 520;
constexpr double height = 300;

double x_of(std::size_t iteration, std::size_t iterations) {
  return left + width * static_cast<double>(iteration) / static_cast<double>(iterations);
}
double y_of(double ratio) { return top + height * (1 - ratio); }

std::string axes(std::size_t iterations) {
  std::string svg;
  for (int fifth = 0; fifth <= 5; ++fifth) {
    const double y = y_of(fifth / 5.0);
    svg += fmt::format("<path class=\"grid\" d=\"M{:.0f} {:.0f}h520\"/>", left, y) +
           fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"end\">", left - 8, y + 4) +
           fmt::format("{:.1f}</text>\n", fifth / 5.0);
  }
  for (std::size_t i = 0; i <= iterations; i += 5) {
    svg += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">",
                       x_of(i, iterations), top + height + 18) +
           std::to_string(i) + "</text>\n";
  }
  return svg +
         fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">iterations</text>\n",
                     left + width / 2, top + height + 38) +
         fmt::format("<text transform=\"translate(18 {:.0f}) rotate(-90)\" text-anchor=\"middle\">",
                     top + height / 2) +
         "volume / volume before</text>\n";
}

std::string curve(const Series& series, std::size_t iterations) {
  const std::size_t last = std::min(series.volume_ratios.size() - 1, iterations);
  std::string path;
  for (std::size_t i = 0; i <= last; ++i) {
    path += (i == 0 ? 'M' : 'L') +
            fmt::format("{:.1f} {:.1f}", x_of(i, iterations), y_of(series.volume_ratios[i]));
  }
  const double end = std::min(y_of(series.volume_ratios[last]), top + height - 10);
  return "<path stroke=\"" + series.colour + "\" d=\"" + path + "\"/>\n" +
         fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" ", x_of(last, iterations) + 6, end + 4) +
         "fill=\"" + series.colour + "\">" + series.name + "</text>\n";
}

std::string picture(const std::vector<Series>& all, std::size_t iterations) {
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 700 370\" width=\"700\" "
      "height=\"370\" font-family=\"sans-serif\" font-size=\"13\">\n"
      "<style>path{fill:none;stroke-width:2}.grid{stroke:#ddd;stroke-width:1}</style>\n"
      "<rect width=\"700\" height=\"370\" fill=\"white\"/>\n" +
      axes(iterations);
  for (const Series& series : all) svg += curve(series, iterations);
  return svg + "</svg>\n";
}

void print_ratios(const std::vector<Series>& all, std::size_t iterations) {
  for (const Series& series : all) std::cout << '\t' << series.name;
  std::cout << '\n';
  for (std::size_t i = 0; i <= iterations; ++i) {
    std::cout << i;
    for (const Series& series : all) {
      const auto& ratios = series.volume_ratios;
      std::cout << '\t' << (i < ratios.size() ? fmt::format("{:.3g}", ratios[i]) : "");
    }
    std::cout << '\n';
  }
}

/// Of all threads together, so that other work on the machine hardly shows.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double processor_seconds_of(const Surface& surface, const FairOptions& options) {
  const double start = processor_seconds();
  (void)fair(surface, options, {});
  return processor_seconds() - start;
}

// The difference between 1 and `iterations` + 1, so that work done once does not count; the
// least of five.
double milliseconds_per_iteration(const Surface& surface, FairOptions options, int iterations) {
  options.volume = VolumeRule::keep;
  double once = HUGE_VAL;
  double all = HUGE_VAL;
  for (int i = 0; i < 5; ++i) {
    options.iterations = 1;
    once = std::min(once, processor_seconds_of(surface, options));
    options.iterations = iterations + 1;
    all = std::min(all, processor_seconds_of(surface, options));
  }
  return 1e3 * (all - once) / iterations;
}

void print_times(const Surface& surface) {
  std::cout << "processor ms per iteration\tK = 1, closed\tK = 1, qr\tK = 2\tK = 3\n";
  for (const auto& method : fair_methods) {
    const DeviceNeeds needs = fair_needs(method.value, false);
    const bool on_device = method.name.starts_with("opencl");
    const auto found = devices();
    if (method.value == FairMethod::automatic || needs.gl_sharing) continue;
    if (on_device && found.empty()) continue;
    for (const bool double_precision : {false, true}) {
      if (!on_device && !double_precision) continue;
      std::cout << method.name << (double_precision ? ", double" : ", single");
      for (const auto& [rings, solver] : {std::pair{1, LocalSolver::closed},
                                          {1, LocalSolver::qr},
                                          {2, LocalSolver::qr},
                                          {3, LocalSolver::qr}}) {
        FairOptions options;
        options.method = method.value;
        options.double_precision = double_precision;
        options.rings = rings;
        options.local_solver = solver;
        const double time = milliseconds_per_iteration(surface, options, rings == 1 ? 100 : 5);
        std::cout << fmt::format("\t{:.2f}", time) << std::flush;
      }
      std::cout << '\n';
    }
  }
}

int run(int argc, char** argv) {
  CLI::App app("Volume left by the local and the global flow, and times of the local one");
  fs::path mesh;
  fs::path output;
  int iterations = 30;
  bool times = false;
  app.add_option("MESH", mesh, "closed surface")->required();
  app.add_option("-o,--output", output, "SVG");
  app.add_option("--iterations", iterations, "of the local flow")->capture_default_str();
  app.add_flag("--times", times, "also milliseconds per iteration of every method");
  CLI11_PARSE(app, argc, argv);

  const Surface surface = clean(read_polygons(mesh, {}), {}).surface;
  std::cout << mesh.filename().string() << ", " << surface.positions.rows() << " vertices\n";
  const std::vector<Series> all{local_series(surface, 1, iterations, "#4361ee"),
                                local_series(surface, 2, iterations, "#2a9d8f"),
                                local_series(surface, 3, iterations, "#e07a1f"),
                                global_series(surface)};
  print_ratios(all, static_cast<std::size_t>(iterations));
  if (!output.empty()) std::ofstream(output) << picture(all, static_cast<std::size_t>(iterations));
  if (times) print_times(surface);
  return 0;
}

}  // namespace
}  // namespace curveskel::bench

int main(int argc, char** argv) {
  try {
    return curveskel::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "local_versus_global: " << error.what() << '\n';
    return 1;
  }
}
