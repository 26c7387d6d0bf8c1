// The surface while it contracts: connectivity that shrinks, positions, and values at the vertices.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>
#include "contraction/flow/collapsible_mesh.hpp"

namespace curveskel {

/// Area and signed volume, in the units of the positions.
struct Extent {
  double area = 0;
  double volume = 0;
};

/// Neither area nor |volume| is larger than the limit's.
[[nodiscard]] bool within(const Extent& extent, const Extent& limit);

struct ContractingSurface {
  CollapsibleMesh mesh;
  Positions positions;
  Positions centres;              ///< of the inscribed balls; no rows when there are none
  Eigen::VectorXd initial_areas;  ///< barycentric, at the start; a merged vertex has the sum
  std::vector<int> origin;        ///< the input vertex that each vertex began as
  std::vector<int> merged_into;   ///< per input vertex: the one it was merged into, or itself

  /// Precondition: closed, oriented, no isolated vertices.
  ContractingSurface(const Surface& surface, const Positions& ball_centres);

  [[nodiscard]] Extent extent(const Positions& at) const;
  [[nodiscard]] Positions volume_gradient(const Positions& at) const;
  [[nodiscard]] Eigen::VectorXd vertex_areas() const;
  [[nodiscard]] Eigen::VectorXi vertex_of_input() const;

  /// Merges edges shorter than `length`, shortest first, wherever the topology allows it and
  /// neither area nor |volume| of the whole rises above `limit`. A merged vertex lies at the mean
  /// of its parts weighted by their initial areas, and so does its centre. Returns the extent.
  Extent collapse_short_edges(double length, Extent now, const Extent& limit,
                              const Monitor& monitor, double progress);
};

}  // namespace curveskel
