// Passes of edge collapses over a patch of surface.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "surface/resample/quadric.hpp"

namespace curveskel {

/// Part of a surface on its way to fewer vertices.
struct CollapsingPatch {
  struct Vertex {
    Eigen::Vector3d position;
    Quadric quadric;  ///< about `position`, lengths times `CollapsingPatch::scale`
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<std::int32_t, 3>> faces;
  std::vector<std::uint8_t> fixed;  ///< per vertex, 1 = stays: has faces outside the patch
  double scale = 1;                 ///< brings edges to a length about 1
};

struct CollapseOptions {
  int target_vertices = 0;
  int threads = 1;
};

/// Collapses edges, cheapest first, until the target is met or no edge may go. Each pass costs all
/// edges, then takes them in the order of cost and locks the two ends of each that it collapses.
/// Returns, per vertex of the patch as given, the vertex of the patch as left.
/// `between_passes` is called with the number of vertices left.
std::vector<std::int32_t> collapse_edges(CollapsingPatch& patch, const CollapseOptions& options,
                                         const std::function<void(std::size_t)>& between_passes);

}  // namespace curveskel
