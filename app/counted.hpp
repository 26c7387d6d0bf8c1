// Numbers with their nouns, as messages have them.
#pragma once

#include <cstdint>
#include <string>

namespace curveskel {

/// "1 vertex", "2 vertices"; `many` is needed where it is not `one` with an s.
[[nodiscard]] inline std::string count_of(std::int64_t count, const std::string& one,
                                          const std::string& many = {}) {
  const std::string noun = count == 1 ? one : many.empty() ? one + "s" : many;
  return std::to_string(count) + " " + noun;
}

}  // namespace curveskel
