#include "surface/repair/join_soup.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/median.hpp"
#include "surface/mesh/half_edges.hpp"
#include "surface/mesh/loose_parts.hpp"
#include "surface/repair/repeated_polygons.hpp"
#include "surface/repair/split_edges.hpp"
#include "surface/repair/weld.hpp"

namespace curveskel {
namespace {

std::int32_t vertices_of(const Joined& joined) {
  return static_cast<std::int32_t>(joined.surface.positions.rows());
}

void drop_repeats(Joined& joined, Changes& changes) {
  changes.degenerate_faces_dropped += drop_degenerate_faces(joined.surface.triangles);
  changes.duplicate_faces_dropped +=
      drop_duplicate_faces(joined.surface.triangles, vertices_of(joined));
}

/// Returns how many vertices were merged.
std::int64_t merge(Joined& joined, const std::vector<std::int32_t>& into) {
  std::int64_t merged = 0;
  for (std::size_t v = 0; v < into.size(); ++v) {
    merged += into[v] != static_cast<std::int32_t>(v) ? 1 : 0;
  }
  for (std::int32_t& v : joined.merged_into) v = into[idx(v)];
  for (std::int32_t& corner : joined.surface.triangles.reshaped<Eigen::RowMajor>()) {
    corner = into[idx(corner)];
  }
  return merged;
}

std::vector<bool> on_boundary(const Joined& joined) {
  return pair_half_edges(joined.surface.triangles, vertices_of(joined)).vertex_on_boundary;
}

/// Vertices of the file that no polygon uses.
std::int64_t unused_vertices(const PolygonSoup& soup) {
  std::vector<bool> used(idx(soup.positions.rows()), false);
  for (const std::int32_t v : soup.corners) used[idx(v)] = true;
  return std::count(used.begin(), used.end(), false);
}

/// Parts of less than `least_area` of the largest set no scale, unless they make up a good part of
/// the whole: then the surface is in pieces that are still to be joined.
double extent_without_specks(const Surface& surface, double least_area) {
  constexpr double most_in_specks = 0.01;  // of the area
  const LooseParts parts = loose_parts(surface);
  if (parts.areas.empty()) return 0;
  const double least = least_area * *std::max_element(parts.areas.begin(), parts.areas.end());
  double all = 0;
  double in_specks = 0;
  for (const double its : parts.areas) {
    all += its;
    if (its < least) in_specks += its;
  }
  if (in_specks == 0 || in_specks > most_in_specks * all) return extent_of_faces(surface);
  Eigen::AlignedBox3d box;
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    if (parts.areas[idx(parts.part_of_face[idx(f)])] < least) continue;
    for (const std::int32_t v : surface.triangles.row(f)) {
      box.extend(surface.positions.row(v).transpose());
    }
  }
  return box.diagonal().norm();
}

/// Of the edges with one face.
double median_boundary_edge(const Surface& surface, const HalfEdges& half_edges) {
  std::vector<double> lengths;
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(half_edges.twin.size()); ++h) {
    if (half_edges.twin[idx(h)] >= 0) continue;
    const std::int32_t from = surface.triangles.data()[h];
    const std::int32_t to = surface.triangles.data()[next_half_edge(h)];
    lengths.push_back((surface.positions.row(to) - surface.positions.row(from)).norm());
  }
  return lengths.empty() ? 0 : median_of(std::move(lengths));
}

/// A speck far away must not make it as long as the edges of rims, which it would eat.
double distance_to_join(const Surface& surface, const JoinOptions& options) {
  constexpr double most_of_an_edge = 0.25;
  const double wanted =
      options.distance_of_extent * extent_without_specks(surface, options.least_area);
  const auto vertices = static_cast<std::int32_t>(surface.positions.rows());
  const double edge = median_boundary_edge(surface, pair_half_edges(surface.triangles, vertices));
  return std::min(wanted, most_of_an_edge * edge);
}

}  // namespace

double extent_of_faces(const Surface& surface) {
  Eigen::AlignedBox3d box;
  for (const std::int32_t v : surface.triangles.reshaped()) {
    box.extend(surface.positions.row(v).transpose());
  }
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

Joined join_soup(const PolygonSoup& soup, const JoinOptions& options, Changes& changes,
                 JoinCounts& counts) {
  const auto once = without_repeated_polygons(soup, changes.duplicate_faces_dropped);
  Joined joined{{soup.positions, triangulate(once ? *once : soup, options.stop)}, {}};
  joined.merged_into.resize(idx(joined.surface.positions.rows()));
  std::iota(joined.merged_into.begin(), joined.merged_into.end(), 0);
  for (std::size_t p = 1; p < soup.offsets.size(); ++p) {
    changes.polygons_triangulated += soup.offsets[p] - soup.offsets[p - 1] > 3 ? 1 : 0;
  }
  changes.unplaced_vertices_dropped = soup.unplaced_vertices;
  changes.unplaced_polygons_dropped = soup.unplaced_polygons;
  changes.isolated_vertices_dropped = unused_vertices(soup) - soup.unplaced_vertices;
  drop_repeats(joined, changes);
  const auto exactly = coincident_vertices(joined.surface.positions, on_boundary(joined));
  changes.vertices_merged = merge(joined, exactly);
  drop_repeats(joined, changes);
  const double distance = distance_to_join(joined.surface, options);
  const auto open = on_boundary(joined);
  if (distance > 0 && std::find(open.begin(), open.end(), true) != open.end()) {
    const auto nearly = nearby_vertices(joined.surface.positions, open, distance);
    counts.vertices_joined = merge(joined, nearly);
    drop_repeats(joined, changes);
    counts.edges_split = split_edges_at_vertices(joined.surface, distance);
    if (counts.edges_split > 0) drop_repeats(joined, changes);
  }
  return joined;
}

}  // namespace curveskel
