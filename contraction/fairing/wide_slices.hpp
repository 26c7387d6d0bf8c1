// A surface's vertices in the order and the slices in which the wide kernel takes them (SELL-16).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <curveskel/surface.hpp>
#include "contraction/fairing/one_rings.hpp"

namespace curveskel {

inline constexpr std::size_t slice_lanes = 16;        ///< vertices per slice
inline constexpr std::size_t largest_wide_ring = 32;  ///< neighbours; the wide kernel keeps a ring

enum class LocalKernel {
  none,    ///< a held vertex
  wide,    ///< 16 vertices to a work-item, kernels/one_ring_wide.cl
  stream,  ///< one vertex to a work-item, kernels/one_ring_stream.cl
};

/// The kernel that moves a vertex with `valence` neighbours in its ring. Wide on processors, whose
/// compilers do not put one work-item to a lane, for the rings of nearly all vertices. Double
/// precision and graphics processors have the scalar kernel only. Pure.
[[nodiscard]] constexpr LocalKernel local_kernel(bool gpu, bool double_precision,
                                                 std::size_t valence) {
  if (valence == 0) return LocalKernel::none;
  const bool wide = !gpu && !double_precision && valence <= largest_wide_ring;
  return wide ? LocalKernel::wide : LocalKernel::stream;
}

/// Places 0 .. 16 #slices - 1 are those of the slices, slice s has 16 s .. 16 s + 15; then come
/// vertices with large rings, then those that are held. Neighbours are given by their places.
struct WideSlices {
  /// The vertex at each place. The last slice is filled up with its last vertex, so that some are
  /// there more than once; their places get the same position.
  std::vector<std::int32_t> vertex_at;
  /// #slices + 1. The rings of slice s are the rows first_row[s] .. first_row[s + 1] - 1 of `ring`.
  std::vector<std::int32_t> first_row;
  /// Row r has one neighbour for each lane, ring[16 r + lane]. The rows of a slice go once round
  /// each ring; a ring shorter than the slice's longest repeats its first neighbour at the front.
  std::vector<std::int32_t> ring;
  /// #large + 1. The ring of large vertex i is large_ring[large_start[i]] .., as in OneRings.
  std::vector<std::int32_t> large_start;
  std::vector<std::int32_t> large_ring;

  [[nodiscard]] std::size_t slices() const { return first_row.size() - 1; }
  [[nodiscard]] std::size_t large() const { return large_start.size() - 1; }
};

/// Along the Morton curve of the positions, and by valence within stretches of it, so that a slice
/// has rings of one length and neighbours are near in memory. The result does not depend on
/// `threads` (0 = one per core). O(#V + #neighbours).
[[nodiscard]] WideSlices wide_slices(const Positions& positions, const OneRings& rings,
                                     int threads);

}  // namespace curveskel
