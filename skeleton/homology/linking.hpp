// Linking numbers: how often curves cross over a surface's loops, seen from one side.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/surface.hpp>
#include "surface/mesh/handle_loops.hpp"

namespace curveskel::linking {

/// A point of the projection, on a grid so fine that points hardly move and so coarse
/// that the side of a line on which a point lies is computed exactly; and its height above.
struct Seen {
  std::int64_t x = 0;
  std::int64_t y = 0;
  double height = 0;
};

/// Along a direction in which no model has an axis.
class Projection {
 public:
  explicit Projection(const Positions& about);

  [[nodiscard]] Seen operator()(const Eigen::Vector3d& position) const;
  [[nodiscard]] std::vector<Seen> operator()(const Positions& positions) const;

 private:
  Eigen::Vector3d middle_;
  Eigen::Matrix3d frame_;
};

using Segment = std::array<Seen, 2>;

/// True if the first is seen to cross over the second. A point on a line counts as to its left.
[[nodiscard]] bool crosses_over(const Segment& a, const Segment& b);

/// Square cells, each with the segments whose boxes meet it. Keeps the segments.
class Grid {
 public:
  explicit Grid(std::vector<Segment> given);

  [[nodiscard]] std::size_t size() const { return segments_.size(); }

  /// Calls found(s) for each segment s that the given one crosses over.
  template <typename Found>
  void crossed_by(const Segment& segment, const Found& found) {
    ++asked_;
    for_cells(segment, [&](const std::vector<int>& cell) {
      for (const int s : cell) {
        if (std::exchange(last_asked_by_[idx(s)], asked_) == asked_) continue;
        if (crosses_over(segment, segments_[idx(s)])) found(s);
      }
    });
  }

 private:
  /// Segments beyond the grid meet none of its cells.
  template <typename Visit>
  void for_cells(const Segment& segment, const Visit& visit) {
    const auto [x_low, x_high] = std::minmax(segment[0].x, segment[1].x);
    const auto [y_low, y_high] = std::minmax(segment[0].y, segment[1].y);
    const auto first = [this](std::int64_t low, std::int64_t origin) {
      return std::max<std::int64_t>(0, low - origin) / cell_;
    };
    const auto last = [this](std::int64_t high, std::int64_t origin) {
      return high < origin ? -1 : std::min(side_ - 1, (high - origin) / cell_);
    };
    const std::int64_t x_first = first(x_low, low_[0]);
    const std::int64_t x_last = last(x_high, low_[0]);
    const std::int64_t y_last = last(y_high, low_[1]);
    for (std::int64_t y = first(y_low, low_[1]); y <= y_last; ++y) {
      const auto [from, to] = columns_passed(segment, y);
      for (std::int64_t x = std::max(from, x_first); x <= std::min(to, x_last); ++x) {
        visit(cells_[idx(y * side_ + x)]);
      }
    }
  }

  /// The first and the last cell that the segment passes in a row of cells, and one more on either
  /// side for rounding: a long segment's box has far more.
  [[nodiscard]] std::array<std::int64_t, 2> columns_passed(const Segment& segment,
                                                           std::int64_t row) const {
    const bool is_rising = segment[0].y <= segment[1].y;
    const Seen& lower = segment[is_rising ? 0 : 1];
    const Seen& upper = segment[is_rising ? 1 : 0];
    if (lower.y == upper.y) return {0, side_ - 1};
    const double slope =
        static_cast<double>(upper.x - lower.x) / static_cast<double>(upper.y - lower.y);
    const auto column_at = [&](std::int64_t line) {
      const std::int64_t y = std::clamp(low_[1] + line * cell_, lower.y, upper.y);
      const double x =
          static_cast<double>(lower.x - low_[0]) + slope * static_cast<double>(y - lower.y);
      return static_cast<std::int64_t>(std::floor(x / static_cast<double>(cell_)));
    };
    const auto [least, most] = std::minmax({column_at(row), column_at(row + 1)});
    return {least - 1, most + 1};
  }

  std::vector<Segment> segments_;
  std::array<std::int64_t, 2> low_{};
  std::int64_t side_ = 0;
  std::int64_t cell_ = 1;
  std::vector<std::vector<int>> cells_;
  std::vector<int> last_asked_by_;  // per segment
  int asked_ = 0;
};

/// The edges of all loops, seen from above.
struct SeenLoops {
  HandleLoops handles;
  Projection projection;
  Grid edges;

  explicit SeenLoops(const Surface& surface);
};

/// The crossings of a curve's segments over the loops' edges.
struct Crossing {
  int segment = 0;
  int loop_edge = 0;
};

/// For each 64 loops in turn calls with_words(words): one word a segment, whose bits say whether it
/// crosses over the loop oddly often.
template <typename WithWords>
void for_words(const HandleLoops& handles, const std::vector<Crossing>& crossings,
               std::size_t segments, const WithWords& with_words) {
  std::vector<std::uint64_t> of_loop_edge(handles.edges.size());
  for (std::size_t begin = 0; begin < handles.loops.size(); begin += 64) {
    std::fill(of_loop_edge.begin(), of_loop_edge.end(), 0);
    const std::size_t end = std::min(begin + 64, handles.loops.size());
    for (std::size_t loop = begin; loop < end; ++loop) {
      for (const int edge : handles.loops[loop]) of_loop_edge[idx(edge)] ^= 1ULL << (loop - begin);
    }
    std::vector<std::uint64_t> words(segments, 0);
    for (const Crossing& c : crossings) words[idx(c.segment)] ^= of_loop_edge[idx(c.loop_edge)];
    with_words(words);
  }
}

}  // namespace curveskel::linking
