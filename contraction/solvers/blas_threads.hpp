// The sum of a parallel BLAS depends on its number of threads.
#pragma once

namespace curveskel {

/// Sets OpenBLAS to one thread, for good, so that every run rounds homologous; the fronts of these
/// factorisations are too small for more. Does nothing with another BLAS.
void use_one_blas_thread();

}  // namespace curveskel
