// The paper's table and figure: global and local methods on closed surfaces of 648, 1416, 5664 and
// 14952 vertices; preprocessing, iteration and overall times (3 global or 30 local iterations),
// beside the paper's own.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <curveskel/advanced/least_squares.hpp>
#include <curveskel/error.hpp>
#include <curveskel/fair.hpp>
#include "bench/paper_flow.hpp"
#include "bench/table1_pages.hpp"

namespace curveskel::bench {
namespace {

namespace fs = std::filesystem;

constexpr int global_iterations = 3;
constexpr int local_iterations = 30;
constexpr double paper_weight = 1e3;  // W_L of the first iteration / sqrt(mean face area)

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Method {
  std::string name;
  std::string paper;  // its name there, empty for those beyond it
  double order;       // of the iteration's cost in the number of vertices, for predictions
  std::function<Cell(const Surface&)> run;
};

Cell run_global(Solver solver, const Surface& surface) {
  {  // Drivers, kernels and threads are started by a small system.
    const PaperFlow small(wavy_ring(12, 8), 1);
    const auto system = small.system();
    (void)LeastSquares(solver).solve(system.a, system.b);
  }
  Cell cell;
  const double start = seconds_now();
  PaperFlow flow(surface, paper_weight);
  SolverOptions options;
  options.solver = solver;
  options.most_iterations = 20000;  // of the iterative ones: minutes, not hours
  LeastSquares least_squares(options);
  const double prepared = seconds_now();
  for (int k = 0; k < global_iterations; ++k) {
    const auto system = flow.system();
    const Solution solution = least_squares.solve(system.a, system.b);
    flow.accept(solution.x);
    cell.residual = std::max(cell.residual, solution.residual);
  }
  const double end = seconds_now();
  cell.preprocessing = prepared - start;
  cell.iteration = (end - prepared) / global_iterations;
  cell.overall = end - start;
  return cell;
}

double time_fairing(const Surface& surface, FairOptions options, int iterations) {
  options.iterations = iterations;
  const double start = seconds_now();
  (void)fair(surface, options, {});
  return seconds_now() - start;
}

/// The cost of a run beside its iterations varies by more than 30 of them take on a device: so many
/// that they stand out.
double iteration_seconds(const Surface& surface, const FairOptions& options, double once) {
  constexpr double plenty = 0.3;
  for (int more = local_iterations;; more *= 4) {
    const double seconds = time_fairing(surface, options, 1 + more) - once;
    if (seconds > plenty) return seconds / more;
  }
}

Cell run_local(const FairOptions& options, const Surface& surface) {
  (void)time_fairing(surface, options, 1);
  double once = 1e300;
  double all = 1e300;
  for (int repeat = 0; repeat < 5 && all > (repeat == 0 ? 0 : 1); ++repeat) {
    once = std::min(once, time_fairing(surface, options, 1));
    all = std::min(all, time_fairing(surface, options, local_iterations));
  }
  Cell cell;
  cell.iteration = iteration_seconds(surface, options, once);
  cell.preprocessing = std::max(0.0, once - cell.iteration);
  cell.overall = all;
  return cell;
}

std::vector<Method> methods() {
  std::vector<Method> all;
  const auto global = [&](Solver solver, const std::string& paper, double order) {
    all.push_back({std::string(name_of(solvers, solver)), paper, order,
                   [solver](const Surface& s) { return run_global(solver, s); }});
  };
  global(Solver::dense_qr, "1 Global CPU", 3);
  global(Solver::vcl_qr, "2 VCL-QR", 3);
  global(Solver::vcl_lsm, "3 VCL-LSM", 3);
  global(Solver::cholesky, "", 1.5);
  global(Solver::sparse_qr, "", 1.5);
  global(Solver::cg, "", 2);
  global(Solver::gauss_seidel, "", 2);
  global(Solver::jor, "", 2);
  global(Solver::jacobi, "", 2);
  const auto local = [&](FairMethod method, const std::string& paper) {
    FairOptions options;
    options.method = method;
    options.volume = VolumeRule::keep;
    all.push_back({"fair " + std::string(name_of(fair_methods, method)), paper, 1,
                   [options](const Surface& s) { return run_local(options, s); }});
  };
  local(FairMethod::cpu, "4 Local CPU");
  local(FairMethod::opencl_transfer, "5 OCL transfer");
  local(FairMethod::opencl_interop, "6 OCL interop");
  local(FairMethod::opencl, "");
  local(FairMethod::host, "");
  return all;
}

/// The cells of one method; what would take longer than `most_seconds` is predicted.
std::vector<Cell> run_cells(const Method& method, double most_seconds) {
  std::vector<Cell> row;
  for (const int size : table_sizes) {
    if (!row.empty() && row.back().failure.empty()) {
      const double growth =
          std::pow(static_cast<double>(size) / table_sizes[row.size() - 1], method.order);
      if (row.back().overall * growth > most_seconds) {
        Cell guess = row.back();
        guess.preprocessing *= growth;
        guess.iteration *= growth;
        guess.overall *= growth;
        guess.predicted = true;
        row.push_back(guess);
        continue;
      }
    }
    Cell cell;
    try {
      cell = method.run(surface_of_table(size));
    } catch (const Error& error) {
      cell.failure = error.what();
    }
    std::cerr << fmt::format(
        "{:<14} {:>6}  {}\n", method.name, size,
        cell.failure.empty() ? fmt::format("{:.4g} s", cell.overall) : cell.failure);
    row.push_back(std::move(cell));
  }
  return row;
}

std::vector<Row> run_rows(const std::vector<std::string>& only, double most_seconds) {
  std::vector<Row> rows;
  for (const Method& method : methods()) {
    if (!only.empty() && std::ranges::count(only, method.name) == 0) continue;
    rows.push_back({method.name, method.paper, run_cells(method, most_seconds)});
  }
  return rows;
}

int run(int argc, char** argv) {
  CLI::App app("The paper's methods and those beyond them on surfaces of the paper's sizes");
  double most_seconds = 60;
  fs::path folder = "table1";
  fs::path from;
  fs::path paper_file = CURVESKEL_PAPER_TABLE;
  std::vector<std::string> only;
  app.add_option("--cell-seconds", most_seconds, "a cell that would take longer is predicted")
      ->capture_default_str();
  app.add_option("-o,--output", folder, "folder for table1.csv, table1.md and the plots")
      ->capture_default_str();
  app.add_option("--only", only, "these rows, by their names (\"cg\", \"fair opencl\")");
  app.add_option("--from", from, "cells of an earlier table1.csv: nothing is run");
  app.add_option("--paper", paper_file, "the paper's own figures")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const std::vector<Row> paper = read_paper_rows(paper_file);
  const std::vector<Row> rows = from.empty() ? run_rows(only, most_seconds) : read_rows(from);
  fs::create_directories(folder);
  std::ofstream(folder / "table1.csv") << csv(rows, paper);
  std::ofstream(folder / "table1.md") << markdown(rows, paper);
  std::ofstream(folder / "preprocessing.svg")
      << plot(rows, paper, "Preprocessing", &Cell::preprocessing);
  std::ofstream(folder / "iteration.svg") << plot(rows, paper, "One iteration", &Cell::iteration);
  std::ofstream(folder / "overall.svg")
      << plot(rows, paper, "Overall: 3 global or 30 local iterations", &Cell::overall);
  std::cout << markdown(rows, paper);
  return 0;
}

}  // namespace
}  // namespace curveskel::bench

int main(int argc, char** argv) {
  try {
    return curveskel::bench::run(argc, argv);
  } catch (const curveskel::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
