// The places where a part is nearest to what it sits on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace curveskel {

/// By their `distance`, of equals in the order given. O(n log n).
template <typename Contact>
[[nodiscard]] std::vector<Contact> nearest_first(std::vector<Contact> contacts) {
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const auto& a, const auto& b) { return a.distance < b.distance; });
  return contacts;
}

/// So many of them count as where it sits: a tenth, three at least if there are.
[[nodiscard]] inline std::size_t places_that_count(std::size_t contacts) {
  return std::min(contacts, std::max<std::size_t>(3, contacts / 10));
}

}  // namespace curveskel
