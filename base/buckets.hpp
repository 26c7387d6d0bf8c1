// Counting sort: groups by vertex need no hash table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace curveskel {

/// Values grouped by key: those of key k are values[offsets[k]] .. values[offsets[k + 1] - 1], in
/// the order in which they came.
template <typename Value>
struct Buckets {
  std::vector<std::int64_t> offsets;  ///< number of keys + 1
  std::vector<Value> values;
};

/// key(i) in [0, keys) and value(i) for i in [0, count). O(count + keys).
template <typename Value, typename KeyOf, typename ValueOf>
[[nodiscard]] Buckets<Value> bucket(std::int64_t count, std::int64_t keys, const KeyOf& key,
                                    const ValueOf& value) {
  Buckets<Value> buckets;
  buckets.offsets.assign(static_cast<std::size_t>(keys) + 1, 0);
  for (std::int64_t i = 0; i < count; ++i) ++buckets.offsets[static_cast<std::size_t>(key(i)) + 1];
  for (std::size_t k = 1; k < buckets.offsets.size(); ++k) {
    buckets.offsets[k] += buckets.offsets[k - 1];
  }
  std::vector<std::int64_t> next(buckets.offsets.begin(), buckets.offsets.end() - 1);
  buckets.values = std::vector<Value>(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    buckets.values[static_cast<std::size_t>(next[static_cast<std::size_t>(key(i))]++)] = value(i);
  }
  return buckets;
}

}  // namespace curveskel
