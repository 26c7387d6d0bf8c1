#include "contraction/solvers/study/iteration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include <curveskel/error.hpp>

namespace curveskel {

NormalEquations normal_equations(const SparseMatrix& a, const Positions& b) {
  const SparseMatrix transposed = a.transpose();
  return {transposed * a, transposed * b};
}

void require_positive_diagonal(std::string_view solver, const SparseMatrix& h) {
  for (Eigen::Index i = 0; i < h.cols(); ++i) {
    const double entry = h.coeff(i, i);
    if (entry > 0 && std::isfinite(entry)) continue;
    throw Error(Fault::solver, std::string(solver) + ": the matrix of " + std::to_string(h.cols()) +
                                   " unknowns has " + rounded_number(entry) +
                                   " on its diagonal at row " + std::to_string(i) +
                                   " and is not positive definite");
  }
}

void fail_iteration(std::string_view solver, const std::string& what) {
  throw Error(Fault::solver,
              std::string(solver) + ": " + what + "; use the solver cholesky, sparse-qr or cg");
}

std::string rounded_count(double count) {
  std::array<char, 32> text{};
  if (!std::isfinite(count)) return "too many";
  if (count < 1e6) {
    std::snprintf(text.data(), text.size(), "%.0f", count);
  } else {
    std::snprintf(text.data(), text.size(), "%.2g million", count / 1e6);
  }
  return text.data();
}

std::string rounded_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

bool Convergence::reached(int iterations, double residual) {
  constexpr int first_judgement = 200;
  if (residual <= options_.tolerance) return true;
  if (!std::isfinite(residual) || residual > 1e6) {
    fail_iteration(solver_, "diverges: residual " + rounded_number(residual) + " after " +
                                std::to_string(iterations) + " iterations");
  }
  if (iterations >= options_.most_iterations) {
    fail_iteration(solver_, "residual " + rounded_number(residual) + " after " +
                                std::to_string(iterations) + " iterations, " +
                                rounded_number(options_.tolerance) + " wanted");
  }
  const bool judge = iterations >= std::max(first_judgement, 2 * last_iterations_);
  if (!judge) return false;
  if (last_iterations_ > 0) {
    const double rate = std::log(residual / last_residual_) / (iterations - last_iterations_);
    const double more = rate < 0 ? std::log(options_.tolerance / residual) / rate
                                 : std::numeric_limits<double>::infinity();
    if (iterations + more > options_.most_iterations) {
      fail_iteration(solver_, "residual " + rounded_number(residual) + " after " +
                                  std::to_string(iterations) + " iterations, and at this rate " +
                                  rounded_count(more) + " more are needed");
    }
  }
  last_iterations_ = iterations;
  last_residual_ = residual;
  return false;
}

}  // namespace curveskel
