// T. Davis: Algorithm 915, SuiteSparseQR, ACM TOMS 2011.
#include <SuiteSparseQR.hpp>
#include <string>
#include <vector>

#include <curveskel/error.hpp>
#include "contraction/solvers/blas_threads.hpp"
#include "contraction/solvers/least_squares_backend.hpp"

namespace curveskel {
namespace {

using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor>;

class SparseQr final : public LeastSquaresBackend {
 public:
  SparseQr() {
    cholmod_l_start(&common_);
    common_.print = 0;
    common_.SPQR_nthreads = 1;
  }
  ~SparseQr() override {
    SuiteSparseQR_free(&factor_, &common_);
    cholmod_l_finish(&common_);
  }
  SparseQr(const SparseQr&) = delete;
  SparseQr& operator=(const SparseQr&) = delete;

  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& /*monitor*/) override {
    const OneBlasThread one_thread;
    const bool known = same_pattern(a);
    if (!known) {
      outer_.assign(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1);
      inner_.assign(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
    }
    cholmod_sparse view{};
    view.nrow = static_cast<std::size_t>(a.rows());
    view.ncol = static_cast<std::size_t>(a.cols());
    view.nzmax = inner_.size();
    view.p = outer_.data();
    view.i = inner_.data();
    view.x = const_cast<double*>(a.valuePtr());
    view.itype = CHOLMOD_LONG;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
    if (!known) {
      SuiteSparseQR_free(&factor_, &common_);
      factor_ =
          SuiteSparseQR_symbolic<double>(SPQR_ORDERING_DEFAULT, SPQR_DEFAULT_TOL, &view, &common_);
    }
    if (factor_ == nullptr ||
        SuiteSparseQR_numeric<double>(SPQR_DEFAULT_TOL, &view, factor_, &common_) == 0) {
      fail(a, "could not be factorised");
    }
    if (factor_->rank < a.cols()) {
      fail(a, "has numerical rank " + std::to_string(factor_->rank));
    }
    Solution solution;
    solution.x = least_squares(b);
    return solution;
  }

  Solution solve_definite(const SparseMatrix& h, const Positions& r,
                          const Monitor& monitor) override {
    return solve(h, r, monitor);
  }

 private:
  [[nodiscard]] bool same_pattern(const SparseMatrix& a) const {
    return factor_ != nullptr && factor_->narows == a.rows() &&
           std::equal(outer_.begin(), outer_.end(), a.outerIndexPtr(),
                      a.outerIndexPtr() + a.outerSize() + 1) &&
           std::equal(inner_.begin(), inner_.end(), a.innerIndexPtr(),
                      a.innerIndexPtr() + a.nonZeros());
  }

  /// X = E (R \ (Q^T B)), all three columns at once.
  Positions least_squares(const Positions& b) {
    Columns right = b;
    cholmod_dense view{};
    view.nrow = static_cast<std::size_t>(right.rows());
    view.ncol = 3;
    view.d = view.nrow;
    view.nzmax = 3 * view.nrow;
    view.x = right.data();
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* y = SuiteSparseQR_qmult<double>(SPQR_QTX, factor_, &view, &common_);
    cholmod_dense* x = y != nullptr
                           ? SuiteSparseQR_solve<double>(SPQR_RETX_EQUALS_B, factor_, y, &common_)
                           : nullptr;
    Positions result;
    if (x != nullptr) {
      result = Eigen::Map<const Columns>(static_cast<const double*>(x->x),
                                         static_cast<Eigen::Index>(x->nrow), 3);
    }
    cholmod_l_free_dense(&y, &common_);
    cholmod_l_free_dense(&x, &common_);
    if (result.size() == 0) {
      throw Error(Fault::solver, "sparse QR: back substitution failed for " +
                                     std::to_string(b.rows()) +
                                     " rows: out of memory; use a coarser resolution");
    }
    return result;
  }

  [[noreturn]] void fail(const SparseMatrix& a, const std::string& what) {
    std::string message = "sparse QR: the matrix of " + std::to_string(a.rows()) + " x " +
                          std::to_string(a.cols()) + " " + what;
    message += common_.status == CHOLMOD_OUT_OF_MEMORY
                   ? ": out of memory; use a coarser resolution or the solver cholesky"
                   : "; full column rank is needed: use smaller weights";
    SuiteSparseQR_free(&factor_, &common_);
    throw Error(Fault::solver, message);
  }

  cholmod_common common_{};
  SuiteSparseQR_factorization<double>* factor_ = nullptr;
  std::vector<SuiteSparse_long> outer_;  // pattern of the analysed matrix, in long
  std::vector<SuiteSparse_long> inner_;
};

}  // namespace

std::unique_ptr<LeastSquaresBackend> make_sparse_qr() { return std::make_unique<SparseQr>(); }

}  // namespace curveskel
