// Preconditioned conjugate gradients on the normal equations, on the OpenCL device: all three
// right-hand sides at once, vectors and matrices resident, two scalars a column read back in an
// iteration. Y. Saad, Iterative Methods for Sparse Linear Systems, 2003, algorithms 9.1 and 12.1.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "contraction/device/opencl.hpp"
#include "contraction/solvers/study/iteration.hpp"
#include "contraction/solvers/study/spectrum.hpp"
#include "kernels/sources.hpp"

namespace curveskel {
namespace {

/// A double4 of the device: one number a right-hand side, and 0.
using PerColumn = std::array<double, 4>;

double length_of(const PerColumn& squares) {
  return std::sqrt(squares[0] + squares[1] + squares[2]);
}

/// A column that has converged to the last digit rests.
PerColumn quotient(const PerColumn& part, const PerColumn& whole) {
  PerColumn result{};
  for (std::size_t k = 0; k < 3; ++k) result[k] = whole[k] > 0 ? part[k] / whole[k] : 0;
  return result;
}

/// For A = [T; D], T symmetric negative semi-definite and D diagonal, as in eq. 3: D - T, whose
/// square differs from A^T A by the mixed terms alone. Empty for any other A.
SparseMatrix root_of_normal_matrix(const SparseMatrix& a) {
  const Eigen::Index n = a.cols();
  if (a.rows() != 2 * n) return {};
  SparseMatrix top = a.topRows(n);
  const SparseMatrix bottom = a.bottomRows(n);
  const SparseMatrix mirrored = top.transpose();
  if ((top - mirrored).norm() > 1e-12 * top.norm()) return {};
  SparseMatrix result = -top;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (SparseMatrix::InnerIterator entry(bottom, j); entry; ++entry) {
      if (entry.row() != j) return {};
      result.coeffRef(j, j) += std::abs(entry.value());
    }
    if (!(result.coeff(j, j) > 0)) return {};
  }
  result.makeCompressed();
  return result;
}

/// The steps of Chebyshev's iteration with M, from 0: a fixed polynomial in D^-1 M, hence one and
/// the same symmetric map for every argument.
struct ChebyshevSteps {
  double first = 1;  // the diagonal's alone
  std::vector<std::pair<double, double>> keep_and_add;

  ChebyshevSteps() = default;
  /// Leaves at most `error` of parts with eigenvalues of D^-1 M from `least` to `largest`.
  ChebyshevSteps(double least, double largest, double error) {
    const double middle = (largest + least) / 2;
    const double half = (largest - least) / 2;
    first = 1 / middle;
    const int degree =
        static_cast<int>(std::ceil(std::acosh(1 / error) / std::acosh(middle / half)));
    double ratio = half / middle;
    for (int k = 1; k < degree; ++k) {
      const double next = 1 / (2 * middle / half - ratio);
      keep_and_add.emplace_back(next * ratio, 2 * next / half);
      ratio = next;
    }
  }
};

/// All eigenvalues of D^-1 M lie below (Gershgorin).
double largest_row_ratio(const SparseMatrix& m) {
  double largest = 0;
  for (Eigen::Index j = 0; j < m.cols(); ++j) {
    double sum = 0;
    double diagonal = 0;
    for (SparseMatrix::InnerIterator entry(m, j); entry; ++entry) {
      sum += std::abs(entry.value());
      if (entry.row() == j) diagonal = entry.value();
    }
    largest = std::max(largest, sum / diagonal);
  }
  return largest;
}

ChebyshevSteps steps_for(const SparseMatrix& root, const Monitor& monitor) {
  // Still slower parts are left to the conjugate gradients.
  constexpr double least_bound = 1e-4;
  constexpr double error = 0.03;
  constexpr int products = 40;
  const double least = std::max(least_bound, jacobi_spectrum(root, products, monitor).least);
  const double largest = std::max(largest_row_ratio(root), 1.01 * least);
  return {least, largest, error};
}

/// A sparse matrix on the device.
struct DeviceRows {
  opencl::Buffer start, column, value, reciprocal;  // of the diagonal

  DeviceRows() = default;
  DeviceRows(const opencl::Session& session, const SparseMatrix& h)
      : start(session.upload(std::span(h.outerIndexPtr(), idx(h.cols()) + 1))),
        column(session.upload(std::span(h.innerIndexPtr(), idx(h.nonZeros())))),
        value(session.upload(std::span(h.valuePtr(), idx(h.nonZeros())))),
        reciprocal(session.upload(Eigen::VectorXd(h.diagonal().cwiseInverse()))) {}
};

class ConjugateGradients final : public LeastSquaresBackend {
 public:
  explicit ConjugateGradients(const SolverOptions& options)
      : options_(options),
        session_(choose_device(devices(), {.double_precision = true}, "the solver cg",
                               "use the solver cholesky")),
        program_(session_.build(conjugate_gradients_source, "", options.program_cache)) {}

  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& monitor) override {
    return refine(normal_equations(a, b), root_of_normal_matrix(a), monitor);
  }

  Solution solve_definite(const SparseMatrix& h, const Positions& r,
                          const Monitor& monitor) override {
    return refine({h, r}, {}, monitor);
  }

 private:
  /// Rounds of the recurrence, as its residual and the one found on the host part ways.
  Solution refine(const NormalEquations& system, const SparseMatrix& root, const Monitor& monitor) {
    require_positive_diagonal("cg", system.h);
    const double size = system.r.norm();
    Solution solution;
    solution.x = Positions::Zero(system.r.rows(), 3);
    if (!(size > 0)) return solution;
    place(system, root, monitor);
    constexpr int most_rounds = 5;
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0;; ++round) {
      const Positions rest = system.r - system.h * solution.x;
      const double residual = rest.norm() / size;
      if (residual <= options_.tolerance) return solution;
      if (round == most_rounds || !(residual < 0.5 * before) ||
          solution.iterations >= options_.most_iterations) {
        // As small a residual as rounding H X allows will do.
        const double rounding = 1e-14 * system.h.norm() * solution.x.norm() / size;
        if (residual <= rounding) return solution;
        fail(residual, solution.iterations);
      }
      before = residual;
      solution.iterations += iterate(rest, 0.5 * options_.tolerance * size,
                                     options_.most_iterations - solution.iterations, monitor);
      solution.x += from_device(x_);
    }
  }

  [[noreturn]] void fail(double residual, int iterations) const {
    throw Error(Fault::solver, "cg: residual " + rounded_number(residual) + " after " +
                                   std::to_string(iterations) +
                                   " iterations and no better any more, " +
                                   rounded_number(options_.tolerance) +
                                   " wanted; use the solver cholesky or sparse-qr");
  }

  void place(const NormalEquations& system, const SparseMatrix& root, const Monitor& monitor) {
    rows_ = static_cast<int>(system.h.cols());
    squared_ = root.cols() > 0;
    h_ = DeviceRows(session_, system.h);
    m_ = squared_ ? DeviceRows(session_, root) : h_;
    steps_ = squared_ ? steps_for(root, monitor) : ChebyshevSteps();
    for (opencl::Buffer* vector : {&x_, &r_, &p_, &h_p_, &z_, &once_, &next_, &step_}) {
      *vector = session_.allocate(idx(rows_) * sizeof(PerColumn));
    }
    sums_ = session_.allocate(items_of_dots * sizeof(PerColumn));
  }

  /// x = H^-1 right, until the residual is down to `enough`; the iterations that took.
  int iterate(const Positions& right, double enough, int most_iterations, const Monitor& monitor) {
    for (const opencl::Buffer* vector : {&x_, &p_}) to_device(Positions::Zero(rows_, 3), *vector);
    to_device(right, r_);
    precondition();
    PerColumn r_z = dots(r_, z_);
    turn({});
    for (int iteration = 1;; ++iteration) {
      throw_if_stopped(monitor.stop);
      product_.set(h_.start, h_.column, h_.value, p_, h_p_, rows_);
      launch(product_);
      advance_.set(x_, r_, p_, h_p_, quotient(r_z, dots(p_, h_p_)), rows_);
      launch(advance_);
      if (!(length_of(dots(r_, r_)) > enough) || iteration == most_iterations) return iteration;
      precondition();
      const PerColumn before = std::exchange(r_z, dots(r_, z_));
      turn(quotient(r_z, before));
    }
  }

  void turn(const PerColumn& keep) {
    turn_.set(p_, z_, keep, rows_);
    launch(turn_);
  }

  /// z = P r, P = M^-2 nearly, or D^-1.
  void precondition() {
    smooth(r_);
    if (!squared_) return;
    std::swap(z_, once_);
    smooth(once_);
  }

  /// z = M^-1 right, nearly.
  void smooth(const opencl::Buffer& right) {
    first_step_.set(right, z_, step_, m_.reciprocal, steps_.first, rows_);
    launch(first_step_);
    for (const auto& [keep, add] : steps_.keep_and_add) {
      next_step_.set(m_.start, m_.column, m_.value, right, z_, next_, step_, m_.reciprocal, keep,
                     add, rows_);
      launch(next_step_);
      std::swap(z_, next_);
    }
  }

  PerColumn dots(const opencl::Buffer& a, const opencl::Buffer& b) {
    dots_.set(a, b, sums_, rows_);
    session_.launch(dots_, items_of_dots, group);
    std::array<PerColumn, items_of_dots> sums{};
    session_.read(sums_, sums.data(), sizeof sums);
    PerColumn total{};
    for (const PerColumn& sum : sums) {
      for (std::size_t k = 0; k < 3; ++k) total[k] += sum[k];
    }
    return total;
  }

  void launch(const opencl::Kernel& kernel) const {
    session_.launch(kernel, (idx(rows_) + group - 1) / group * group, group);
  }

  void to_device(const Positions& from, const opencl::Buffer& to) const {
    std::vector<PerColumn> packed(idx(rows_));
    for (int i = 0; i < rows_; ++i) packed[idx(i)] = {from(i, 0), from(i, 1), from(i, 2), 0};
    session_.write(to, packed.data(), packed.size() * sizeof(PerColumn));
  }

  Positions from_device(const opencl::Buffer& from) const {
    std::vector<PerColumn> packed(idx(rows_));
    session_.read(from, packed.data(), packed.size() * sizeof(PerColumn));
    Positions result(rows_, 3);
    for (int i = 0; i < rows_; ++i) {
      for (int k = 0; k < 3; ++k) result(i, k) = packed[idx(i)][idx(k)];
    }
    return result;
  }

  static constexpr std::size_t group = 64;
  static constexpr std::size_t items_of_dots = 256;

  SolverOptions options_;
  opencl::Session session_;
  opencl::Program program_;
  opencl::Kernel product_ = program_.kernel("product");
  opencl::Kernel dots_ = program_.kernel("dots");
  opencl::Kernel advance_ = program_.kernel("advance");
  opencl::Kernel turn_ = program_.kernel("turn");
  opencl::Kernel first_step_ = program_.kernel("first_step");
  opencl::Kernel next_step_ = program_.kernel("next_step");
  DeviceRows h_, m_;
  ChebyshevSteps steps_;
  bool squared_ = false;
  int rows_ = 0;
  opencl::Buffer x_, r_, p_, h_p_, z_, once_, next_, step_, sums_;
};

}  // namespace

std::unique_ptr<LeastSquaresBackend> make_cg(const SolverOptions& options) {
  return std::make_unique<ConjugateGradients>(options);
}

}  // namespace curveskel
