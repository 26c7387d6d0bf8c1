// I. Wald, On fast construction of SAH-based bounding volume hierarchies, 2007.
#include "surface/spatial/binned_ranges.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace curveskel {
namespace {

constexpr int most_bins = 16;
constexpr int median_depth = 48;  // binary splits; below it ranges are halved, so depth is bounded

// The bin of a box by its doubled centroid along the axis of the split.
struct Axis {
  int index;
  int bins;
  float lower;
  float factor;
  [[nodiscard]] int bin(const Box& box) const {
    const float value = box.lo[index] + box.hi[index];
    return std::min(bins - 1, static_cast<int>((value - lower) * factor));
  }
};

// Members of bins up to last_left come first.
std::pair<Range, Range> partition(BinnedRanges& all, const Range& range, const Axis& axis,
                                  int last_left) {
  Range left{range.begin, range.begin, range.depth + 1, {}, {}};
  Range right{range.end, range.end, range.depth + 1, {}, {}};
  while (left.end < right.begin) {
    const auto i = static_cast<std::size_t>(left.end);
    if (axis.bin(all.boxes[i]) <= last_left) {
      left.include(all.boxes[i]);
      ++left.end;
    } else {
      right.include(all.boxes[i]);
      const auto j = static_cast<std::size_t>(--right.begin);
      std::swap(all.boxes[i], all.boxes[j]);
      std::swap(all.order[i], all.order[j]);
    }
  }
  return {left, right};
}

// The last bin on the left of the cut whose sides cost least to visit.
int cheapest_cut(const std::vector<Box>& boxes, const Range& range, const Axis& axis) {
  std::array<Box, most_bins> box;
  std::array<int, most_bins> count{};
  for (int i = range.begin; i < range.end; ++i) {
    const Box& member = boxes[static_cast<std::size_t>(i)];
    const auto bin = static_cast<std::size_t>(axis.bin(member));
    box[bin].include(member);
    ++count[bin];
  }
  const auto cost = [](const Box& side, int members) {
    const int leaves = (members + leaf_size - 1) / leaf_size;
    return members == 0 ? 0.0F : side.half_area() * static_cast<float>(leaves);
  };
  std::array<float, most_bins> cost_right{};
  Box side;
  int members = 0;
  const auto bins = static_cast<std::size_t>(axis.bins);
  for (std::size_t i = bins - 1; i > 0; --i) {
    side.include(box[i]);
    members += count[i];
    cost_right[i] = cost(side, members);
  }
  int best = 0;
  float best_cost = std::numeric_limits<float>::infinity();
  side = Box{};
  members = 0;
  for (std::size_t i = 0; i + 1 < bins; ++i) {
    side.include(box[i]);
    members += count[i];
    const float total = cost(side, members) + cost_right[i + 1];
    if (total < best_cost) {
      best_cost = total;
      best = static_cast<int>(i);
    }
  }
  return best;
}

}  // namespace

Range BinnedRanges::measured(int begin, int end, int depth) const {
  Range range{begin, end, depth, {}, {}};
  for (int i = begin; i < end; ++i) range.include(boxes[static_cast<std::size_t>(i)]);
  return range;
}

std::pair<Range, Range> BinnedRanges::split(const Range& range) {
  const Float4 extent = range.centroids.hi - range.centroids.lo;
  int index = 0;
  if (extent[1] > extent[index]) index = 1;
  if (extent[2] > extent[index]) index = 2;
  if (extent[index] > 0 && range.depth < median_depth) {
    const int bins = std::clamp(range.size() / 2, 4, most_bins);
    const Axis axis{index, bins, range.centroids.lo[index],
                    static_cast<float>(bins) / extent[index]};
    auto halves = partition(*this, range, axis, cheapest_cut(boxes, range, axis));
    if (halves.first.size() > 0 && halves.second.size() > 0) return halves;
  }
  const int middle = (range.begin + range.end) / 2;
  return {measured(range.begin, middle, range.depth + 1),
          measured(middle, range.end, range.depth + 1)};
}

}  // namespace curveskel
