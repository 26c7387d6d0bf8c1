// One component of a surface on its own.
#pragma once

#include <optional>
#include <vector>

#include "skeleton/extract.hpp"
#include "surface/topology.hpp"
#include "surface/tree.hpp"

namespace curveskel {

/// How many working vertices a component may have.
struct WorkingSize {
  int least = 0;
  int most = 0;
};

/// What one component adds to the extraction.
struct Contribution {
  CurveSkeleton skeleton;           ///< node_of_vertex by the component's own vertices
  std::optional<SurfaceTree> tree;  ///< in the model's frame
  ComponentRecord record;
  std::vector<StageTime> times;
};

/// From the component to its skeleton in the model's frame.
/// Throws Error(Fault::solver) when it cannot be contracted, Cancelled on a stop.
[[nodiscard]] Contribution contribution_of(const Component& part, int genus,
                                           const WorkingSize& size, const ExtractOptions& options,
                                           const Monitor& monitor);

}  // namespace curveskel
