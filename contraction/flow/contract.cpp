// O. Au, C. Tai, H. Chu, D. Cohen-Or, T. Lee: Skeleton Extraction by Mesh Contraction, 2008;
// A. Tagliasacchi, I. Alhashim, M. Olson, H. Zhang: Mean Curvature Skeletons, 2012.
#include <curveskel/contract.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include "base/option_ranges.hpp"
#include "contraction/flow/contracting_surface.hpp"
#include "contraction/flow/flow_system.hpp"

namespace curveskel {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int step_halvings = 6;        // of the way to the solution before it is rejected
constexpr double stalled_ratio = 0.99;  // area and volume both above this share ...
constexpr int stalled_iterations = 6;   // ... for so many iterations

/// Model units to the unit box (D = 1) and back, so that weights and limits mean the same at any
/// scale. Scales that are powers of two meet the same rounding, others nearly the same.
struct UnitBox {
  Eigen::RowVector3d centre;
  double diagonal;

  explicit UnitBox(const Positions& positions)
      : centre(0.5 * (positions.colwise().minCoeff() + positions.colwise().maxCoeff())),
        diagonal(bounding_box_diagonal(positions)) {}
  [[nodiscard]] Positions enter(const Positions& p) const {
    return (p.rowwise() - centre) / diagonal;
  }
  [[nodiscard]] Positions leave(const Positions& p) const {
    return (p * diagonal).rowwise() + centre;
  }
};

double mean_edge_length(const ContractingSurface& surface) {
  double sum = 0;
  for (int h = 0; h < surface.mesh.count(); ++h) {
    sum += (surface.positions.row(surface.mesh.from(h)) - surface.positions.row(surface.mesh.to(h)))
               .norm();
  }
  return sum / surface.mesh.count();
}

/// The least motion that brings the volume to `wanted`: Newton steps along its gradient.
Extent correct_volume(const ContractingSurface& surface, Positions& at, double wanted) {
  Extent reached = surface.extent(at);
  for (int k = 0; k < 3; ++k) {
    const Positions gradient = surface.volume_gradient(at);
    const double scale = gradient.squaredNorm();
    if (!(scale > 0)) break;
    at -= (reached.volume - wanted) / scale * gradient;
    reached = surface.extent(at);
  }
  return reached;
}

/// The bound for running sums, so that their rounding cannot make the real extent grow.
Extent slightly_below(const Extent& extent) {
  return {extent.area * (1 - 1e-9), extent.volume * (1 - 1e-9)};
}

bool hardly_shrank(const Extent& now, const Extent& before) {
  return now.area > stalled_ratio * before.area &&
         std::abs(now.volume) > stalled_ratio * std::abs(before.volume);
}

/// Goes as far towards `target` as neither area nor |volume| grows; returns whether it moved. A
/// body that has turned inside out in places has a volume near zero that any step may raise; such
/// a step is mended by the small offset that takes the volume back.
bool go_towards(ContractingSurface& surface, const Positions& target, Extent& now) {
  const Extent limit = slightly_below(now);
  double t = 1;
  for (int k = 0; k <= step_halvings; ++k, t /= 2) {
    Positions there =
        t == 1 ? target : Positions(surface.positions + t * (target - surface.positions));
    Extent reached = surface.extent(there);
    if (reached.area <= limit.area && std::abs(reached.volume) > std::abs(limit.volume)) {
      reached = correct_volume(surface, there, std::copysign(0.9 * limit.volume, reached.volume));
    }
    if (!within(reached, limit)) continue;
    surface.positions = std::move(there);
    now = reached;
    return true;
  }
  return false;
}

void check(const Surface& surface, const Positions& centres, const ContractionOptions& options) {
  require_valid(options);
  require_closed_manifold(surface, "contract", options.threads);
  if (options.flow == Flow::medial && centres.rows() != surface.positions.rows()) {
    throw Error(Fault::input, "the medial flow needs one ball centre per vertex: found " +
                                  std::to_string(centres.rows()) + " for " +
                                  std::to_string(surface.positions.rows()) + " vertices");
  }
  if (!centres.allFinite()) {
    throw Error(Fault::input, "contract: a ball centre is no finite number, needed finite ones");
  }
}

/// A surface whose volume is rounding noise has no inside to shrink.
void check(const Extent& initial) {
  if (std::abs(initial.volume) > 1e-15) return;
  std::ostringstream volume;
  volume << std::abs(initial.volume);
  throw Error(Fault::input, "the surface encloses no volume (" + volume.str() +
                                " D^3, D = the diagonal of its bounding box), needed more than "
                                "1e-15 D^3: thicken it, or remove vertices that lie far away from "
                                "all others");
}

double fraction_done(const Step& step, const ContractionOptions& options) {
  const auto share = [](double ratio, double stop) {
    return stop > 0 && stop < 1 ? std::log(ratio) / std::log(stop) : 0;
  };
  const double done = std::max(share(step.volume_ratio, options.stop_volume_ratio),
                               share(step.area_ratio, options.stop_area_ratio));
  return std::clamp(done, 0.0, 1.0);
}

std::optional<Stop> reason_to_stop(const Step& step, const ContractionOptions& options) {
  if (step.area_ratio < options.stop_area_ratio) return Stop::area;
  const bool small = step.area_ratio < options.small_area_ratio;
  if (small && step.volume_ratio < options.stop_volume_ratio) return Stop::volume;
  return std::nullopt;
}

}  // namespace

void require_valid(const ContractionOptions& options) {
  constexpr OptionRange weight{0, 1e6, true};
  constexpr OptionRange growth{0, 1e3, true};
  constexpr OptionRange edge_lengths{0, 1e3};
  const OptionCheck check("ContractionOptions");
  check.choice("flow", options.flow, flows);
  check.choice("solver", options.solver, solvers);
  check.number("max_iterations", options.max_iterations, iteration_range);
  check.number("contraction_weight", options.contraction_weight, weight);
  check.number("contraction_growth", options.contraction_growth, growth);
  check.number("medial_weight", options.medial_weight, weight);
  check.number("paper_weight", options.paper_weight, weight);
  check.number("attraction_weight", options.attraction_weight, weight);
  check.number("collapse_length", options.collapse_length, edge_lengths);
  check.number("stop_volume_ratio", options.stop_volume_ratio, share_range);
  check.number("stop_area_ratio", options.stop_area_ratio, share_range);
  check.number("small_area_ratio", options.small_area_ratio, share_range);
  check.number("threads", options.threads, thread_range);
}

Contraction contract(const Surface& surface, const Positions& centres,
                     const ContractionOptions& options, const Monitor& monitor) {
  check(surface, centres, options);
  const UnitBox box(surface.positions);
  ContractingSurface state({box.enter(surface.positions), surface.triangles},
                           options.flow == Flow::medial ? box.enter(centres) : Positions(0, 3));
  const Extent initial = state.extent(state.positions);
  check(initial);
  const double short_edge = options.collapse_length * mean_edge_length(state);
  FlowSystem flow(options, initial.area / static_cast<double>(surface.triangles.rows()));

  Contraction result;
  const auto show = [&](const Step& step) {
    if (!monitor.frame) return;
    const Surface shown{box.leave(state.positions), state.mesh.triangles()};
    monitor.frame({"contract", 0, static_cast<int>(result.steps.size()), step.area_ratio,
                   step.volume_ratio, step.residual, shown});
  };
  show({});
  Extent now = initial;
  double progress = 0;
  std::optional<Stop> stop;
  for (int iteration = 0, idle = 0; iteration < options.max_iterations && !stop; ++iteration) {
    const auto begin = Clock::now();
    monitor.report("contract", progress);
    const Solution solution = flow.solve(state, monitor);
    monitor.report("contract", progress);
    const Extent before = now;
    if (!go_towards(state, solution.x, now)) {
      flow.rejected();
      if (++idle == stalled_iterations) stop = Stop::stalled;
      continue;
    }
    state.collapse_short_edges(short_edge, now, slightly_below(before), monitor, progress);
    now = state.extent(state.positions);
    flow.accepted();
    idle = hardly_shrank(now, before) ? idle + 1 : 0;

    Step step;
    step.area_ratio = now.area / initial.area;
    step.volume_ratio = std::abs(now.volume / initial.volume);
    step.residual = solution.residual;
    step.vertices = state.mesh.vertices();
    step.solver_iterations = solution.iterations;
    step.solver = flow.solver();
    step.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    result.steps.push_back(step);
    show(step);
    progress = std::max(progress, fraction_done(step, options));
    stop = reason_to_stop(step, options);
    if (!stop && idle == stalled_iterations) stop = Stop::stalled;
  }
  monitor.report("contract", 1);
  result.stop = stop.value_or(Stop::iterations);
  result.surface = {box.leave(state.positions), state.mesh.triangles()};
  result.vertex_of_input = state.vertex_of_input();
  return result;
}

}  // namespace curveskel
