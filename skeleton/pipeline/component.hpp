// One component of a surface on its own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/topology.hpp>
#include "skeleton/pipeline/stages.hpp"

namespace curveskel {

/// One component of many.
struct Part {
  const Component& component;
  int number;  ///< in the order of `topology`
  int genus;
  WorkingSize size;
};

/// The result of one component.
struct ComponentResult {
  Shared<CurveSkeleton> skeleton;   ///< node_of_vertex by the component's own vertices
  std::optional<SurfaceTree> tree;  ///< in the model's frame
  ComponentRecord record;
  std::vector<StageTime> times;     ///< of the stages that ran
  std::vector<std::string> reused;  ///< the other ones, maybe repeatedly
};

/// From the component to its skeleton in the model's frame; so are the monitor's frames. Takes what
/// it can from `kept` and leaves there what it made; without it, nothing outlives its use.
/// Throws Error(Fault::solver) when it cannot be contracted, Cancelled on a stop.
[[nodiscard]] ComponentResult component_result(const Part& part, const ExtractOptions& options,
                                               const Monitor& monitor, ComponentStages* kept);

/// All components. Each of the larger ones has all threads to itself; the small ones, of which
/// there may be many, go side by side with one thread each. Trees are there of a single one only.
[[nodiscard]] std::vector<ComponentResult> component_results(const Parts& whole,
                                                             const ExtractOptions& options,
                                                             const Monitor& monitor,
                                                             std::vector<ComponentStages>* kept);

}  // namespace curveskel
