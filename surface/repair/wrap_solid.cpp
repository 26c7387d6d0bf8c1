#include "surface/repair/wrap_solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/topology.hpp>
#include "surface/repair/join_soup.hpp"
#include "surface/repair/select_components.hpp"
#include "surface/repair/wrap.hpp"

namespace curveskel {
namespace {

constexpr double offset_of_wraps = 1.0 / 3000;  // of the extent

/// The components of a wrap that hold more than the wrap's own thickness on both sides of a sheet;
/// none if the wrap has two sides for most of the wrapped area.
Surface solid_components(const Surface& wrapped, double offset, double given_area) {
  constexpr double most_area = 1.5;  // of the area given; a sheet's wrap has twice as much
  if (area(wrapped) > most_area * given_area) return {};
  const Topology counted = topology(wrapped);
  std::vector<Fate> fates(idx(counted.components()), Fate::speck);
  const auto parts = split_components(wrapped, counted);
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const bool solid = volume(parts[c].surface) > 2 * offset * area(parts[c].surface);
    if (solid) fates[c] = Fate::kept;
  }
  Surface kept = wrapped;
  keep_components(kept, counted, fates);
  return kept;
}

WrappedSolid measured(Surface surface, double gap, const Surface& faces, double extent) {
  WrappedSolid result{std::move(surface), gap, offset_of_wraps, 0, 0};
  const SurfaceTree tree(faces);
  const auto away = [&](const Eigen::RowVector3d& p) {
    const double distance = tree.nearest(p.transpose()).distance / extent;
    result.distance = std::max(result.distance, distance);
    return distance;
  };
  const Surface& wrap = result.surface;
  for (const auto& p : wrap.positions.rowwise()) away(p);
  double whole = 0;
  double sum = 0;
  for (const auto& t : wrap.triangles.rowwise()) {
    const Eigen::RowVector3d a = wrap.positions.row(t(0));
    const Eigen::RowVector3d b = wrap.positions.row(t(1));
    const Eigen::RowVector3d c = wrap.positions.row(t(2));
    const double weight = (b - a).cross(c - a).norm();
    sum += weight * away((a + b + c) / 3);
    whole += weight;
  }
  if (whole > 0) result.mean_distance = sum / whole;
  return result;
}

}  // namespace

std::optional<WrappedSolid> wrap_solid(const Surface& faces, double gap, const Monitor& monitor) {
  const double extent = extent_of_faces(faces);
  const double offset = offset_of_wraps * extent;
  const double given_area = area(faces);
  if (!(given_area > 1e-12 * extent * extent)) return std::nullopt;
  const auto solid_at = [&](double share) {
    return solid_components(wrap(faces, {share * extent, offset}, monitor), offset, given_area);
  };
  // The widest costs least, and no other encloses more.
  const double widest = gap > 0 ? gap : wrap_gaps.back();
  Surface solid = solid_at(widest);
  if (solid.triangles.rows() == 0) return std::nullopt;
  for (const double narrower : wrap_gaps) {
    if (gap > 0 || narrower == widest) break;
    if (narrower * extent < narrowest_gap(faces)) continue;
    Surface closer = solid_at(narrower);
    if (closer.triangles.rows() > 0) return measured(std::move(closer), narrower, faces, extent);
  }
  return measured(std::move(solid), widest, faces, extent);
}

}  // namespace curveskel
