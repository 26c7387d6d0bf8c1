// The paper's methods 2 and 3, and conjugate gradients, on the OpenCL device through ViennaCL.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <string>

#include "contraction/iteration.hpp"
#include "contraction/opencl.hpp"
#include "contraction/viennacl/dense_and_krylov.hpp"
#include "surface/element_index.hpp"
#include "surface/error.hpp"

namespace curveskel {
namespace {

using ColumnMajor = Eigen::Map<const Eigen::MatrixXd>;

/// ViennaCL keeps one context per process, so there is one session for it, too.
void use_device(const std::string& solver) {
  static const opencl::Session session(choose_device(
      devices(), {.double_precision = true}, "the solver " + solver, "use the solver cholesky"));
  vcl::use(session.context(), session.id(), session.queue());
}

/// ViennaCL's own exceptions become errors of the device.
template <typename Work>
auto on_device(const std::string& solver, const Work& work) {
  try {
    use_device(solver);
    return work();
  } catch (const Error&) {
    throw;
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(Fault::solver, solver + ": out of memory; use the solver cholesky");
  } catch (const std::exception& error) {
    throw Error(Fault::device,
                solver + ": ViennaCL failed: " + error.what() + "; use the solver cholesky");
  }
}

vcl::Matrix dense(const SparseMatrix& a, std::size_t more_columns) {
  vcl::Matrix result{at(a.rows()), at(a.cols()) + more_columns, {}};
  result.entries.assign(result.rows * result.columns, 0);
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(a, j); entry; ++entry) {
      result(at(entry.row()), at(j)) = entry.value();
    }
  }
  return result;
}

/// X = R^-1 Y, both n rows.
Positions solve_upper(const std::string& solver, const Eigen::Ref<const Eigen::MatrixXd>& r,
                      const Eigen::MatrixXd& y, Eigen::Index rows) {
  const Eigen::VectorXd diagonal = r.diagonal().cwiseAbs();
  const double rounding = static_cast<double>(rows) * std::numeric_limits<double>::epsilon();
  if (!(diagonal.minCoeff() > rounding * diagonal.maxCoeff())) {
    throw Error(Fault::solver, solver + ": the matrix of " + std::to_string(rows) + " x " +
                                   std::to_string(r.cols()) +
                                   " has no full column rank; use smaller weights");
  }
  return r.triangularView<Eigen::Upper>().solve(y);
}

/// Method 3: R and Y = Q^T B come from one reduction of [A B]; Q is never formed.
class VclLsm final : public LeastSquaresBackend {
 public:
  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& monitor) override {
    // ViennaCL holds a square matrix of #rows on the host beside the two copies of [A B].
    require_memory("vcl-lsm", a, 4);
    vcl::Matrix stacked = dense(a, 3);
    for (Eigen::Index i = 0; i < b.rows(); ++i) {
      for (Eigen::Index k = 0; k < 3; ++k) stacked(at(i), at(a.cols() + k)) = b(i, k);
    }
    monitor.report("contract", 0);
    const vcl::Matrix reduced = on_device("vcl-lsm", [&] { return vcl::reduced(stacked); });
    const ColumnMajor all(reduced.entries.data(), a.rows(), a.cols() + 3);
    Solution solution;
    solution.x = solve_upper("vcl-lsm", all.topLeftCorner(a.cols(), a.cols()),
                             all.topRightCorner(a.cols(), 3), a.rows());
    return solution;
  }

  Solution solve_definite(const SparseMatrix& h, const Positions& r,
                          const Monitor& monitor) override {
    return solve(h, r, monitor);
  }
};

/// Method 2: Q and R are brought to the host, where R X = Q^T B is solved.
class VclQr final : public LeastSquaresBackend {
 public:
  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& /*monitor*/) override {
    require_memory("vcl-qr", a, 8);  // Q alone is #rows x #rows, twice
    const vcl::Factors factors = on_device("vcl-qr", [&] { return vcl::factorised(dense(a, 0)); });
    const ColumnMajor q(factors.q.entries.data(), a.rows(), a.rows());
    const ColumnMajor r(factors.r.entries.data(), a.rows(), a.cols());
    const Eigen::MatrixXd y = q.leftCols(a.cols()).transpose() * b;
    Solution solution;
    solution.x = solve_upper("vcl-qr", r.topRows(a.cols()), y, a.rows());
    return solution;
  }

  Solution solve_definite(const SparseMatrix& h, const Positions& r,
                          const Monitor& monitor) override {
    return solve(h, r, monitor);
  }
};

vcl::SparseRows rows_of(const SparseMatrix& h) {
  vcl::SparseRows rows{at(h.cols()), {}, {}, {}};
  rows.start.assign(h.outerIndexPtr(), h.outerIndexPtr() + h.cols() + 1);
  rows.column.assign(h.innerIndexPtr(), h.innerIndexPtr() + h.nonZeros());
  rows.value.assign(h.valuePtr(), h.valuePtr() + h.nonZeros());
  return rows;
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

class ConjugateGradients final : public LeastSquaresBackend {
 public:
  explicit ConjugateGradients(const SolverOptions& options) : options_(options) {}

  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& monitor) override {
    return iterate(normal_equations(a, b), root_of_normal_matrix(a), monitor);
  }

  Solution solve_definite(const SparseMatrix& h, const Positions& r,
                          const Monitor& monitor) override {
    return iterate({h, r}, {}, monitor);
  }

 private:
  Solution iterate(const NormalEquations& system, const SparseMatrix& root,
                   const Monitor& monitor) {
    require_positive_diagonal("cg", system.h);
    const double size = system.r.norm();
    Solution solution;
    solution.x = Positions::Zero(system.r.rows(), 3);
    if (!(size > 0)) return solution;
    const vcl::SparseRows rows = rows_of(system.h);
    const vcl::SparseRows root_rows = root.cols() > 0 ? rows_of(root) : vcl::SparseRows{};
    const auto stop = [&] { return monitor.stop.stop_requested(); };
    // As small a residual as rounding H X allows.
    const auto rounding = [&] { return 1e-14 * system.h.norm() * solution.x.norm() / size; };
    // What the recurrence believes and what the host finds part ways: some rounds of refinement.
    constexpr int most_rounds = 5;
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < most_rounds; ++round) {
      const Positions rest = system.r - system.h * solution.x;
      const double residual = rest.norm() / size;
      if (residual <= options_.tolerance) return solution;
      if (!(residual < 0.5 * before)) break;
      before = residual;
      for (Eigen::Index k = 0; k < 3; ++k) {
        std::vector<double> right(rest.col(k).begin(), rest.col(k).end());
        const auto result = on_device("cg", [&] {
          return vcl::conjugate_gradients(rows, root_rows, right, options_.tolerance,
                                          std::min(options_.most_iterations, 50000), stop);
        });
        if (stop()) throw Cancelled();
        solution.x.col(k) += Eigen::Map<const Eigen::VectorXd>(
            result.x.data(), static_cast<Eigen::Index>(result.x.size()));
        solution.iterations += result.iterations;
      }
    }
    const Positions rest = system.r - system.h * solution.x;
    const double residual = rest.norm() / size;
    if (residual <= std::max(options_.tolerance, rounding())) return solution;
    throw Error(Fault::solver, "cg: residual " + rounded_number(residual) + " after " +
                                   std::to_string(solution.iterations) +
                                   " iterations and no better any more, " +
                                   rounded_number(options_.tolerance) +
                                   " wanted; use the solver cholesky or sparse-qr");
  }

  SolverOptions options_;
};

}  // namespace

std::unique_ptr<LeastSquaresBackend> make_vcl_qr() { return std::make_unique<VclQr>(); }
std::unique_ptr<LeastSquaresBackend> make_vcl_lsm() { return std::make_unique<VclLsm>(); }
std::unique_ptr<LeastSquaresBackend> make_cg(const SolverOptions& options) {
  return std::make_unique<ConjugateGradients>(options);
}

}  // namespace curveskel
