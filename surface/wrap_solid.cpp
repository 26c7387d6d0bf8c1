#include "surface/wrap_solid.hpp"

#include <algorithm>
#include <vector>

#include "surface/element_index.hpp"
#include "surface/join_soup.hpp"
#include "surface/measures.hpp"
#include "surface/select_components.hpp"
#include "surface/topology.hpp"
#include "surface/tree.hpp"
#include "surface/wrap.hpp"

namespace curveskel {
namespace {

/// The components of a wrap that hold more than the wrap's own thickness on both sides of a sheet;
/// none if the wrap has two sides for most of what it wraps.
Surface solid_components(const Surface& wrapped, double offset, double given_area) {
  constexpr double most_area = 1.5;  // of the area given; a sheet's wrap has twice as much
  if (area(wrapped) > most_area * given_area) return {};
  const Topology counted = topology(wrapped);
  std::vector<Fate> fates(at(counted.components()), Fate::speck);
  const auto parts = split_components(wrapped, counted);
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const bool solid = volume(parts[c].surface) > 2 * offset * area(parts[c].surface);
    if (solid) fates[c] = Fate::kept;
  }
  Surface kept = wrapped;
  keep_components(kept, counted, fates);
  return kept;
}

WrappedSolid measured(Surface surface, double opening, const Surface& faces, double extent) {
  WrappedSolid result{std::move(surface), opening, 0, 0};
  const SurfaceTree tree(faces);
  for (const auto& p : result.surface.positions.rowwise()) {
    const double distance = tree.nearest(p.transpose()).distance / extent;
    result.mean_distance += distance / double(result.surface.positions.rows());
    result.distance = std::max(result.distance, distance);
  }
  return result;
}

}  // namespace

std::optional<WrappedSolid> wrap_solid(const Surface& faces, double opening,
                                       const Monitor& monitor) {
  const double extent = extent_of_faces(faces);
  const double offset = extent / 3000;
  const double given_area = area(faces);
  if (!(given_area > 1e-12 * extent * extent)) return std::nullopt;
  const auto solid_at = [&](double share) {
    return solid_components(wrap(faces, {share * extent, offset}, monitor), offset, given_area);
  };
  // The widest costs least: what it cannot enclose none can.
  const double widest = opening > 0 ? opening : wrap_openings.back();
  Surface solid = solid_at(widest);
  if (solid.triangles.rows() == 0) return std::nullopt;
  for (const double narrower : wrap_openings) {
    if (opening > 0 || narrower == widest) break;
    Surface closer = solid_at(narrower);
    if (closer.triangles.rows() > 0) return measured(std::move(closer), narrower, faces, extent);
  }
  return measured(std::move(solid), widest, faces, extent);
}

}  // namespace curveskel
