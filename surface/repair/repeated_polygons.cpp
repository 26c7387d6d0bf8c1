#include "surface/repair/repeated_polygons.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>
#include <vector>

#include "surface/repair/polygon_corners.hpp"

namespace curveskel {
namespace {

/// The corners from the smallest on, towards the smaller of its neighbours.
std::vector<std::int32_t> cycle_of(std::span<const std::int32_t> corners) {
  std::vector<std::int32_t> cycle(corners.begin(), corners.end());
  std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
  if (cycle.back() < cycle[1]) std::reverse(cycle.begin() + 1, cycle.end());
  return cycle;
}

/// Polygons with the same corners in any order have the same one; few others do.
std::uint64_t mark_of(std::span<const std::int32_t> corners) {
  std::uint64_t sum = 0;
  for (const std::int32_t v : corners) {
    std::uint64_t bits = (static_cast<std::uint64_t>(v) + 1) * 0x9E3779B97F4A7C15U;
    bits = (bits ^ (bits >> 32U)) * 0xD6E8FEB86659FD93U;
    sum += bits ^ (bits >> 29U);
  }
  return sum;
}

/// By polygon, 1 = it repeats one before it.
std::vector<char> repeats_among(const PolygonSoup& soup) {
  std::vector<std::tuple<std::uint64_t, std::size_t>> marks;
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    const auto corners = corners_of_polygon(soup, p);
    if (corners.size() > 3) marks.emplace_back(mark_of(corners), p);
  }
  std::sort(marks.begin(), marks.end());
  std::vector<char> repeats(soup.offsets.size() - 1, 0);
  std::vector<std::vector<std::int32_t>> cycles;
  for (std::size_t i = 0; i < marks.size();) {
    const std::uint64_t mark = std::get<0>(marks[i]);
    const bool alone = i + 1 == marks.size() || std::get<0>(marks[i + 1]) != mark;
    cycles.clear();
    for (; i < marks.size() && std::get<0>(marks[i]) == mark; ++i) {
      if (alone) continue;
      const std::size_t p = std::get<1>(marks[i]);
      auto cycle = cycle_of(corners_of_polygon(soup, p));
      repeats[p] = std::find(cycles.begin(), cycles.end(), cycle) != cycles.end() ? 1 : 0;
      if (repeats[p] == 0) cycles.push_back(std::move(cycle));
    }
  }
  return repeats;
}

}  // namespace

std::optional<PolygonSoup> without_repeated_polygons(const PolygonSoup& soup,
                                                     std::int64_t& triangles) {
  const std::vector<char> repeats = repeats_among(soup);
  if (std::find(repeats.begin(), repeats.end(), 1) == repeats.end()) return std::nullopt;
  PolygonSoup result = soup;
  result.corners.clear();
  result.offsets.assign(1, 0);
  for (std::size_t p = 0; p < repeats.size(); ++p) {
    const auto corners = corners_of_polygon(soup, p);
    if (repeats[p] != 0) {
      triangles += static_cast<std::int64_t>(corners.size()) - 2;
      continue;
    }
    result.corners.insert(result.corners.end(), corners.begin(), corners.end());
    result.offsets.push_back(static_cast<std::int64_t>(result.corners.size()));
  }
  return result;
}

}  // namespace curveskel
