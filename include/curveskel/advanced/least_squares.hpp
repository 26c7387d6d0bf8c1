// Back ends of one problem: min ||A X - B||^2 for a sparse tall A and three right-hand sides.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <filesystem>
#include <memory>

#include <curveskel/advanced/laplacian.hpp>
#include <curveskel/advanced/names.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

enum class Solver {
  automatic,
  cholesky,
  sparse_qr,
  dense_qr,
  vcl_qr,
  vcl_lsm,
  cg,
  gauss_seidel,
  jor,
  jacobi
};

inline constexpr NameTable<Solver, 10> solvers{{
    {Solver::automatic, "auto", "cholesky, the fastest and most robust at every size"},
    {Solver::cholesky, "cholesky", "sparse Cholesky of the normal equations"},
    {Solver::sparse_qr, "sparse-qr", "sparse QR (SuiteSparseQR)"},
    {Solver::dense_qr, "dense-qr", "dense Householder QR (Eigen), the paper's method 1"},
    {Solver::vcl_qr, "vcl-qr",
     "dense QR on the OpenCL device (ViennaCL), Q and R brought to the host: method 2"},
    {Solver::vcl_lsm, "vcl-lsm", "dense QR on the OpenCL device without forming Q: method 3"},
    {Solver::cg, "cg", "preconditioned conjugate gradients on the OpenCL device"},
    {Solver::gauss_seidel, "gauss-seidel",
     "Gauss-Seidel by graph colouring on the OpenCL device; slow in the flow paper"},
    {Solver::jor, "jor", "extrapolated Jacobi; millions of iterations in the flow paper"},
    {Solver::jacobi, "jacobi",
     "Jacobi: diverges in the flow paper wherever anything contracts, and says so"},
}};

/// The meaning of `auto`: always cholesky, which was the fastest at every size from 648 to 200,000
/// unknowns and beside every device that was measured (docs/benchmarks.md). Pure.
[[nodiscard]] Solver choose_solver(Solver wanted);

/// True if the solver runs on an OpenCL device, which must then offer double precision.
[[nodiscard]] bool needs_device(Solver solver);

struct SolverOptions {
  Solver solver = Solver::automatic;
  double tolerance = 1e-10;             ///< iterative ones: stop at this Solution::residual
  int most_iterations = 1000000;        ///< iterative ones: give up where more would be needed
  std::filesystem::path program_cache;  ///< folder for compiled kernels; empty = compile each time
  int threads = 0;  ///< of cholesky, jor and jacobi: 0 = one per core; no result depends on it
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const SolverOptions& options);

struct Solution {
  Positions x;          ///< n x 3
  int iterations = 0;   ///< 0 for a direct solver
  double residual = 0;  ///< ||A^T (A X - B)|| / ||A^T B||, computed on the host, Frobenius norms
};

/// Keeps the symbolic factorisation between solves whose A has the same pattern. One that was moved
/// from answers each call by Error(Fault::usage) until another is assigned to it.
class LeastSquares {
 public:
  /// Both throw what `require_valid` does.
  explicit LeastSquares(Solver solver);
  explicit LeastSquares(const SolverOptions& options);
  ~LeastSquares();
  LeastSquares(LeastSquares&&) noexcept;
  LeastSquares& operator=(LeastSquares&&) noexcept;

  /// min ||A X - B||, A m x n with m >= n and full column rank, B m x 3.
  /// Throws Error(Fault::solver) when the factorisation fails, when an iteration diverges or would
  /// need more than the options allow, and when a dense system does not fit in memory;
  /// Error(Fault::device) when no OpenCL device can do it; Cancelled when the monitor stops it.
  [[nodiscard]] Solution solve(const SparseMatrix& a, const Positions& b,
                               const Monitor& monitor = {});

  /// The square case H X = R with H symmetric positive definite, n x n (both triangles stored);
  /// residual = ||H X - R|| / ||R||. For normal equations that are known in closed form.
  [[nodiscard]] Solution solve_definite(const SparseMatrix& h, const Positions& r,
                                        const Monitor& monitor = {});

  [[nodiscard]] Solver solver() const;

 private:
  struct Implementation;
  [[nodiscard]] Implementation& whole() const;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace curveskel
