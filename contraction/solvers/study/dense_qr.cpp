// Method 1 of the paper (global flow on the CPU): dense Householder QR of the stacked system.
#include <Eigen/QR>
#include <limits>
#include <string>

#include <curveskel/error.hpp>
#include "contraction/solvers/least_squares_backend.hpp"

namespace curveskel {
namespace {

class DenseQr final : public LeastSquaresBackend {
 public:
  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& /*monitor*/) override {
    require_memory("dense-qr", a, 1);  // the factors overwrite the matrix
    Eigen::MatrixXd dense = a;
    const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(dense);
    const auto diagonal = qr.matrixQR().diagonal().cwiseAbs();
    const double rounding = static_cast<double>(a.rows()) * std::numeric_limits<double>::epsilon();
    if (!(diagonal.minCoeff() > rounding * diagonal.maxCoeff())) {
      throw Error(Fault::solver, "dense-qr: the matrix of " + std::to_string(a.rows()) + " x " +
                                     std::to_string(a.cols()) +
                                     " has no full column rank; use smaller weights");
    }
    Solution solution;
    solution.x = qr.solve(Eigen::MatrixXd(b));
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
