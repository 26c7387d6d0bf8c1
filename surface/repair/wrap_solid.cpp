#include "surface/repair/wrap_solid.hpp"

#include <algorithm>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/topology.hpp>
#include "surface/mesh/triangle_area.hpp"
#include "surface/repair/join_soup.hpp"
#include "surface/repair/select_components.hpp"
#include "surface/repair/wrap.hpp"

namespace curveskel {
namespace {

/// Of the extent. In proportion to the gap, so that the sides of a sheet have as many vertices as
/// the gap asks for, not as their distance.
double offset_for(double gap) { return std::max(1.0 / 3000, gap / 30); }

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
  constexpr double near = 1.0 / 100;
  WrappedSolid result{std::move(surface), gap, offset_for(gap), 0, 0, 0};
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
  double followed = 0;
  for (const auto& t : wrap.triangles.rowwise()) {
    const Eigen::Vector3d a = wrap.positions.row(t(0));
    const Eigen::Vector3d b = wrap.positions.row(t(1));
    const Eigen::Vector3d c = wrap.positions.row(t(2));
    const double weight = twice_area(a, b, c);
    const double distance = away((a + b + c).transpose() / 3);
    sum += weight * distance;
    followed += distance <= near ? weight : 0;
    whole += weight;
  }
  if (whole > 0) result.mean_distance = sum / whole;
  if (whole > 0) result.followed = followed / whole;
  return result;
}

}  // namespace

double vertices_for_expected(const Surface& wrapped, const Surface& faces, double gap) {
  const double alpha = gap * extent_of_faces(faces);
  return static_cast<double>(wrapped.positions.rows()) * alpha * alpha / area(faces);
}

std::optional<WrappedSolid> wrap_solid(const Surface& faces, double gap, const WrapBudget& budget,
                                       const Monitor& monitor) {
  const double extent = extent_of_faces(faces);
  const double given_area = area(faces);
  if (!(given_area > 1e-12 * extent * extent)) return std::nullopt;
  WrapBudget each = budget;
  const auto solid_at = [&](double share) {
    WrapBudget left = each;
    const WrapOptions options{share * extent, offset_for(share) * extent};
    const Surface wrapped = wrap(faces, options, left, monitor);
    each.for_expected = std::max(each.for_expected, vertices_for_expected(wrapped, faces, share));
    return solid_components(wrapped, options.offset, given_area);
  };
  // The widest costs least, and no other encloses more.
  const double widest = gap > 0 ? gap : wrap_gaps.back();
  Surface solid = solid_at(widest);
  if (solid.triangles.rows() == 0) return std::nullopt;
  for (const double narrower : wrap_gaps) {
    if (gap > 0 || narrower == widest) break;
    try {
      Surface closer = solid_at(narrower);
      if (closer.triangles.rows() > 0) return measured(std::move(closer), narrower, faces, extent);
    } catch (const WrapTooLarge&) {  // a wider one will do
    }
  }
  return measured(std::move(solid), widest, faces, extent);
}

}  // namespace curveskel
