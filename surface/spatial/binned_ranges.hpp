// Ranges of boxes, split where their halves cost least to visit. Internal to surface/.
#pragma once

#include <utility>
#include <vector>

#include "surface/spatial/wide_tree.hpp"

namespace curveskel {

inline constexpr int leaf_size = 4;   ///< triangles of a leaf
inline constexpr float huge = 1e30F;  ///< more than any coordinate of the local frame

struct Box {
  Float4 lo{huge, huge, huge, huge};
  Float4 hi{-huge, -huge, -huge, -huge};

  void include(const Box& other) {
    lo = lo < other.lo ? lo : other.lo;
    hi = hi > other.hi ? hi : other.hi;
  }
  void include(Float4 point) {
    lo = lo < point ? lo : point;
    hi = hi > point ? hi : point;
  }
  [[nodiscard]] float half_area() const {
    const Float4 d = hi - lo;
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }
};

struct Range {
  int begin = 0;
  int end = 0;
  int depth = 0;
  Box box;
  Box centroids;  // of the boxes, doubled
  [[nodiscard]] int size() const { return end - begin; }
  void include(const Box& member) {
    box.include(member);
    centroids.include(member.lo + member.hi);
  }
};

/// Boxes in the order in which ranges refer to them, and the number of each. Ranges that share no
/// box may be split at the same time.
struct BinnedRanges {
  std::vector<Box> boxes;
  std::vector<int> order;

  [[nodiscard]] Range measured(int begin, int end, int depth) const;
  /// Two parts of a range of at least two, neither empty. Moves boxes within the range.
  [[nodiscard]] std::pair<Range, Range> split(const Range& range);
};

}  // namespace curveskel
