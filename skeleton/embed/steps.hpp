// The steps of the embedding, in the order and as often as the tables in steps.cpp say.
#pragma once

#include <curveskel/advanced/step_clock.hpp>
#include <curveskel/monitor.hpp>
#include "skeleton/embed/setting.hpp"
#include "skeleton/embed/skeleton_graph.hpp"

namespace curveskel {

/// Within the working surface, whose tree is quick to ask: all that takes many rays. A convex body
/// gets its axis, any other the limbs of the cut. The graph that goes in is empty. Each step is
/// timed under its name. False if the setting needs all handles and the first course misses some.
/// Throws Cancelled if a stop was requested.
[[nodiscard]] bool embed_in_working_surface(SkeletonGraph& graph, const Setting& setting,
                                            StepClock& clock, const Monitor& monitor);

/// Within the full surface: keeps the curve inside, smooths, prunes spurs. Otherwise the same.
void embed_in_full_surface(SkeletonGraph& graph, const Setting& setting, StepClock& clock,
                           const Monitor& monitor);

}  // namespace curveskel
