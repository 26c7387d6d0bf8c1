#include <string>

#include "base/memory.hpp"
#include "contraction/solvers/cholesky_factor.hpp"
#include "contraction/solvers/least_squares_backend.hpp"

namespace curveskel {
namespace {

/// A row of A joins all its unknowns to one another: in eq. 3 the neighbours of a hub, squared.
/// The system is not asked about sizes that it always has.
void require_room_for_normal_matrix(const SparseMatrix& a) {
  constexpr double always_there = 256e6;
  constexpr double bytes_per_entry = 3 * (sizeof(double) + sizeof(int));  // sorted by transposing
  Eigen::VectorXd row_sizes = Eigen::VectorXd::Zero(a.rows());
  for (Eigen::Index k = 0; k < a.nonZeros(); ++k) row_sizes[a.innerIndexPtr()[k]] += 1;
  const double needed = bytes_per_entry * row_sizes.squaredNorm();
  if (needed <= always_there) return;
  require_memory(needed, available_memory_bytes(),
                 "the normal equations of " + std::to_string(a.cols()) + " unknowns, of which " +
                     std::to_string(static_cast<long>(row_sizes.maxCoeff())) + " meet in one row",
                 Fault::solver,
                 "use the flow medial, or a surface that is coarser or has no vertices of so "
                 "many neighbours");
}

class Cholesky final : public LeastSquaresBackend {
 public:
  explicit Cholesky(int threads) : factor_(threads) {}

  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& monitor) override {
    require_room_for_normal_matrix(a);
    const SparseMatrix transposed = a.transpose();
    const SparseMatrix normal = transposed * a;
    throw_if_stopped(monitor.stop);
    factor_.factorize(normal, monitor.stop);
    Solution solution;
    solution.x = back_substitute(transposed * b);
    // The normal equations square the condition number; one step with the true residual wins
    // back most of the digits.
    const Positions remainder = b - a * solution.x;
    solution.x += back_substitute(transposed * remainder);
    return solution;
  }

  Solution solve_definite(const SparseMatrix& h, const Positions& r,
                          const Monitor& monitor) override {
    factor_.factorize(h, monitor.stop);
    Solution solution;
    solution.x = back_substitute(r);
    return solution;
  }

 private:
  Positions back_substitute(const Positions& r) { return factor_.solve(r, workspace_); }

  CholeskyFactor factor_;
  CholeskyFactor::Workspace workspace_;
};

}  // namespace

std::unique_ptr<LeastSquaresBackend> make_cholesky(const SolverOptions& options) {
  return std::make_unique<Cholesky>(options.threads);
}

}  // namespace curveskel
