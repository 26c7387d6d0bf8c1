#include "contraction/solvers/cholesky_factor.hpp"
#include "contraction/solvers/least_squares_backend.hpp"

namespace curveskel {
namespace {

class Cholesky final : public LeastSquaresBackend {
 public:
  explicit Cholesky(int threads) : factor_(threads) {}

  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& /*monitor*/) override {
    const SparseMatrix transposed = a.transpose();
    const SparseMatrix normal = transposed * a;
    factor_.factorize(normal);
    Solution solution;
    solution.x = back_substitute(transposed * b);
    // The normal equations square the condition number; one step with the true residual wins
    // back most of the digits.
    const Positions remainder = b - a * solution.x;
    solution.x += back_substitute(transposed * remainder);
    return solution;
  }

  Solution solve_definite(const SparseMatrix& h, const Positions& r,
                          const Monitor& /*monitor*/) override {
    factor_.factorize(h);
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
