// The steps of the embedding, as tables: their names, their order, and when they are repeated.
#pragma once

#include <span>
#include <string_view>

#include <curveskel/advanced/step_clock.hpp>
#include <curveskel/monitor.hpp>
#include "skeleton/embed/setting.hpp"
#include "skeleton/embed/skeleton_graph.hpp"

namespace curveskel {

/// One change of the graph, known by its name to reports and to the viewer.
struct EmbedStep {
  std::string_view name;
  /// Returns true if the steps of `then` are to follow.
  bool (*apply)(SkeletonGraph& graph, const Setting& setting);
  /// Arcs that the step leads off their handle get their points back.
  bool guarded = false;
  std::span<const EmbedStep> then{};
};

/// Steps in their order.
struct EmbedPhase {
  std::span<const EmbedStep> steps;
  bool until_no_spur = false;  ///< spurs are pruned after the last step; if there were any, again
  double done = 0;             ///< share of the embedding that is done then, for progress
};

/// Within the working surface, whose tree is quick to ask: all that takes many rays. The graph that
/// goes in is empty.
[[nodiscard]] std::span<const EmbedPhase> phases_on_working_surface();

/// Within the full surface: keeps the curve inside, smooths, prunes spurs.
[[nodiscard]] std::span<const EmbedPhase> phases_on_full_surface();

/// Runs all steps, each timed under its name. Throws Cancelled if a stop was requested.
void run_phases(std::span<const EmbedPhase> phases, SkeletonGraph& graph, const Setting& setting,
                StepClock& clock, const Monitor& monitor);

}  // namespace curveskel
