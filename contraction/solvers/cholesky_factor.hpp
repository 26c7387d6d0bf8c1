// The sparse Cholesky factor of a symmetric positive definite matrix, for any number of right-hand
// sides.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <stop_token>

#include <curveskel/advanced/laplacian.hpp>

namespace curveskel {

/// Multifrontal (J. Liu, The multifrontal method for sparse matrix solution, 1992): nested
/// dissection leaves dense blocks, and the halves of a surface are factorised beside one another.
class CholeskyFactor {
 public:
  /// At most `threads` factorise, 0 = one per core; the result does not depend on it.
  explicit CholeskyFactor(int threads = 1);
  ~CholeskyFactor();
  CholeskyFactor(const CholeskyFactor&) = delete;
  CholeskyFactor& operator=(const CholeskyFactor&) = delete;

  /// H n x n, both triangles stored. The symbolic analysis of the last matrix is used again where
  /// the pattern is the same. Throws Error(Fault::solver) where H is not positive definite or
  /// memory does not suffice, Cancelled once `stop` is requested; the factor may be used for
  /// another matrix afterwards.
  void factorize(const SparseMatrix& h, const std::stop_token& stop = {});

  /// Memory of a solve beside the factor, kept between solves; one for each thread that solves.
  class Workspace {
   public:
    Workspace();
    ~Workspace();
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;

   private:
    friend class CholeskyFactor;
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
  };

  /// X with H X = R, R n x k. Refers to the workspace's memory: valid until its next use. May run
  /// from several threads at once, each with its own workspace.
  [[nodiscard]] Eigen::Map<const Eigen::MatrixXd> solve(const Eigen::MatrixXd& r,
                                                        Workspace& workspace) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace curveskel
