#include "contraction/solvers/blas_threads.hpp"

#include <dlfcn.h>

namespace curveskel {

void use_one_blas_thread() {
  // Looked up at run time: which BLAS is behind libblas.so.3 is the machine's choice.
  using SetThreads = void (*)(int);
  if (auto* const found = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) {
    reinterpret_cast<SetThreads>(found)(1);
  }
}

}  // namespace curveskel
