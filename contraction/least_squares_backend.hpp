// What every solver of `LeastSquares` implements; one file per solver.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "contraction/laplacian.hpp"
#include "contraction/least_squares.hpp"
#include "surface/surface.hpp"

namespace curveskel {

class LeastSquaresBackend {
 public:
  virtual ~LeastSquaresBackend() = default;
  /// `residual` is left to the caller, who computes it the same way for all.
  virtual Solution solve(const SparseMatrix& a, const Positions& b) = 0;
  virtual Solution solve_definite(const SparseMatrix& h, const Positions& r) = 0;
};

[[nodiscard]] std::unique_ptr<LeastSquaresBackend> make_cholesky();
[[nodiscard]] std::unique_ptr<LeastSquaresBackend> make_sparse_qr();
[[nodiscard]] std::unique_ptr<LeastSquaresBackend> make_dense_qr();

}  // namespace curveskel
