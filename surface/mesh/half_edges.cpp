#include "surface/mesh/half_edges.hpp"

#include <algorithm>

#include "base/buckets.hpp"

namespace curveskel {

HalfEdges pair_half_edges(const Triangles& triangles, std::int32_t vertices) {
  const std::int64_t count = 3 * triangles.rows();
  const std::int32_t* const corner = triangles.data();
  const auto end_of = [corner](std::int64_t h) { return corner[h % 3 == 2 ? h - 2 : h + 1]; };

  // Grouped by the smaller end; within a group the larger end and then h decide.
  auto edges = bucket<std::uint64_t>(
      count, vertices, [&](std::int64_t h) { return std::min(corner[h], end_of(h)); },
      [&](std::int64_t h) {
        const auto larger = static_cast<std::uint64_t>(std::max(corner[h], end_of(h)));
        return larger << 32U | static_cast<std::uint64_t>(h);
      });

  HalfEdges result;
  result.twin.assign(static_cast<std::size_t>(count), -1);
  result.vertex_on_boundary.assign(static_cast<std::size_t>(vertices), false);
  for (std::int32_t v = 0; v < vertices; ++v) {
    const auto begin = edges.values.begin() + edges.offsets[static_cast<std::size_t>(v)];
    const auto end = edges.values.begin() + edges.offsets[static_cast<std::size_t>(v) + 1];
    std::sort(begin, end);
    for (auto run = begin; run != end;) {
      const std::uint64_t larger = *run >> 32U;
      const auto run_end =
          std::find_if(run, end, [larger](std::uint64_t edge) { return edge >> 32U != larger; });
      const auto faces = static_cast<std::int32_t>(run_end - run);
      const auto first = static_cast<std::int32_t>(*run & 0xffffffffU);
      if (faces == 2) {
        const auto second = static_cast<std::int32_t>(run[1] & 0xffffffffU);
        result.twin[static_cast<std::size_t>(first)] = second;
        result.twin[static_cast<std::size_t>(second)] = first;
      } else {
        if (result.first_unpaired < 0 || first < result.first_unpaired) {
          result.first_unpaired = first;
          result.faces_at_first = faces;
        }
        ++(faces == 1 ? result.boundary_edges : result.crowded_edges);
        if (faces == 1) {
          result.vertex_on_boundary[static_cast<std::size_t>(v)] = true;
          result.vertex_on_boundary[static_cast<std::size_t>(larger)] = true;
        }
      }
      run = run_end;
    }
  }
  return result;
}

}  // namespace curveskel
