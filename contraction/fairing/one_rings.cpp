#include "contraction/fairing/one_rings.hpp"

namespace curveskel {
CornersByVertex corners_by_vertex(const Triangles& triangles, Eigen::Index vertices) {
  CornersByVertex corners;
  corners.start.assign(static_cast<std::size_t>(vertices) + 1, 0);
  const std::span<const std::int32_t> vertex_of(triangles.data(),
                                                static_cast<std::size_t>(triangles.size()));
  for (const std::int32_t v : vertex_of) ++corners.start[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 1; v < corners.start.size(); ++v) corners.start[v] += corners.start[v - 1];
  corners.corner.resize(vertex_of.size());
  std::vector<std::int64_t> end(corners.start.begin(), corners.start.end() - 1);
  for (std::size_t c = 0; c < vertex_of.size(); ++c) {
    const auto v = static_cast<std::size_t>(vertex_of[c]);
    corners.corner[static_cast<std::size_t>(end[v]++)] = static_cast<std::int32_t>(c);
  }
  return corners;
}

OneRings one_rings(const Triangles& triangles, Eigen::Index vertices) {
  const CornersByVertex corners = corners_by_vertex(triangles, vertices);
  const std::int32_t* const vertex_of = triangles.data();
  OneRings rings;
  rings.start.reserve(static_cast<std::size_t>(vertices) + 1);
  rings.start.push_back(0);
  rings.neighbours.reserve(corners.corner.size());

  // Within the star of one vertex: which neighbour follows this one. -1 between stars.
  std::vector<std::int32_t> after(static_cast<std::size_t>(vertices), -1);
  for (std::size_t v = 0; v < static_cast<std::size_t>(vertices); ++v) {
    const std::int64_t begin = corners.start[v];
    const std::int64_t count = corners.start[v + 1] - begin;
    const auto following = [&](std::int64_t i) {
      const std::int32_t c = corners.corner[static_cast<std::size_t>(begin + i)];
      return c % 3 == 2 ? c - 2 : c + 1;
    };
    const auto previous = [&](std::int64_t i) {
      const std::int32_t c = corners.corner[static_cast<std::size_t>(begin + i)];
      return c % 3 == 0 ? c + 2 : c - 1;
    };
    bool one_fan = count >= 3;
    for (std::int64_t i = 0; i < count && one_fan; ++i) {
      auto& next = after[static_cast<std::size_t>(vertex_of[following(i)])];
      one_fan = next < 0;
      next = vertex_of[previous(i)];
    }
    if (one_fan) {
      const std::int32_t first = vertex_of[following(0)];
      std::int32_t at = first;
      std::int64_t steps = 0;
      do {
        rings.neighbours.push_back(at);
        at = after[static_cast<std::size_t>(at)];
        ++steps;
      } while (steps < count && at >= 0 && at != first);
      one_fan = steps == count && at == first;
      if (!one_fan) rings.neighbours.resize(static_cast<std::size_t>(rings.start.back()));
    }
    for (std::int64_t i = 0; i < count; ++i) {
      after[static_cast<std::size_t>(vertex_of[following(i)])] = -1;
    }
    rings.start.push_back(static_cast<std::int64_t>(rings.neighbours.size()));
  }
  return rings;
}

}  // namespace curveskel
