// The sum of a parallel BLAS depends on its number of threads.
#pragma once

namespace curveskel {

/// While one lives, OpenBLAS runs on one thread, so that every run of SuiteSparseQR, the one solver
/// with a BLAS behind it, rounds in the same way. The number belongs to the whole process, in
/// which others may use the same BLAS: it is set for a factorisation or a solve only, and when the
/// last guard of several threads goes it is what the first one found. Does nothing with another
/// BLAS.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  int found_ = 0;  // 0 = there is nothing to set back
};

}  // namespace curveskel
