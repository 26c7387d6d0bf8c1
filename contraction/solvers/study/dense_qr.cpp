// Method 1 of the paper (global flow on the CPU): dense Householder QR of the stacked system.
#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <string>

#include <curveskel/error.hpp>
#include "contraction/solvers/least_squares_backend.hpp"

namespace curveskel {
namespace {

/// Reduces [A B] to [R Q^T B] in place, a panel of A's columns at a time, and applies each panel to
/// a stripe of columns at a time, so that a stop is heard in between.
void reduce(Eigen::MatrixXd& stacked, Eigen::Index columns, const std::stop_token& stop) {
  constexpr Eigen::Index panel_columns = 64;
  constexpr Eigen::Index stripe_columns = 128;
  for (Eigen::Index k = 0; k < columns; k += panel_columns) {
    const Eigen::Index count = std::min(panel_columns, columns - k);
    const Eigen::Index rows = stacked.rows() - k;
    Eigen::Ref<Eigen::MatrixXd> panel = stacked.block(k, k, rows, count);
    const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(panel);
    for (Eigen::Index j = k + count; j < stacked.cols(); j += stripe_columns) {
      throw_if_stopped(stop);
      Eigen::Ref<Eigen::MatrixXd> stripe =
          stacked.block(k, j, rows, std::min(stripe_columns, stacked.cols() - j));
      stripe.applyOnTheLeft(qr.householderQ().adjoint());
    }
  }
}

class DenseQr final : public LeastSquaresBackend {
 public:
  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& monitor) override {
    require_memory("dense-qr", a, 1);  // the factors overwrite the matrix
    throw_if_stopped(monitor.stop);
    const Eigen::Index n = a.cols();
    Eigen::MatrixXd stacked(a.rows(), n + 3);
    stacked.leftCols(n) = a;
    stacked.rightCols(3) = b;
    reduce(stacked, n, monitor.stop);
    const auto r = stacked.topLeftCorner(n, n);
    const auto diagonal = r.diagonal().cwiseAbs();
    const double rounding = static_cast<double>(a.rows()) * std::numeric_limits<double>::epsilon();
    if (!(diagonal.minCoeff() > rounding * diagonal.maxCoeff())) {
      throw Error(Fault::solver, "dense-qr: the matrix of " + std::to_string(a.rows()) + " x " +
                                     std::to_string(a.cols()) +
                                     " has no full column rank; use the solver cholesky");
    }
    Solution solution;
    solution.x = r.triangularView<Eigen::Upper>().solve(stacked.topRightCorner(n, 3));
    return solution;
  }

  Solution solve_definite(const SparseMatrix& h, const Positions& r,
                          const Monitor& monitor) override {
    return solve(h, r, monitor);
  }
};

}  // namespace

std::unique_ptr<LeastSquaresBackend> make_dense_qr() { return std::make_unique<DenseQr>(); }

}  // namespace curveskel
