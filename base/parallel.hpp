// Independent work on all cores, with results that do not depend on how many there are.
#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <utility>

namespace curveskel {

/// The number of threads that `threads` stands for: itself, or one per core if it is 0.
[[nodiscard]] std::size_t thread_count(int threads);

/// Calls body(begin, end) on disjoint ranges that cover [0, count), from at most `threads` threads
/// (0 = one per core, the calling one among them), fewer where the system starts no more. The
/// ranges depend on count and grain alone. The body must write only to places that its own range
/// owns. The first exception, in the order of the ranges, is rethrown.
void parallel_for(std::size_t count, std::size_t grain, int threads,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Starts work() beside the caller's own, or, with `threads` = 1 or where the system starts no more
/// threads, leaves it until its result is asked for. Everything that the work refers to must
/// outlive the future, which waits for the work on destruction.
template <typename Work>
[[nodiscard]] auto in_background(int threads, Work&& work) {
  // Of both policies GCC's and Clang's libraries take the first, or the second where that fails.
  return std::async(
      threads == 1 ? std::launch::deferred : std::launch::async | std::launch::deferred,
      std::forward<Work>(work));
}

}  // namespace curveskel
