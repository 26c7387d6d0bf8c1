// Back ends of one problem: min ||A X - B||^2 for a sparse tall A and three right-hand sides.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

#include "contraction/laplacian.hpp"
#include "surface/names.hpp"
#include "surface/surface.hpp"

namespace curveskel {

enum class Solver { automatic, cholesky, sparse_qr, dense_qr };

inline constexpr NameTable<Solver, 4> solvers{{
    {Solver::automatic, "auto", "chosen by the size of the system"},
    {Solver::cholesky, "cholesky", "sparse Cholesky of the normal equations (CHOLMOD)"},
    {Solver::sparse_qr, "sparse-qr", "sparse QR (SuiteSparseQR)"},
    {Solver::dense_qr, "dense-qr", "dense Householder QR (Eigen), the paper's method 1"},
}};

/// What `auto` stands for; a pure function of the size.
[[nodiscard]] Solver choose_solver(Solver wanted, int unknowns);

struct Solution {
  Positions x;          ///< n x 3
  int iterations = 0;   ///< 0 for a direct solver
  double residual = 0;  ///< ||A^T (A X - B)|| / ||A^T B||, computed on the host, Frobenius norms
};

/// Keeps the symbolic factorisation between solves whose A has the same pattern.
class LeastSquares {
 public:
  explicit LeastSquares(Solver solver);
  ~LeastSquares();
  LeastSquares(LeastSquares&&) noexcept;
  LeastSquares& operator=(LeastSquares&&) noexcept;

  /// min ||A X - B||, A m x n with m >= n and full column rank, B m x 3.
  /// Throws Error(Fault::solver) when the factorisation fails.
  [[nodiscard]] Solution solve(const SparseMatrix& a, const Positions& b);

  /// The square case H X = R with H symmetric positive definite, n x n (both triangles stored);
  /// residual = ||H X - R|| / ||R||. For normal equations that are known in closed form.
  [[nodiscard]] Solution solve_definite(const SparseMatrix& h, const Positions& r);

  [[nodiscard]] Solver solver() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace curveskel
