#include "surface/spatial/morton.hpp"

#include <array>
#include <cstddef>
#include <numeric>

#include "base/parallel.hpp"

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

std::vector<std::int32_t> along_morton_curve(const Positions& positions, int threads) {
  constexpr unsigned bits_per_axis = 11;
  constexpr std::size_t rows_per_range = 4096;
  if (positions.rows() == 0) return {};
  const Eigen::RowVector3d low = positions.colwise().minCoeff();
  const double extent = (positions.colwise().maxCoeff() - low).maxCoeff();
  const double scale = extent > 0 ? ((1U << bits_per_axis) - 1) / extent : 0;
  std::vector<std::uint64_t> keys(static_cast<std::size_t>(positions.rows()));
  parallel_for(keys.size(), rows_per_range, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Eigen::RowVector3d cell = (positions.row(static_cast<Eigen::Index>(v)) - low) * scale;
      keys[v] =
          morton_key(static_cast<std::uint64_t>(cell.x()), static_cast<std::uint64_t>(cell.y()),
                     static_cast<std::uint64_t>(cell.z()));
    }
  });
  return order_by_key(keys, 3 * bits_per_axis);
}

}  // namespace curveskel
