// Random numbers that are the same with every standard library.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace curveskel::shapes {

/// std::mt19937_64 is fixed by the standard, the distributions over it are not: these are ours.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1.0p-53;
  }

  /// In [0, count).
  std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(uniform(0, static_cast<double>(count)));
  }

  /// Mean 0, standard deviation 1 (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
    return radius * std::cos(uniform(0, 2 * std::numbers::pi));
  }

  /// 0 .. count - 1 in random order (Fisher and Yates).
  std::vector<int> permutation(int count) {
    std::vector<int> order(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[index(i)]);
    return order;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace curveskel::shapes
