// Polygons to triangles that make a manifold where they can.
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <curveskel/clean.hpp>
#include "surface/repair/ear_clipping.hpp"
#include "surface/repair/polygon_corners.hpp"
#include "surface/repair/sound_soup.hpp"

namespace curveskel {
namespace {

/// Polygons without corners that repeat the one before them.
PolygonSoup without_repeats(const PolygonSoup& soup) {
  PolygonSoup result;
  result.offsets.push_back(0);
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    const std::size_t first = result.corners.size();
    for (std::int64_t i = soup.offsets[p]; i < soup.offsets[p + 1]; ++i) {
      const std::int32_t corner = soup.corners[static_cast<std::size_t>(i)];
      if (result.corners.size() == first || result.corners.back() != corner) {
        result.corners.push_back(corner);
      }
    }
    while (result.corners.size() > first + 1 && result.corners.back() == result.corners[first]) {
      result.corners.pop_back();
    }
    // A polygon without three corners becomes one degenerate triangle, for `clean` to count.
    while (result.corners.size() > first && result.corners.size() < first + 3) {
      result.corners.push_back(result.corners[first]);
    }
    result.offsets.push_back(static_cast<std::int64_t>(result.corners.size()));
  }
  return result;
}

/// Keys of a polygon's edges, sorted.
void collect_edges(std::span<const std::int32_t> corners, std::vector<std::uint64_t>& edges) {
  edges.clear();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    edges.push_back(edge_key(corners[i], corners[(i + 1) % corners.size()]));
  }
  std::sort(edges.begin(), edges.end());
}

/// Diagonals, sorted, that occur twice or are edges: they would have more than two triangles.
std::vector<std::uint64_t> crowded_diagonals(const PolygonSoup& soup, const Triangles& triangles,
                                             const std::vector<std::int64_t>& first_triangle) {
  std::vector<std::uint64_t> edges;
  std::vector<std::uint64_t> diagonals;
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    const auto corners = corners_of_polygon(soup, p);
    if (corners.size() <= 3) continue;
    collect_edges(corners, edges);
    const auto first = static_cast<std::ptrdiff_t>(diagonals.size());
    for (std::int64_t t = first_triangle[p]; t < first_triangle[p + 1]; ++t) {
      for (int k = 0; k < 3; ++k) {
        const std::uint64_t key = edge_key(triangles(t, k), triangles(t, (k + 1) % 3));
        if (!std::binary_search(edges.begin(), edges.end(), key)) diagonals.push_back(key);
      }
    }
    // Both triangles of a diagonal are in this polygon.
    std::sort(diagonals.begin() + first, diagonals.end());
    diagonals.erase(std::unique(diagonals.begin() + first, diagonals.end()), diagonals.end());
  }
  std::sort(diagonals.begin(), diagonals.end());
  std::vector<std::uint64_t> crowded;
  for (std::size_t i = 1; i < diagonals.size(); ++i) {
    if (diagonals[i] == diagonals[i - 1]) crowded.push_back(diagonals[i]);
  }
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    const auto corners = corners_of_polygon(soup, p);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint64_t key = edge_key(corners[i], corners[(i + 1) % corners.size()]);
      if (std::binary_search(diagonals.begin(), diagonals.end(), key)) crowded.push_back(key);
    }
  }
  std::sort(crowded.begin(), crowded.end());
  crowded.erase(std::unique(crowded.begin(), crowded.end()), crowded.end());
  return crowded;
}

}  // namespace

Triangles triangulate(const PolygonSoup& given, const std::stop_token& stop) {
  require_sound(given);
  const auto polygons = static_cast<std::int64_t>(given.offsets.size()) - 1;
  bool only_triangles = given.corners.size() == static_cast<std::size_t>(3 * polygons);
  for (std::int64_t p = 0; only_triangles && p < polygons; ++p) {
    only_triangles = given.offsets[static_cast<std::size_t>(p)] == 3 * p;
  }
  if (only_triangles) return Eigen::Map<const Triangles>(given.corners.data(), polygons, 3);

  const PolygonSoup soup = without_repeats(given);
  std::vector<std::int64_t> first_triangle{0};
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    const auto corners = static_cast<std::int64_t>(corners_of_polygon(soup, p).size());
    first_triangle.push_back(first_triangle.back() + std::max<std::int64_t>(corners - 2, 0));
  }
  Triangles triangles(first_triangle.back(), 3);
  std::vector<std::uint64_t> banned;
  for (int round = 0; round < 3; ++round) {
    for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
      const auto corners = corners_of_polygon(soup, p);
      std::int32_t* const target = triangles.data() + 3 * first_triangle[p];
      if (corners.size() == 3 && round == 0) std::copy(corners.begin(), corners.end(), target);
      if (corners.size() > 3) clip_ears(given.positions, corners, banned, stop, target);
    }
    const auto crowded = crowded_diagonals(soup, triangles, first_triangle);
    const std::size_t before = banned.size();
    banned.insert(banned.end(), crowded.begin(), crowded.end());
    std::sort(banned.begin(), banned.end());
    banned.erase(std::unique(banned.begin(), banned.end()), banned.end());
    if (banned.size() == before) break;
  }
  return triangles;
}

}  // namespace curveskel
