// The paper's methods 2 and 3: dense QR on the OpenCL device through ViennaCL.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <string>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "contraction/device/opencl.hpp"
#include "contraction/solvers/least_squares_backend.hpp"
#include "contraction/solvers/viennacl/dense_qr.hpp"

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
  vcl::Matrix result{idx(a.rows()), idx(a.cols()) + more_columns, {}};
  result.entries.assign(result.rows * result.columns, 0);
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(a, j); entry; ++entry) {
      result(idx(entry.row()), idx(j)) = entry.value();
    }
  }
  return result;
}

/// X = R^-1 Y, both n rows.
Positions solve_upper(const std::string& solver, const Eigen::Ref<const Eigen::MatrixXd>& r,
                      const Eigen::MatrixXd& y, Eigen::Index rows) {
  const auto diagonal = r.diagonal().cwiseAbs();
  const double rounding = static_cast<double>(rows) * std::numeric_limits<double>::epsilon();
  if (!(diagonal.minCoeff() > rounding * diagonal.maxCoeff())) {
    throw Error(Fault::solver, solver + ": the matrix of " + std::to_string(rows) + " x " +
                                   std::to_string(r.cols()) +
                                   " has no full column rank; use the solver cholesky");
  }
  return r.triangularView<Eigen::Upper>().solve(y);
}

/// Called between panels: ends the work once that was asked for.
std::function<void()> heeding(const Monitor& monitor) {
  return [&monitor] { throw_if_stopped(monitor.stop); };
}

/// Method 3: R and Y = Q^T B come from one reduction of [A B]; Q is never formed.
class VclLsm final : public LeastSquaresBackend {
 public:
  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& monitor) override {
    require_memory("vcl-lsm", a, 3);  // as built, padded, and on the device
    vcl::Matrix stacked = dense(a, 3);
    for (Eigen::Index i = 0; i < b.rows(); ++i) {
      for (Eigen::Index k = 0; k < 3; ++k) stacked(idx(i), idx(a.cols() + k)) = b(i, k);
    }
    const vcl::Matrix reduced = on_device(
        "vcl-lsm", [&] { return vcl::reduced(stacked, idx(a.cols()), heeding(monitor)); });
    const ColumnMajor all(reduced.entries.data(), a.cols(), a.cols() + 3);
    Solution solution;
    solution.x = solve_upper("vcl-lsm", all.leftCols(a.cols()), all.rightCols(3), a.rows());
    return solution;
  }

  Solution solve_definite(const SparseMatrix& h, const Positions& r,
                          const Monitor& monitor) override {
    return solve(h, r, monitor);
  }
};

/// Method 2: Q and R are formed on the device and brought to the host, where R X = Q^T B is solved.
class VclQr final : public LeastSquaresBackend {
 public:
  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& monitor) override {
    require_memory("vcl-qr", a, 6);  // as built, v and w (which shorten) 1.5, R half, Q thrice
    const vcl::Factors factors =
        on_device("vcl-qr", [&] { return vcl::factorised(dense(a, 0), heeding(monitor)); });
    const ColumnMajor q(factors.q.entries.data(), a.rows(), a.cols());
    const ColumnMajor r(factors.r.entries.data(), a.cols(), a.cols());
    Solution solution;
    solution.x = solve_upper("vcl-qr", r, q.transpose() * b, a.rows());
    return solution;
  }

  Solution solve_definite(const SparseMatrix& h, const Positions& r,
                          const Monitor& monitor) override {
    return solve(h, r, monitor);
  }
};

}  // namespace

std::unique_ptr<LeastSquaresBackend> make_vcl_qr() { return std::make_unique<VclQr>(); }
std::unique_ptr<LeastSquaresBackend> make_vcl_lsm() { return std::make_unique<VclLsm>(); }

}  // namespace curveskel
