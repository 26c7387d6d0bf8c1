// Jacobi's iteration on the normal equations, plain and extrapolated (JOR): what the paper argues
// about. Y. Saad, Iterative Methods for Sparse Linear Systems, 2003, chapter 4.
#include <cmath>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"
#include "contraction/solvers/study/iteration.hpp"
#include "contraction/solvers/study/spectrum.hpp"

namespace curveskel {
namespace {

constexpr int lanczos_steps = 60;
constexpr Eigen::Index rows_for_threads = 20000;  // fewer rows take less time than a thread's start
constexpr std::size_t rows_per_part = 4096;

/// One iteration x -> next with x + relaxation D^-1 (r - H x). Returns ||r - H x|| of the x given.
double relax_rows(const NormalEquations& system, double relaxation, int threads, const Positions& x,
                  Positions& next) {
  const SparseMatrix& h = system.h;
  const std::size_t rows = idx(h.cols());
  std::vector<double> squares((rows + rows_per_part - 1) / rows_per_part, 0);
  parallel_for(rows, rows_per_part, h.cols() < rows_for_threads ? 1 : threads,
               [&](std::size_t begin, std::size_t end) {
                 double square = 0;
                 for (std::size_t i = begin; i < end; ++i) {
                   const auto row = static_cast<Eigen::Index>(i);
                   Eigen::RowVector3d rest = system.r.row(row);
                   double diagonal = 0;
                   for (SparseMatrix::InnerIterator entry(h, row); entry; ++entry) {
                     rest -= entry.value() * x.row(entry.row());
                     if (entry.row() == row) diagonal = entry.value();
                   }
                   square += rest.squaredNorm();
                   next.row(row) = x.row(row) + relaxation / diagonal * rest;
                 }
                 squares[begin / rows_per_part] = square;
               });
  double sum = 0;
  for (const double square : squares) sum += square;
  return std::sqrt(sum);
}

class Jacobi final : public LeastSquaresBackend {
 public:
  Jacobi(const SolverOptions& options, bool extrapolated)
      : options_(options), extrapolated_(extrapolated) {}

  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& monitor) override {
    return iterate(normal_equations(a, b), monitor);
  }

  Solution solve_definite(const SparseMatrix& h, const Positions& r,
                          const Monitor& monitor) override {
    return iterate({h, r}, monitor);
  }

 private:
  [[nodiscard]] const char* name() const { return extrapolated_ ? "jor" : "jacobi"; }

  /// The relaxation to use; throws where the estimate says that there is no hope.
  [[nodiscard]] double relaxation_for(const SparseMatrix& h, const Monitor& monitor) const {
    const Spectrum spectrum = jacobi_spectrum(h, lanczos_steps, monitor);
    if (!extrapolated_) {
      const double radius = spectrum.jacobi_radius();
      if (radius < 1) return 1;
      fail_iteration(name(), "diverges: the spectral radius of its iteration is " +
                                 rounded_number(radius) + " (estimated), and must be below 1");
    }
    // The estimates lie within the spectrum, so fewer iterations than this cannot do.
    const double least = iterations_for(options_.tolerance, spectrum.jor_radius());
    if (least > options_.most_iterations) {
      fail_iteration(name(), "converges, but the spectral radius of its iteration is 1 - " +
                                 rounded_number(1 - spectrum.jor_radius()) +
                                 " (estimated): at least " + rounded_count(least) +
                                 " iterations are needed");
    }
    constexpr double margin = 1.02;  // the largest eigenvalue is underestimated
    return 2 / (spectrum.least + margin * spectrum.largest);
  }

  Solution iterate(const NormalEquations& system, const Monitor& monitor) {
    require_positive_diagonal(name(), system.h);
    const double size = system.r.norm();
    Solution solution;
    solution.x = Positions::Zero(system.r.rows(), 3);
    if (!(size > 0)) return solution;
    const double relaxation = relaxation_for(system.h, monitor);
    Positions next(system.r.rows(), 3);
    Convergence convergence(name(), options_);
    for (int iterations = 0;; ++iterations) {
      throw_if_stopped(monitor.stop);
      const double residual =
          relax_rows(system, relaxation, options_.threads, solution.x, next) / size;
      solution.iterations = iterations;
      if (convergence.reached(iterations, residual)) return solution;
      solution.x.swap(next);
    }
  }

  SolverOptions options_;
  bool extrapolated_;
};

}  // namespace

std::unique_ptr<LeastSquaresBackend> make_jacobi(const SolverOptions& options, bool extrapolated) {
  return std::make_unique<Jacobi>(options, extrapolated);
}

}  // namespace curveskel
