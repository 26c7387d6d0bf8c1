#include "app/heap.hpp"

#include <cstdlib>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <climits>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

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
  constexpr std::uintptr_t large_page = std::uintptr_t{1} << 21U;
  if (!unlimited(RLIMIT_AS) || !unlimited(RLIMIT_DATA)) return;
  mallopt(M_ARENA_MAX, 1);  // threads would have heaps of their own, in small pages
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
  void* const memory = std::malloc(reserve);
  if (memory == nullptr) return;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (begin + large_page - 1) / large_page * large_page;
  const std::uintptr_t last = (begin + reserve) / large_page * large_page;
  madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
  std::free(memory);
}

}  // namespace curveskel
#else
namespace curveskel {
void use_large_pages() {}
}  // namespace curveskel
#endif
