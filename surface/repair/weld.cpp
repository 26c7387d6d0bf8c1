#include "surface/repair/weld.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include <curveskel/advanced/indices.hpp>
#include "base/buckets.hpp"

namespace curveskel {
namespace {

/// Returns how many were not kept.
std::int64_t keep_faces(Triangles& triangles, const std::vector<bool>& keep) {
  const auto dropped = std::count(keep.begin(), keep.end(), false);
  if (dropped == 0) return 0;
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    if (keep[idx(f)]) triangles.row(kept++) = triangles.row(f);
  }
  triangles.conservativeResize(kept, 3);
  return dropped;
}

/// The vertices of a face in ascending order, then the face.
using SortedFace = std::array<std::int32_t, 4>;

SortedFace sorted_face(const Triangles& triangles, std::int64_t face) {
  SortedFace result{triangles(face, 0), triangles(face, 1), triangles(face, 2),
                    static_cast<std::int32_t>(face)};
  std::sort(result.begin(), result.begin() + 3);
  return result;
}

struct Site {
  std::array<double, 3> position{};
  std::int32_t vertex = 0;
  bool operator<(const Site& other) const {
    return std::tie(position, vertex) < std::tie(other.position, other.vertex);
  }
};

/// Equal positions give equal numbers, others seldom do.
std::uint64_t scattered(const Site& site) {
  std::uint64_t result = 0;
  for (const double coordinate : site.position) {
    const double positive_zero = coordinate + 0.0;  // -0.0 equals 0.0
    result = (result ^ std::bit_cast<std::uint64_t>(positive_zero)) * 0x9e3779b97f4a7c15U;
    result ^= result >> 32U;
  }
  return result;
}

}  // namespace

std::int64_t drop_degenerate_faces(Triangles& triangles) {
  std::vector<bool> keep(idx(triangles.rows()));
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const auto corner = triangles.row(f);
    keep[idx(f)] = corner(0) != corner(1) && corner(1) != corner(2) && corner(2) != corner(0);
  }
  return keep_faces(triangles, keep);
}

std::int64_t drop_duplicate_faces(Triangles& triangles, std::int32_t vertices) {
  auto faces = bucket<SortedFace>(
      triangles.rows(), vertices, [&](std::int64_t f) { return triangles.row(f).minCoeff(); },
      [&](std::int64_t f) { return sorted_face(triangles, f); });
  std::vector<bool> keep(idx(triangles.rows()), true);
  for (std::int32_t v = 0; v < vertices; ++v) {
    const auto begin = faces.values.begin() + faces.offsets[idx(v)];
    const auto end = faces.values.begin() + faces.offsets[idx(v) + 1];
    std::sort(begin, end);
    for (auto face = begin; face != end; ++face) {
      const bool repeats =
          face != begin && std::equal(face->begin(), face->begin() + 3, face[-1].begin());
      if (repeats) keep[idx((*face)[3])] = false;
    }
  }
  return keep_faces(triangles, keep);
}

std::vector<std::int32_t> coincident_vertices(const Positions& positions,
                                              const std::vector<bool>& among) {
  std::vector<std::int32_t> candidates;
  candidates.reserve(idx(std::count(among.begin(), among.end(), true)));
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(positions.rows()); ++v) {
    if (among[idx(v)]) candidates.push_back(v);
  }
  const auto site_of = [&](std::int64_t i) {
    const std::int32_t v = candidates[idx(i)];
    return Site{{positions(v, 0), positions(v, 1), positions(v, 2)}, v};
  };
  const auto keys = std::bit_ceil(candidates.size() / 2 + 1);
  auto sites = bucket<Site>(
      static_cast<std::int64_t>(candidates.size()), static_cast<std::int64_t>(keys),
      [&](std::int64_t i) { return static_cast<std::int64_t>(scattered(site_of(i)) & (keys - 1)); },
      site_of);
  std::vector<std::int32_t> first(idx(positions.rows()));
  std::iota(first.begin(), first.end(), 0);
  for (std::size_t key = 0; key < keys; ++key) {
    const auto begin = sites.values.begin() + sites.offsets[key];
    const auto end = sites.values.begin() + sites.offsets[key + 1];
    std::sort(begin, end);
    for (auto site = begin; site != end; ++site) {
      if (site == begin || site->position != site[-1].position) continue;
      first[idx(site->vertex)] = first[idx(site[-1].vertex)];
    }
  }
  return first;
}

std::vector<std::int32_t> nearby_vertices(const Positions& positions,
                                          const std::vector<bool>& among, double distance) {
  std::vector<std::int32_t> first(idx(positions.rows()));
  std::iota(first.begin(), first.end(), 0);
  if (positions.rows() == 0) return first;
  const Eigen::RowVector3d origin = positions.colwise().minCoeff();
  // Few vertices are near a side of cells this wide, beyond which another cell has to be looked at.
  constexpr double distances = 32;
  constexpr double margin = (1 + 1e-6) / distances;  // of a cell
  const double width = distances * distance;
  std::unordered_map<std::uint64_t, std::int32_t> last_in;  // cell -> the last that stands there
  std::vector<std::int32_t> before(first.size(), -1);       // in the same cell
  const auto key_of = [](const Eigen::RowVector3d& cell) {
    return scattered({{cell.x(), cell.y(), cell.z()}, 0});
  };
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(positions.rows()); ++v) {
    if (!among[idx(v)]) continue;
    const Eigen::RowVector3d place = (positions.row(v) - origin) / width;
    const Eigen::RowVector3d lowest = (place.array() - margin).floor();
    const Eigen::RowVector3d highest = (place.array() + margin).floor();
    const Eigen::RowVector3i wide = (highest - lowest).cast<int>();  // 0 or 1 along each axis
    std::int32_t nearest = v;
    for (int neighbour = 0; neighbour < 8; ++neighbour) {
      const Eigen::RowVector3i step(neighbour % 2, neighbour / 2 % 2, neighbour / 4);
      if ((step.array() > wide.array()).any()) continue;
      const auto found = last_in.find(key_of(lowest + step.cast<double>()));
      std::int32_t other = found == last_in.end() ? -1 : found->second;
      for (; other >= 0; other = before[idx(other)]) {
        const bool is_near = (positions.row(other) - positions.row(v)).norm() <= distance;
        if (is_near) nearest = std::min(nearest, other);
      }
    }
    if (nearest == v) {
      std::int32_t& last = last_in.try_emplace(key_of(place.array().floor()), -1).first->second;
      before[idx(v)] = last;
      last = v;
    }
    first[idx(v)] = nearest;
  }
  return first;
}

std::vector<std::int32_t> drop_unused_vertices(Surface& surface) {
  std::vector<std::int32_t> number(idx(surface.positions.rows()), -1);
  for (const std::int32_t v : surface.triangles.reshaped()) number[idx(v)] = 0;
  std::int32_t used = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    surface.positions.row(used) = surface.positions.row(std::int64_t(v));
    number[v] = used++;
  }
  surface.positions.conservativeResize(used, 3);
  for (std::int32_t& v : surface.triangles.reshaped<Eigen::RowMajor>()) v = number[idx(v)];
  return number;
}

}  // namespace curveskel
