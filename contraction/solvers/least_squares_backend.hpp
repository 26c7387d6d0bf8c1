// The interface of every solver of `LeastSquares`; one file per solver.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string_view>

#include <curveskel/advanced/laplacian.hpp>
#include <curveskel/advanced/least_squares.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

class LeastSquaresBackend {
 public:
  virtual ~LeastSquaresBackend() = default;
  /// `residual` is left to the caller, who computes it the same way for all.
  virtual Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& monitor) = 0;
  virtual Solution solve_definite(const SparseMatrix& h, const Positions& r,
                                  const Monitor& monitor) = 0;
};

[[nodiscard]] std::unique_ptr<LeastSquaresBackend> make_cholesky(const SolverOptions& options);
[[nodiscard]] std::unique_ptr<LeastSquaresBackend> make_sparse_qr();
[[nodiscard]] std::unique_ptr<LeastSquaresBackend> make_dense_qr();
/// Jacobi's iteration, extrapolated (JOR) or plain.
[[nodiscard]] std::unique_ptr<LeastSquaresBackend> make_jacobi(const SolverOptions& options,
                                                               bool extrapolated);
[[nodiscard]] std::unique_ptr<LeastSquaresBackend> make_gauss_seidel(const SolverOptions& options);
[[nodiscard]] std::unique_ptr<LeastSquaresBackend> make_vcl_qr();
[[nodiscard]] std::unique_ptr<LeastSquaresBackend> make_vcl_lsm();
[[nodiscard]] std::unique_ptr<LeastSquaresBackend> make_cg(const SolverOptions& options);

/// Throws Error(Fault::solver), before anything is allocated, if a dense method that holds `copies`
/// times the matrix's entries does not fit into the memory that is available; says what would.
void require_memory(std::string_view solver, const SparseMatrix& a, double copies);

}  // namespace curveskel
