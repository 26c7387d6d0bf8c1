// Names that are unique among others.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace curveskel {

/// `name` where `taken` does not have it, else followed by `separator` and the least number from 2
/// on that makes it free. `taken` has the returned name afterwards.
[[nodiscard]] inline std::string free_name(std::set<std::string>& taken, const std::string& name,
                                           std::string_view separator) {
  std::string free = name;
  for (int number = 2; !taken.insert(free).second; ++number) {
    free = name;
    free.append(separator).append(std::to_string(number));
  }
  return free;
}

}  // namespace curveskel
