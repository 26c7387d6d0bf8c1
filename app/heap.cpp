#include "app/heap.hpp"

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <climits>
#include <cstddef>
#include <cstdlib>
#include <memory>

namespace curveskel {
namespace {

bool unlimited(__rlimit_resource_t resource) {
  rlimit limit{};
  return getrlimit(resource, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
}

}  // namespace

void use_large_pages() {
  // Addresses, not memory: only what is touched is taken. The heap grows beyond it as ever.
  constexpr std::size_t reserve = std::size_t{1} << 30U;
  constexpr std::size_t large_page = std::size_t{1} << 21U;
  if (!unlimited(RLIMIT_AS) || !unlimited(RLIMIT_DATA)) return;
  mallopt(M_ARENA_MAX, 1);  // threads would have heaps of their own, in small pages
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
  void* const memory = std::malloc(reserve);
  if (memory == nullptr) return;
  void* first = memory;
  std::size_t space = reserve;
  if (std::align(large_page, large_page, first, space) != nullptr) {
    madvise(first, space / large_page * large_page, MADV_HUGEPAGE);
  }
  std::free(memory);
}

}  // namespace curveskel
#else
namespace curveskel {
void use_large_pages() {}
}  // namespace curveskel
#endif
