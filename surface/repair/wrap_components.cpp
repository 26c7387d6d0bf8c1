#include "surface/repair/wrap_components.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/topology.hpp>
#include "surface/mesh/nearest_vertex.hpp"
#include "surface/repair/assembly.hpp"
#include "surface/repair/describe_repairs.hpp"
#include "surface/repair/renumber.hpp"
#include "surface/repair/wrap_solid.hpp"

namespace curveskel {
namespace {

/// The record's entries about wrapping, lengths in D of the whole surface.
void note(Repairs& repairs, const WrappedSolid& wrapped, double share_of_diagonal) {
  ++repairs.components_wrapped;
  repairs.wrap_gap = std::max(repairs.wrap_gap, wrapped.gap * share_of_diagonal);
  repairs.wrap_distance = std::max(repairs.wrap_distance, wrapped.distance * share_of_diagonal);
  repairs.wrap_mean_distance =
      std::max(repairs.wrap_mean_distance, wrapped.mean_distance * share_of_diagonal);
}

}  // namespace

RepairedSurface with_wraps(const RepairedSurface& repaired, const std::vector<ComponentWrap>& wraps,
                           const Monitor& monitor) {
  const double diagonal = bounding_box_diagonal(repaired.surface.positions);
  const Topology counted = topology(repaired.surface);
  const auto parts = split_components(repaired.surface, counted);
  std::vector<const WrappedSolid*> wrap_of(parts.size(), nullptr);
  for (const ComponentWrap& one : wraps) wrap_of[idx(one.component)] = &one.wrap;
  RepairedSurface result = repaired;
  std::vector<std::int32_t> number(idx(repaired.surface.positions.rows()), -1);
  Assembly assembly;
  std::int64_t faces = 0;
  double strayed = (1 - repaired.repairs.wrap_followed) * area(repaired.surface);
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const auto& [surface, in_whole] = parts[c];
    const WrappedSolid* const wrapped = wrap_of[c];
    if (wrapped == nullptr) {
      const std::int32_t first = assembly.add(surface);
      for (std::size_t v = 0; v < in_whole.size(); ++v) {
        number[idx(in_whole[v])] = first + static_cast<std::int32_t>(v);
      }
      continue;
    }
    note(result.repairs, *wrapped, bounding_box_diagonal(surface.positions) / diagonal);
    faces += surface.triangles.rows();
    strayed += (1 - wrapped->followed) * area(wrapped->surface);
    const std::int32_t first = assembly.add(wrapped->surface);
    const SurfaceTree tree(wrapped->surface);
    for (std::size_t v = 0; v < in_whole.size(); ++v) {
      number[idx(in_whole[v])] =
          first + nearest_vertex(wrapped->surface, tree, surface.positions.row(std::int64_t(v)));
    }
  }
  renumber(
      result, [&](std::int32_t v) { return number[idx(v)]; },
      [&](std::int32_t v) { return wrap_of[idx(counted.component_of_vertex[v])] != nullptr; });
  result.surface = assembly.whole();
  result.repairs.faces_wrapped += faces;
  result.repairs.wrap_followed = std::max(0.0, 1 - strayed / area(result.surface));
  describe_wrapped_components(result.repairs, faces, monitor);
  return result;
}

}  // namespace curveskel
