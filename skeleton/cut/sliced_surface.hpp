// A surface with values and groups at its vertices that grows finer where it is cut.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// A surface that is cut where a value passes certain levels, the finer ones only where they are
/// needed.
struct Sliced {
  Surface surface;
  EdgeIndex index;
  std::vector<double> value;  ///< of each vertex
  std::vector<int> group;     ///< of each vertex
  double first_width = 0;     ///< between two levels, where they are coarsest
  double width = 0;           ///< where they are finest

  [[nodiscard]] double step(std::size_t edge) const {
    return std::abs(value[idx(index.edges[edge][0])] - value[idx(index.edges[edge][1])]);
  }
  /// At the middle of an edge.
  [[nodiscard]] double middle_value(std::size_t edge) const {
    return 0.5 * (value[idx(index.edges[edge][0])] + value[idx(index.edges[edge][1])]);
  }
  /// Levels lie at half the first width and whole multiples of `width` from there, so that those of
  /// one width are among those of half of it.
  [[nodiscard]] long slice(double at_value) const {
    return std::lround(std::floor((at_value - 0.5 * first_width) / width));
  }
};

/// A vertex in the middle of an edge, to be.
struct EdgeMiddle {
  std::size_t edge = 0;
  int group = 0;
};

/// Splits these edges, each named once. The old vertices come first, then the new ones in this
/// order. Of two ways to cut a triangle the one whose edge is less steep is taken. O(#F log #F).
void split_edges(Sliced& sliced, const std::vector<EdgeMiddle>& middles);

}  // namespace curveskel
