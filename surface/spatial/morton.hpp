// Order along a Morton curve: neighbours in space become neighbours in memory.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel {

/// Interleaves the low 21 bits of x, y and z, x leading.
[[nodiscard]] constexpr std::uint64_t morton_key(std::uint64_t x, std::uint64_t y,
                                                 std::uint64_t z) {
  const auto spread = [](std::uint64_t bits) {
    bits &= 0x1fffffU;
    bits = (bits | bits << 32U) & 0x001f00000000ffffU;
    bits = (bits | bits << 16U) & 0x001f0000ff0000ffU;
    bits = (bits | bits << 8U) & 0x100f00f00f00f00fU;
    bits = (bits | bits << 4U) & 0x10c30c30c30c30c3U;
    return (bits | bits << 2U) & 0x1249249249249249U;
  };
  return spread(x) << 2U | spread(y) << 1U | spread(z);
}

/// The indices of the keys in ascending order of key, equal keys in ascending order of index.
/// Only the lowest `bits` bits count. Radix sort, O(#keys * bits / 11).
[[nodiscard]] std::vector<std::int32_t> order_by_key(const std::vector<std::uint64_t>& keys,
                                                     unsigned bits);

/// The rows in their order along the curve through a grid of 2048 cells per axis. Precondition:
/// finite. O(#rows).
[[nodiscard]] std::vector<std::int32_t> along_morton_curve(const Positions& positions, int threads);

}  // namespace curveskel
