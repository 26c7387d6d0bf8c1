#include <curveskel/advanced/least_squares.hpp>

#include <cmath>
#include <string>

#include <curveskel/error.hpp>
#include "base/option_ranges.hpp"
#include "contraction/solvers/least_squares_backend.hpp"

namespace curveskel {
namespace {

std::unique_ptr<LeastSquaresBackend> make_backend(Solver solver, const SolverOptions& options) {
  switch (solver) {
    case Solver::automatic:
    case Solver::cholesky:
      return make_cholesky(options);
    case Solver::sparse_qr:
      return make_sparse_qr();
    case Solver::dense_qr:
      return make_dense_qr();
    case Solver::vcl_qr:
      return make_vcl_qr();
    case Solver::vcl_lsm:
      return make_vcl_lsm();
    case Solver::cg:
      return make_cg(options);
    case Solver::gauss_seidel:
      return make_gauss_seidel(options);
    case Solver::jor:
      return make_jacobi(options, true);
    case Solver::jacobi:
      return make_jacobi(options, false);
  }
  return nullptr;
}

SolverOptions options_with(Solver solver) {
  SolverOptions options;
  options.solver = solver;
  return options;
}

double ratio(double part, double whole) { return whole > 0 ? part / whole : part; }

/// The back ends read the arrays of a matrix as they are.
const SparseMatrix& compressed(const SparseMatrix& a, SparseMatrix& copy) {
  if (a.isCompressed()) return a;
  copy = a;
  copy.makeCompressed();
  return copy;
}

void require(bool condition, const SparseMatrix& a, const Positions& b, const char* needed) {
  if (condition) return;
  throw Error(Fault::solver, "a system of " + std::to_string(a.rows()) + " x " +
                                 std::to_string(a.cols()) + " with " + std::to_string(b.rows()) +
                                 " right-hand rows cannot be solved; needed: " + needed);
}

void require_finite(const Solution& solution, Solver solver) {
  if (solution.x.allFinite()) return;
  throw Error(Fault::solver, std::string(name_of(solvers, solver)) +
                                 " gave a solution that is not finite; the system is singular or "
                                 "has entries that are not finite");
}

}  // namespace

bool needs_device(Solver solver) {
  switch (solver) {
    case Solver::vcl_qr:
    case Solver::vcl_lsm:
    case Solver::cg:
    case Solver::gauss_seidel:
      return true;
    case Solver::automatic:
    case Solver::cholesky:
    case Solver::sparse_qr:
    case Solver::dense_qr:
    case Solver::jor:
    case Solver::jacobi:
      return false;
  }
  return false;
}

Solver choose_solver(Solver wanted) {
  return wanted == Solver::automatic ? Solver::cholesky : wanted;
}

void require_valid(const SolverOptions& options) {
  constexpr OptionRange tolerance{0, 1, true};
  const OptionCheck check("SolverOptions");
  check.choice("solver", options.solver, solvers);
  check.number("tolerance", options.tolerance, tolerance);
  check.number("most_iterations", options.most_iterations, {});
  check.number("threads", options.threads, thread_range);
}

struct LeastSquares::Implementation {
  SolverOptions options;
  Solver used = Solver::automatic;
  std::unique_ptr<LeastSquaresBackend> backend;

  LeastSquaresBackend& chosen_backend() {
    if (!backend) {
      used = choose_solver(options.solver);
      backend = make_backend(used, options);
    }
    return *backend;
  }
};

LeastSquares::LeastSquares(Solver solver) : LeastSquares(options_with(solver)) {}
LeastSquares::LeastSquares(const SolverOptions& options)
    : implementation_(std::make_unique<Implementation>()) {
  require_valid(options);
  implementation_->options = options;
  implementation_->used = options.solver;
}
LeastSquares::~LeastSquares() = default;
LeastSquares::LeastSquares(LeastSquares&&) noexcept = default;
LeastSquares& LeastSquares::operator=(LeastSquares&&) noexcept = default;

LeastSquares::Implementation& LeastSquares::whole() const {
  if (implementation_) return *implementation_;
  throw Error(Fault::usage,
              "LeastSquares: found one that was moved from, needed one with a solver: ask the one "
              "that it was moved to");
}

Solver LeastSquares::solver() const { return whole().used; }

Solution LeastSquares::solve(const SparseMatrix& a, const Positions& b, const Monitor& monitor) {
  require(a.rows() >= a.cols() && a.cols() > 0 && b.rows() == a.rows(), a, b,
          "at least as many rows as columns, and as many right-hand rows");
  SparseMatrix copy;
  Solution solution = whole().chosen_backend().solve(compressed(a, copy), b, monitor);
  require_finite(solution, solver());
  const Positions difference = a * solution.x - b;
  const Positions gradient = a.transpose() * difference;
  const Positions scale = a.transpose() * b;
  solution.residual = ratio(gradient.norm(), scale.norm());
  return solution;
}

Solution LeastSquares::solve_definite(const SparseMatrix& h, const Positions& r,
                                      const Monitor& monitor) {
  require(h.rows() == h.cols() && h.cols() > 0 && r.rows() == h.rows(), h, r,
          "a square matrix, and as many right-hand rows");
  SparseMatrix copy;
  Solution solution = whole().chosen_backend().solve_definite(compressed(h, copy), r, monitor);
  require_finite(solution, solver());
  const Positions difference = h * solution.x - r;
  solution.residual = ratio(difference.norm(), r.norm());
  return solution;
}

}  // namespace curveskel
