#include "contraction/fairing/wide_slices.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "base/parallel.hpp"
#include "surface/spatial/morton.hpp"

namespace curveskel {
namespace {

constexpr std::size_t slices_per_range = 1024;  // slices or vertices per piece of parallel work
/// Vertices sorted by valence at a time: few enough that their neighbours stay in cache.
constexpr std::size_t vertices_per_stretch = 4096;

std::size_t ring_size(const OneRings& rings, std::int32_t v) {
  return rings.of(static_cast<std::size_t>(v)).size();
}

/// Ascending valence within each vertices_per_stretch; equal ones stay in order.
void sort_stretches(std::span<std::int32_t> order, const OneRings& rings, int threads) {
  parallel_for(
      order.size(), vertices_per_stretch, threads, [&](std::size_t begin, std::size_t end) {
        std::array<std::size_t, largest_wide_ring + 2> place{};
        const std::vector<std::int32_t> unsorted(order.begin() + static_cast<std::ptrdiff_t>(begin),
                                                 order.begin() + static_cast<std::ptrdiff_t>(end));
        for (const std::int32_t v : unsorted) ++place[ring_size(rings, v) + 1];
        for (std::size_t k = 1; k < place.size(); ++k) place[k] += place[k - 1];
        for (const std::int32_t v : unsorted) order[begin + place[ring_size(rings, v)]++] = v;
      });
}

/// The vertices that `kernel` moves, in their order.
std::vector<std::int32_t> moved_by(LocalKernel kernel, const std::vector<std::int32_t>& order,
                                   const OneRings& rings) {
  std::vector<std::int32_t> vertices;
  vertices.reserve(kernel == LocalKernel::wide ? order.size() + slice_lanes : 0);
  for (const std::int32_t v : order) {
    if (local_kernel(false, false, ring_size(rings, v)) == kernel) vertices.push_back(v);
  }
  return vertices;
}

void fill_slices(WideSlices& slices, const OneRings& rings,
                 const std::vector<std::int32_t>& place_of, int threads) {
  parallel_for(slices.slices(), slices_per_range, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const auto first = static_cast<std::size_t>(slices.first_row[s]);
      const auto rows = static_cast<std::size_t>(slices.first_row[s + 1]) - first;
      for (std::size_t lane = 0; lane < slice_lanes; ++lane) {
        const auto v = static_cast<std::size_t>(slices.vertex_at[slice_lanes * s + lane]);
        const auto neighbours = rings.of(v);
        const std::size_t padding = rows - neighbours.size();
        for (std::size_t row = 0; row < rows; ++row) {
          const std::int32_t neighbour = neighbours[row < padding ? 0 : row - padding];
          slices.ring[slice_lanes * (first + row) + lane] =
              place_of[static_cast<std::size_t>(neighbour)];
        }
      }
    }
  });
}

}  // namespace

WideSlices wide_slices(const Positions& positions, const OneRings& rings, int threads) {
  WideSlices slices;
  slices.first_row.push_back(0);
  slices.large_start.push_back(0);
  if (positions.rows() == 0) return slices;
  const std::vector<std::int32_t> order = along_morton_curve(positions, threads);
  slices.vertex_at = moved_by(LocalKernel::wide, order, rings);
  sort_stretches(slices.vertex_at, rings, threads);
  while (slices.vertex_at.size() % slice_lanes != 0) {
    slices.vertex_at.push_back(slices.vertex_at.back());
  }
  for (std::size_t i = 0; i < slices.vertex_at.size(); i += slice_lanes) {
    std::size_t rows = 0;
    for (std::size_t lane = 0; lane < slice_lanes; ++lane) {
      rows = std::max(rows, ring_size(rings, slices.vertex_at[i + lane]));
    }
    slices.first_row.push_back(slices.first_row.back() + static_cast<std::int32_t>(rows));
  }
  const std::vector<std::int32_t> large = moved_by(LocalKernel::stream, order, rings);
  const std::vector<std::int32_t> held = moved_by(LocalKernel::none, order, rings);
  slices.vertex_at.insert(slices.vertex_at.end(), large.begin(), large.end());
  slices.vertex_at.insert(slices.vertex_at.end(), held.begin(), held.end());

  std::vector<std::int32_t> place_of(static_cast<std::size_t>(positions.rows()));
  for (std::size_t i = 0; i < slices.vertex_at.size(); ++i) {
    place_of[static_cast<std::size_t>(slices.vertex_at[i])] = static_cast<std::int32_t>(i);
  }
  slices.ring.resize(slice_lanes * static_cast<std::size_t>(slices.first_row.back()));
  fill_slices(slices, rings, place_of, threads);
  for (const std::int32_t v : large) {
    for (const std::int32_t neighbour : rings.of(static_cast<std::size_t>(v))) {
      slices.large_ring.push_back(place_of[static_cast<std::size_t>(neighbour)]);
    }
    slices.large_start.push_back(static_cast<std::int32_t>(slices.large_ring.size()));
  }
  return slices;
}

}  // namespace curveskel
