#include "surface/spatial/morton.hpp"

#include <array>
#include <cstddef>
#include <numeric>

namespace curveskel {

std::vector<std::int32_t> order_by_key(const std::vector<std::uint64_t>& keys, unsigned bits) {
  constexpr unsigned digit_bits = 11;
  constexpr std::size_t digits = std::size_t{1} << digit_bits;
  struct Entry {
    std::uint64_t key;
    std::int32_t index;
  };
  std::vector<Entry> entries(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) entries[i] = {keys[i], static_cast<int>(i)};
  std::vector<Entry> sorted(keys.size());
  for (unsigned shift = 0; shift < bits; shift += digit_bits) {
    std::array<std::uint32_t, digits + 1> begin{};
    for (const Entry& entry : entries) ++begin[(entry.key >> shift & (digits - 1)) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const Entry& entry : entries) {
      sorted[begin[entry.key >> shift & (digits - 1)]++] = entry;
    }
    entries.swap(sorted);
  }
  std::vector<std::int32_t> order(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = entries[i].index;
  return order;
}

}  // namespace curveskel
