#include "contraction/solvers/blas_threads.hpp"

#include <dlfcn.h>

#include <mutex>

namespace curveskel {
namespace {

/// Looked up at run time: which BLAS is behind libblas.so.3 is the machine's choice.
struct OpenBlas {
  using Get = int (*)();
  using Set = void (*)(int);
  Get get = reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  Set set = reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  bool per_thread = false;  ///< OpenMP has a number for each thread, POSIX threads one for all

  OpenBlas() {
    constexpr int with_openmp = 2;
    auto* const kind = reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "openblas_get_parallel"));
    if (kind == nullptr || kind() != with_openmp) return;
    per_thread = true;
    get = reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "omp_get_max_threads"));
    set = reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "omp_set_num_threads"));
  }
  [[nodiscard]] bool is_there() const { return get != nullptr && set != nullptr; }
};

const OpenBlas& open_blas() {
  static const OpenBlas found;
  return found;
}

/// Those that hold the process at one thread. The setting is the process', so its count is, too.
struct Holders {
  std::mutex mutex;
  int count = 0;
  int found = 1;
};

Holders& holders() {
  static Holders all;
  return all;
}

}  // namespace

OneBlasThread::OneBlasThread() {
  const OpenBlas& blas = open_blas();
  if (!blas.is_there()) return;
  if (blas.per_thread) {
    found_ = blas.get();
    if (found_ != 1) blas.set(1);
    return;
  }
  Holders& all = holders();
  const std::lock_guard lock(all.mutex);
  found_ = 1;
  if (all.count++ > 0) return;
  all.found = blas.get();
  if (all.found != 1) blas.set(1);
}

OneBlasThread::~OneBlasThread() {
  if (found_ == 0) return;
  const OpenBlas& blas = open_blas();
  if (blas.per_thread) {
    if (found_ != 1) blas.set(found_);
    return;
  }
  Holders& all = holders();
  const std::lock_guard lock(all.mutex);
  if (--all.count == 0 && all.found != 1) blas.set(all.found);
}

}  // namespace curveskel
