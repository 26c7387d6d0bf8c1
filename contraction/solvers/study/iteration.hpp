// Code that the iterative solvers share: Jacobi's, Gauss' and Seidel's, conjugate gradients.
#pragma once

#include <string>
#include <string_view>

#include "contraction/solvers/least_squares_backend.hpp"

namespace curveskel {

/// H X = R, with H = A^T A symmetric positive definite and R = A^T B.
struct NormalEquations {
  SparseMatrix h;
  Positions r;
};
[[nodiscard]] NormalEquations normal_equations(const SparseMatrix& a, const Positions& b);

/// Throws Error(Fault::solver) unless all diagonal entries are positive.
void require_positive_diagonal(std::string_view solver, const SparseMatrix& h);

/// Throws Error(Fault::solver): "jor: WHAT; use the solver cholesky, sparse-qr or cg".
[[noreturn]] void fail_iteration(std::string_view solver, const std::string& what);

/// "12345", "3.2 million", or "too many" for what is no finite number: how an estimate is told.
[[nodiscard]] std::string rounded_count(double count);
/// Four significant digits, with an exponent where needed.
[[nodiscard]] std::string rounded_number(double value);

/// Watches the residuals of an iteration and says when it is done or hopeless.
class Convergence {
 public:
  Convergence(std::string_view solver, const SolverOptions& options)
      : solver_(solver), options_(options) {}

  /// True if the residual (relative) reached after `iterations` is small enough. Throws
  /// Error(Fault::solver) when it grows without bound, when it no longer shrinks, or when at its
  /// present rate more iterations would be needed than allowed.
  [[nodiscard]] bool reached(int iterations, double residual);

 private:
  std::string_view solver_;
  const SolverOptions& options_;
  int last_iterations_ = 0;
  double last_residual_ = 0;  // at the last judgement of the rate
};

}  // namespace curveskel
