#include "surface/read/placed_vertices.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

/// Polygons that have an unplaced corner go, the others move up.
void drop_polygons(PolygonSoup& soup, const std::vector<char>& unplaced) {
  std::size_t corners = 0;
  std::size_t polygons = 0;
  for (std::size_t p = 0; p + 1 < soup.offsets.size(); ++p) {
    const auto begin = soup.corners.begin() + soup.offsets[p];
    const auto end = soup.corners.begin() + soup.offsets[p + 1];
    if (std::any_of(begin, end, [&](std::int32_t v) { return unplaced[idx(v)] != 0; })) continue;
    // Offset p + 1 is read before any offset from it on is written, as no more polygons stay.
    std::copy(begin, end, soup.corners.begin() + static_cast<std::ptrdiff_t>(corners));
    corners += static_cast<std::size_t>(end - begin);
    soup.offsets[++polygons] = static_cast<std::int64_t>(corners);
  }
  soup.unplaced_polygons = static_cast<std::int64_t>(soup.offsets.size() - 1 - polygons);
  soup.corners.resize(corners);
  soup.offsets.resize(polygons + 1);
}

}  // namespace

void drop_unplaced_vertices(PolygonSoup& soup, const FileBytes& file) {
  if (soup.positions.allFinite()) return;
  const auto vertices = static_cast<std::size_t>(soup.positions.rows());
  std::vector<char> unplaced(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    unplaced[v] = soup.positions.row(static_cast<Eigen::Index>(v)).allFinite() ? 0 : 1;
  }
  soup.unplaced_vertices = std::count(unplaced.begin(), unplaced.end(), char{1});
  const auto polygons = static_cast<std::int64_t>(soup.offsets.size()) - 1;
  drop_polygons(soup, unplaced);
  const auto first = std::find(unplaced.begin(), unplaced.end(), char{1}) - unplaced.begin();
  if (2 * soup.unplaced_polygons > polygons) {
    file.fail("NaN or infinity in " + std::to_string(soup.unplaced_vertices) + " of " +
                  std::to_string(vertices) + " vertices (the first is vertex " +
                  std::to_string(first) + ", counted from 0), at which " +
                  std::to_string(soup.unplaced_polygons) + " of " + std::to_string(polygons) +
                  " faces end",
              "finite coordinates for at least half of the faces", "export the file again");
  }
  const auto placed = std::find(unplaced.begin(), unplaced.end(), char{0}) - unplaced.begin();
  const Eigen::RowVector3d place = placed < soup.positions.rows()
                                       ? Eigen::RowVector3d(soup.positions.row(placed))
                                       : Eigen::RowVector3d::Zero();
  for (std::size_t v = 0; v < vertices; ++v) {
    if (unplaced[v] != 0) soup.positions.row(static_cast<Eigen::Index>(v)) = place;
  }
}

void drop_unplaced_vertices(PolygonSoup& soup) {
  drop_unplaced_vertices(soup, {soup.file.empty() ? "surface" : soup.file, {}});
}

}  // namespace curveskel
