#include <curveskel/evaluate_repaired.hpp>

#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/topology.hpp>
#include "skeleton/pipeline/failing_components.hpp"
#include "skeleton/pipeline/try_loop.hpp"
#include "surface/mesh/crosses_itself.hpp"
#include "surface/repair/cut_handles.hpp"
#include "surface/repair/sound_repaired.hpp"
#include "surface/repair/wrap_components.hpp"

namespace curveskel {
namespace {

/// The narrowest wrap of a component for which its own skeleton holds.
std::optional<WrappedSolid> wrap_that_agrees(const FailingComponent& failing, double gap,
                                             const WrapBudget& budget,
                                             const CertificateOptions& options,
                                             const Monitor& monitor) {
  for (const double one : wrap_gaps) {
    std::optional<WrappedSolid> agreeing;
    const auto try_to = [&] {
      auto wrapped = wrap_solid(failing.surface, gap > 0 ? gap : one, budget, monitor);
      if (wrapped && wrapped->followed >= wrap_followed_needed &&
          evaluate(wrapped->surface, failing.skeleton, options, monitor).correct()) {
        agreeing = std::move(wrapped);
      }
    };
    const bool failed = failure_of(try_to).has_value();  // too large to be wrapped
    if (agreeing && !failed) return agreeing;
    if (gap > 0) break;
  }
  return std::nullopt;
}

/// The component without its small handles, if there are any and its own skeleton holds then.
std::optional<CutSurface> cut_that_agrees(const FailingComponent& failing,
                                          const CertificateOptions& options,
                                          const Monitor& monitor) {
  if (failing.genus == 0) return std::nullopt;
  CutSurface cut = without_small_handles(failing.surface, monitor.stop);
  if (cut.handles_cut == 0) return std::nullopt;
  if (!evaluate(cut.surface, failing.skeleton, options, monitor).correct()) return std::nullopt;
  return cut;
}

}  // namespace

RepairedEvaluation evaluate_repaired(const RepairedSurface& repaired,
                                     const RepairOptions& as_repaired,
                                     const CurveSkeleton& skeleton,
                                     const CertificateOptions& options, const Monitor& monitor) {
  require_valid(as_repaired);
  require_valid(options);
  require_sound(repaired, "evaluate_repaired");
  const Surface& surface = repaired.surface;
  require_closed_manifold(surface, "evaluate_repaired", options.threads);
  const Topology counted = topology(surface);
  const SurfaceTree tree(surface, options.threads);
  const double diagonal = bounding_box_diagonal(surface.positions);
  const CertifiedSurface given{surface, tree, diagonal, counted.components(),
                               counted.total_genus()};
  RepairedEvaluation result{evaluate(given, skeleton, options, monitor), std::nullopt};
  result.certificate.wrap_followed = repaired.repairs.wrap_followed;
  if (result.certificate.correct() || as_repaired.wrap != Wrapping::needed) return result;

  std::vector<ComponentCut> cuts;
  std::vector<ComponentWrap> wraps;
  const auto owners = component_by_place(skeleton, split_components(surface, counted));
  const auto all_failing =
      failing_components(surface, counted, skeleton, owners, options, false, monitor);
  if (all_failing.empty()) return result;
  const double gap = as_repaired.wrap_gap;
  const WrapBudget budget = gap > 0 ? WrapBudget() : budget_for_one(all_failing.size());
  for (const FailingComponent& failing : all_failing) {
    if (!crosses_itself(failing.surface)) continue;
    if (auto cut = cut_that_agrees(failing, options, monitor)) {
      cuts.push_back({failing.number, std::move(*cut)});
    } else if (auto wrap = wrap_that_agrees(failing, gap, budget, options, monitor)) {
      wraps.push_back({failing.number, std::move(*wrap)});
    }
  }
  if (cuts.empty() && wraps.empty()) return result;
  RepairedSurface left = cuts.empty() ? repaired : with_handles_cut(repaired, cuts, monitor);
  result.repaired_again = wraps.empty() ? std::move(left) : with_wraps(left, wraps, monitor);
  result.certificate = evaluate(result.repaired_again->surface, skeleton, options, monitor);
  result.certificate.wrap_followed = result.repaired_again->repairs.wrap_followed;
  return result;
}

}  // namespace curveskel
