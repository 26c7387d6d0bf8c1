// One component of a surface on its own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/topology.hpp>
#include "skeleton/pipeline/stages.hpp"
#include "skeleton/pipeline/try_loop.hpp"

namespace curveskel {

/// One component of many.
struct Part {
  const Component& component;
  int number;  ///< in the order of `topology`
  int genus;
  WorkingSize size;
  double extent = 1;  ///< of the whole's
};

/// The result of one component.
struct ComponentResult {
  Shared<CurveSkeleton> skeleton;  ///< node_of_vertex by the component's own vertices
  Shared<SurfaceTree> tree;        ///< in the model's frame
  ComponentRecord record;
  std::vector<StageTime> times;     ///< of the stages that ran
  std::vector<std::string> reused;  ///< the other ones, maybe repeatedly
  std::vector<int> tries;           ///< numbers of those that led to it
  bool has_all_vertices = false;    ///< its curve is the one of `with_all_vertices`
};

/// A component's result as a later try takes it over, which has not made it.
[[nodiscard]] ComponentResult taken_over(const ComponentResult& made);

/// The components with their working sizes. Refers to `whole`.
[[nodiscard]] std::vector<Part> parts_of(const Parts& whole, const ExtractOptions& options);

/// From the component to its skeleton in the model's frame; so are the monitor's frames. Takes what
/// it can from `kept` and leaves there what it made; without it, nothing outlives its use. The
/// tries of its cut are part of try `part_of`. If the component was coarsened and no cycles go
/// round all of its handles then, it is made from all its vertices, unless they are too many.
/// Throws Error(Fault::solver) when it cannot be contracted, Cancelled on a stop.
[[nodiscard]] ComponentResult component_result(const Part& part, const ExtractOptions& options,
                                               const Monitor& monitor, ComponentStages* kept,
                                               TryLog& log, int part_of);

/// The results of components that an earlier try made; empty if none did.
using StandingResults = std::vector<std::optional<ComponentResult>>;

/// All components, but for those whose results stand. Each of the larger ones has all threads to
/// itself; the small ones, of which there may be many, go side by side with one thread each. Trees
/// are there of a single one only. Tries are written down in the components' order.
[[nodiscard]] std::vector<ComponentResult> component_results(
    const Parts& whole, const ExtractOptions& options, const Monitor& monitor,
    std::vector<ComponentStages>* kept, TryLog& log, int part_of, StandingResults standing);

}  // namespace curveskel
