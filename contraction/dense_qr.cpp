// Method 1 of the paper (global flow on the CPU): dense Householder QR of the stacked system.
#include <unistd.h>

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "contraction/least_squares_backend.hpp"
#include "surface/error.hpp"

namespace curveskel {
namespace {

std::string gigabytes(double bytes) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f GB", bytes / 1e9);
  return text.data();
}

/// The factors overwrite the matrix, which is all that there is to hold.
void require_memory(const SparseMatrix& a) {
  constexpr double bytes_per_entry = sizeof(double);
  const double columns = static_cast<double>(a.cols());
  const double needed = bytes_per_entry * static_cast<double>(a.rows()) * columns;
  const double present =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (needed <= present) return;
  const double rows_per_column = static_cast<double>(a.rows()) / columns;
  const double fits = std::sqrt(present / (bytes_per_entry * rows_per_column));
  throw Error(Fault::solver, "dense-qr: a system of " + std::to_string(a.cols()) +
                                 " unknowns needs " + gigabytes(needed) + " and " +
                                 gigabytes(present) + " are there; use at most " +
                                 std::to_string(static_cast<long>(fits)) +
                                 " vertices (--resolution) or the solver cholesky");
}

class DenseQr final : public LeastSquaresBackend {
 public:
  Solution solve(const SparseMatrix& a, const Positions& b) override {
    require_memory(a);
    Eigen::MatrixXd dense = a;
    const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(dense);
    const Eigen::VectorXd diagonal = qr.matrixQR().diagonal().cwiseAbs();
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

  Solution solve_definite(const SparseMatrix& h, const Positions& r) override {
    return solve(h, r);
  }
};

}  // namespace

std::unique_ptr<LeastSquaresBackend> make_dense_qr() { return std::make_unique<DenseQr>(); }

}  // namespace curveskel
