// T. Davis: Algorithm 915, SuiteSparseQR, ACM TOMS 2011.
#include <SuiteSparseQR_C.h>
#include <dlfcn.h>
#include <SuiteSparseQR.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <curveskel/error.hpp>
#include "contraction/solvers/blas_threads.hpp"
#include "contraction/solvers/least_squares_backend.hpp"

namespace curveskel {
namespace {

using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor>;

/// Functions of the library, which is loaded when it is asked for: with the BLAS behind it, it
/// takes longer to load than a small surface takes in all, and nearly no one asks.
struct SuiteSparse {
  /// Global, as the BLAS that comes with it is asked for by name.
  void* library = dlopen(CURVESKEL_SPQR, RTLD_NOW | RTLD_GLOBAL);

  template <typename Function>
  [[nodiscard]] Function* find(const char* name) const {
    return library == nullptr ? nullptr : reinterpret_cast<Function*>(dlsym(library, name));
  }

  decltype(cholmod_l_start)* start = find<decltype(cholmod_l_start)>("cholmod_l_start");
  decltype(cholmod_l_finish)* finish = find<decltype(cholmod_l_finish)>("cholmod_l_finish");
  decltype(cholmod_l_free_dense)* free_dense =
      find<decltype(cholmod_l_free_dense)>("cholmod_l_free_dense");
  decltype(SuiteSparseQR_C_symbolic)* symbolic =
      find<decltype(SuiteSparseQR_C_symbolic)>("SuiteSparseQR_C_symbolic");
  decltype(SuiteSparseQR_C_numeric)* numeric =
      find<decltype(SuiteSparseQR_C_numeric)>("SuiteSparseQR_C_numeric");
  decltype(SuiteSparseQR_C_qmult)* qmult =
      find<decltype(SuiteSparseQR_C_qmult)>("SuiteSparseQR_C_qmult");
  decltype(SuiteSparseQR_C_solve)* solve =
      find<decltype(SuiteSparseQR_C_solve)>("SuiteSparseQR_C_solve");
  decltype(SuiteSparseQR_C_free)* free =
      find<decltype(SuiteSparseQR_C_free)>("SuiteSparseQR_C_free");

  [[nodiscard]] bool is_whole() const {
    return start != nullptr && finish != nullptr && free_dense != nullptr && symbolic != nullptr &&
           numeric != nullptr && qmult != nullptr && solve != nullptr && free != nullptr;
  }
};

const SuiteSparse& suite_sparse() {
  static const SuiteSparse found;
  if (!found.is_whole()) {
    throw Error(Fault::solver, std::string("sparse QR: found no whole library ") + CURVESKEL_SPQR +
                                   ", needed SuiteSparseQR; install it, or use the solver "
                                   "cholesky");
  }
  return found;
}

class SparseQr final : public LeastSquaresBackend {
 public:
  SparseQr() {
    library_.start(&common_);
    common_.print = 0;
    common_.SPQR_nthreads = 1;
  }
  ~SparseQr() override {
    library_.free(&factor_, &common_);
    library_.finish(&common_);
  }
  SparseQr(const SparseQr&) = delete;
  SparseQr& operator=(const SparseQr&) = delete;

  Solution solve(const SparseMatrix& a, const Positions& b, const Monitor& monitor) override {
    throw_if_stopped(monitor.stop);  // and between the library's steps, which hear of nothing
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
      library_.free(&factor_, &common_);
      factor_ = library_.symbolic(SPQR_ORDERING_DEFAULT, 1, &view, &common_);
      throw_if_stopped(monitor.stop);
    }
    if (factor_ == nullptr || library_.numeric(SPQR_DEFAULT_TOL, &view, factor_, &common_) == 0) {
      fail(a, "could not be factorised");
    }
    if (factors().rank < a.cols()) {
      fail(a, "has numerical rank " + std::to_string(factors().rank));
    }
    throw_if_stopped(monitor.stop);
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
    return factor_ != nullptr && factors().narows == a.rows() &&
           std::equal(outer_.begin(), outer_.end(), a.outerIndexPtr(),
                      a.outerIndexPtr() + a.outerSize() + 1) &&
           std::equal(inner_.begin(), inner_.end(), a.innerIndexPtr(),
                      a.innerIndexPtr() + a.nonZeros());
  }

  [[nodiscard]] const SuiteSparseQR_factorization<double>& factors() const {
    return *static_cast<const SuiteSparseQR_factorization<double>*>(factor_->factors);
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
    cholmod_dense* y = library_.qmult(SPQR_QTX, factor_, &view, &common_);
    cholmod_dense* x =
        y != nullptr ? library_.solve(SPQR_RETX_EQUALS_B, factor_, y, &common_) : nullptr;
    Positions result;
    if (x != nullptr) {
      result = Eigen::Map<const Columns>(static_cast<const double*>(x->x),
                                         static_cast<Eigen::Index>(x->nrow), 3);
    }
    library_.free_dense(&y, &common_);
    library_.free_dense(&x, &common_);
    if (result.size() == 0) {
      throw Error(Fault::solver, "sparse QR: back substitution failed for " +
                                     std::to_string(b.rows()) +
                                     " rows: out of memory; use a coarser surface");
    }
    return result;
  }

  [[noreturn]] void fail(const SparseMatrix& a, const std::string& what) {
    std::string message = "sparse QR: the matrix of " + std::to_string(a.rows()) + " x " +
                          std::to_string(a.cols()) + " " + what;
    message += common_.status == CHOLMOD_OUT_OF_MEMORY
                   ? ": out of memory; use a coarser surface or the solver cholesky"
                   : "; full column rank is needed: use the solver cholesky";
    library_.free(&factor_, &common_);
    throw Error(Fault::solver, message);
  }

  const SuiteSparse& library_ = suite_sparse();
  cholmod_common common_{};
  SuiteSparseQR_C_factorization* factor_ = nullptr;
  std::vector<SuiteSparse_long> outer_;  // pattern of the analysed matrix, in long
  std::vector<SuiteSparse_long> inner_;
};

}  // namespace

std::unique_ptr<LeastSquaresBackend> make_sparse_qr() { return std::make_unique<SparseQr>(); }

}  // namespace curveskel
