// The paper's open question: for which weights and surfaces do Jacobi, JOR and Gauss-Seidel
// converge, and at what cost against cholesky and cg?
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <curveskel/advanced/coarsen.hpp>
#include <curveskel/advanced/least_squares.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include "bench/paper_flow.hpp"
#include "contraction/solvers/study/spectrum.hpp"

namespace curveskel::bench {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// "1234 it, 0.5 s" or why not.
std::string outcome(Solver solver, const PaperFlow::System& system, int most_iterations) {
  SolverOptions options;
  options.solver = solver;
  options.tolerance = 1e-8;
  options.most_iterations = most_iterations;
  const auto start = std::chrono::steady_clock::now();
  try {
    LeastSquares least_squares(options);
    const Solution solution = least_squares.solve(system.a, system.b);
    if (solution.iterations == 0) return fmt::format("{:.3f} s", seconds_since(start));
    return fmt::format("{} it, {:.2f} s", solution.iterations, seconds_since(start));
  } catch (const Error& error) {
    const std::string what = error.what();
    const auto diverges = what.find("diverges") != std::string::npos;
    const auto at = what.find("at least ");
    if (at != std::string::npos) return what.substr(at, what.find(" iterations", at) - at);
    const auto rate = what.find("at this rate ");
    if (rate != std::string::npos)
      return "> " + what.substr(rate + 13, what.find(" more", rate) - rate - 13);
    return diverges ? "diverges" : "fails";
  }
}

Surface read_coarse(const std::filesystem::path& file, int vertices) {
  Surface surface = clean(read_polygons(file, {}), {}).surface;
  const Eigen::RowVector3d low = surface.positions.colwise().minCoeff();
  surface.positions =
      (surface.positions.rowwise() - low) / bounding_box_diagonal(surface.positions);
  CoarsenOptions options;
  options.target_vertices = vertices;
  return coarsen(surface, options, {}).surface;
}

void study(const std::filesystem::path& file, int vertices, const std::vector<double>& weights,
           int most_iterations) {
  for (const double weight : weights) {
    PaperFlow flow(read_coarse(file, vertices), weight);
    for (int k = 1; k <= 3; ++k) {
      const auto system = flow.system();
      const SparseMatrix h = system.a.transpose() * system.a;
      const Spectrum spectrum = jacobi_spectrum(h, 200, {});
      const Solution exact = LeastSquares(Solver::cholesky).solve(system.a, system.b);
      const auto of = [&](Solver solver) { return outcome(solver, system, most_iterations); };
      const std::string figures =
          fmt::format("{:.3f} | {:.2e} | {} | {} | {} | {} | {}", spectrum.jacobi_radius(),
                      1 - spectrum.jor_radius(), of(Solver::jacobi), of(Solver::jor),
                      of(Solver::gauss_seidel), of(Solver::cg), of(Solver::cholesky));
      flow.accept(exact.x);
      std::cout << fmt::format("| {} | {} | {:g} | {} | {:.4f} | {} |\n", file.stem().string(),
                               flow.surface().positions.rows(), weight, k, flow.volume_ratio(),
                               figures)
                << std::flush;
    }
  }
}

int run(int argc, char** argv) {
  CLI::App app("Spectral radii and iteration counts of the classical iterations");
  std::vector<std::filesystem::path> files;
  int vertices = 1400;
  int most_iterations = 100000;
  std::vector<double> weights{1, 10, 1000};
  app.add_option("files", files, "surfaces")->required();
  app.add_option("--vertices", vertices, "coarsened to")->capture_default_str();
  app.add_option("--weights", weights, "W_L of the first iteration / sqrt(mean face area)");
  app.add_option("--most-iterations", most_iterations)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::cout << "| surface | vertices | W_L0 | iteration | volume after | Jacobi radius | 1 - JOR "
               "radius | jacobi | jor | gauss-seidel | cg | cholesky |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& file : files) study(file, vertices, weights, most_iterations);
  return 0;
}

}  // namespace
}  // namespace curveskel::bench

int main(int argc, char** argv) { return curveskel::bench::run(argc, argv); }
