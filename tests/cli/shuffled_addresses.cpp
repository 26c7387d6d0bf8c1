// Memory in a random order, to be loaded before a program: whatever hangs on the order of addresses
// differs from run to run. CURVESKEL_SHUFFLE is the seed.
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <utility>

namespace {

/// In front of each block.
struct alignas(16) Head {
  void* start;       ///< of the memory that the block lies in
  std::size_t size;  ///< from there: a power of two
};

/// A free block holds the address of the next.
struct Free {
  Free* next;
};

constexpr std::size_t least_size = 64;
constexpr std::size_t of_the_system = std::size_t(1)
                                      << 18;  ///< such blocks come from it, one by one
constexpr int lists = 16;  ///< of free blocks of one size: each block goes to one by chance

std::mutex mutex;
std::array<std::array<Free*, lists>, 64> free_blocks;
std::uint64_t state;

std::uint64_t chance() {
  if (state == 0) {
    const char* seed = std::getenv("CURVESKEL_SHUFFLE");
    state = 88172645463325252U + (seed == nullptr ? 0 : std::strtoull(seed, nullptr, 10) * 7919);
  }
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return state;
}

void* from_system(std::size_t size) {
  const std::uintptr_t wish = 0x100000000000U + (chance() % (1U << 28)) * 4096;
  void* const found = mmap(std::bit_cast<void*>(wish), size, PROT_READ | PROT_WRITE,
                           MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return found == MAP_FAILED ? nullptr : found;
}

void keep(void* start, std::size_t size) {
  auto* const block = static_cast<Free*>(start);
  Free*& list = free_blocks[std::size_t(std::countr_zero(size))][chance() % lists];
  block->next = list;
  list = block;
}

void* taken(std::size_t size) {
  if (size >= of_the_system) return from_system(size);
  auto& of_size = free_blocks[std::size_t(std::countr_zero(size))];
  const std::size_t first = chance() % lists;
  for (std::size_t k = 0; k < lists; ++k) {
    Free*& list = of_size[(first + k) % lists];
    if (list != nullptr) return std::exchange(list, list->next);
  }
  const std::size_t all = std::max(size * 64, of_the_system);
  char* const fresh = static_cast<char*>(from_system(all));
  if (fresh == nullptr) return nullptr;
  for (std::size_t at = 0; at < all; at += size) keep(fresh + at, size);
  return taken(size);
}

Head& head_of(void* block) { return static_cast<Head*>(block)[-1]; }

std::size_t room_in(void* block) {
  const Head& head = head_of(block);
  return head.size - std::size_t(static_cast<char*>(block) - static_cast<char*>(head.start));
}

void* allocated(std::size_t size, std::size_t alignment) {
  if (size > (std::size_t(1) << 46)) return nullptr;
  const std::size_t needed = std::bit_ceil(std::max(size + sizeof(Head) + alignment, least_size));
  const std::lock_guard lock(mutex);
  void* const start = taken(needed);
  if (start == nullptr) return nullptr;
  void* block = static_cast<char*>(start) + sizeof(Head);
  std::size_t room = needed - sizeof(Head);
  (void)std::align(alignment, size, block, room);
  head_of(block) = {start, needed};
  return block;
}

void* or_error(void* block) {
  if (block == nullptr) errno = ENOMEM;
  return block;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) { return or_error(allocated(size, sizeof(Head))); }

void free(void* ptr) {
  if (ptr == nullptr) return;
  const Head head = head_of(ptr);
  const std::lock_guard lock(mutex);
  if (head.size >= of_the_system) {
    munmap(head.start, head.size);
  } else {
    keep(head.start, head.size);
  }
}

void* calloc(std::size_t nmemb, std::size_t size) {
  std::size_t all = 0;
  if (__builtin_mul_overflow(nmemb, size, &all)) return or_error(nullptr);
  void* const block = malloc(all);
  if (block != nullptr) std::memset(block, 0, all);
  return block;
}

void* realloc(void* ptr, std::size_t size) {
  if (ptr == nullptr) return malloc(size);
  if (size == 0) {
    free(ptr);
    return nullptr;
  }
  void* const larger = malloc(size);
  if (larger == nullptr) return nullptr;
  std::memcpy(larger, ptr, std::min(size, room_in(ptr)));
  free(ptr);
  return larger;
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return or_error(allocated(size, std::max(alignment, sizeof(Head))));
}

void* memalign(std::size_t alignment, std::size_t size) { return aligned_alloc(alignment, size); }

int posix_memalign(void** memptr, std::size_t alignment, std::size_t size) {
  *memptr = allocated(size, std::max(alignment, sizeof(Head)));
  return *memptr == nullptr ? ENOMEM : 0;
}

std::size_t malloc_usable_size(void* ptr) { return ptr == nullptr ? 0 : room_in(ptr); }
}
