#include <curveskel/fair_polygons.hpp>

#include <cstdint>
#include <optional>
#include <string>

#include <curveskel/clean.hpp>
#include "surface/mesh/half_edges.hpp"
#include "surface/repair/join_soup.hpp"

namespace curveskel {
namespace {

std::optional<CleanSurface> cleaned_if_closed(const PolygonSoup& soup, const Monitor& monitor,
                                              int threads) {
  try {
    return clean(soup, monitor, threads);
  } catch (const Error&) {
    Changes changes;
    changes.unplaced_vertices_dropped = soup.unplaced_vertices;
    changes.unplaced_polygons_dropped = soup.unplaced_polygons;
    describe_changes(changes, monitor);
    return std::nullopt;
  }
}

void say_what_is_wrong(const Surface& surface, const Monitor& monitor) {
  const HalfEdges edges =
      pair_half_edges(surface.triangles, static_cast<std::int32_t>(surface.positions.rows()));
  if (edges.first_unpaired < 0) {
    monitor.say("encloses nothing, as it is one-sided or flat: faired as it is");
    return;
  }
  monitor.say("not closed (" + std::to_string(edges.boundary_edges) +
              (edges.boundary_edges == 1 ? " edge" : " edges") + " with one face, " +
              std::to_string(edges.crowded_edges) +
              " with three or more): faired as it is, its boundaries held");
}

}  // namespace

Surface fair_polygons(const PolygonSoup& soup, const FairOptions& options, const Monitor& monitor) {
  Surface surface{soup.positions, triangulate(soup)};
  if (const auto cleaned = cleaned_if_closed(soup, monitor, options.threads)) {
    const Surface smooth = fair(cleaned->surface, options, monitor);
    for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
      const int vertex = cleaned->vertex_of_input[v];
      if (vertex >= 0) surface.positions.row(v) = smooth.positions.row(vertex);
    }
    return surface;
  }
  Changes changes;
  JoinCounts counts;
  const Joined joined = join_soup(soup, {.stop = monitor.stop}, changes, counts);
  say_what_is_wrong(joined.surface, monitor);
  const Surface smooth = fair(joined.surface, options, monitor);
  for (std::size_t v = 0; v < joined.merged_into.size(); ++v) {
    surface.positions.row(static_cast<Eigen::Index>(v)) =
        smooth.positions.row(joined.merged_into[v]);
  }
  return surface;
}

}  // namespace curveskel
