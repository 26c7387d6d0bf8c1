// Pairs that are still to be united, the smallest first.
#pragma once

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace curveskel {

class OpenPairs {
 public:
  /// All closed at first.
  explicit OpenPairs(std::size_t pairs) : size_(pairs, 0), is_open_(pairs, 0) {}

  /// Once more if it is open already, with another size.
  void open(std::size_t pair, std::size_t size) {
    close(pair);
    by_size_.emplace(size, pair);
    size_[pair] = size;
    is_open_[pair] = 1;
  }

  void close(std::size_t pair) {
    if (has(pair)) by_size_.erase({size_[pair], pair});
    is_open_[pair] = 0;
  }

  [[nodiscard]] bool has(std::size_t pair) const { return is_open_[pair] != 0; }
  [[nodiscard]] std::size_t count() const { return by_size_.size(); }
  /// Of equal ones the first. Precondition: one is open.
  [[nodiscard]] std::size_t smallest() const { return by_size_.begin()->second; }

 private:
  std::vector<std::size_t> size_;  // by pair
  std::vector<char> is_open_;
  std::set<std::pair<std::size_t, std::size_t>> by_size_;  // with the pair
};

}  // namespace curveskel
