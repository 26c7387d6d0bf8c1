#include <curveskel/extract_repaired.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/topology.hpp>
#include "skeleton/graph/sound_skeleton.hpp"
#include "skeleton/pipeline/extract_cut.hpp"
#include "skeleton/pipeline/extraction_plans.hpp"
#include "skeleton/pipeline/failing_components.hpp"
#include "skeleton/pipeline/wrap_losses.hpp"
#include "skeleton/pipeline/wraps_hold.hpp"
#include "surface/mesh/crosses_itself.hpp"
#include "surface/repair/sound_repaired.hpp"
#include "surface/repair/wrap_components.hpp"
#include "surface/repair/wrap_solid.hpp"

namespace curveskel {
namespace {

/// A wrap of a component, and the certificate of what is extracted from it.
struct Attempt {
  WrappedSolid wrap;
  Certificate certificate;
};

/// True if the first has the genus and the second has not, or else explains more of its surface: a
/// wrap that goes round every spike of noise is mostly spikes.
bool better(const Certificate& wider, const Certificate& narrower, int genus) {
  if ((wider.genus == genus) != (narrower.genus == genus)) return wider.genus == genus;
  constexpr double clearly = 0.05;  // of the vertices
  return wider.coverage > narrower.coverage + clearly;
}

constexpr std::string_view turned_limbs =
    "limbs are inside out, whose faces were turned to agree with their neighbours";

std::string why_wrapped(double gap) {
  std::ostringstream words;
  words.precision(3);
  words << "the component's certificate failed; gaps of up to " << gap
        << " of its extent are wrapped over";
  return words.str();
}

constexpr double least_turned = 0.01;  // of the area of all; see `has_turned_limbs`

/// The widest wrap of a component, none if that encloses nothing, and a budget that knows from it
/// how many vertices narrower ones take.
struct WidestWrap {
  WrapBudget budget;
  std::optional<WrappedSolid> wrap;
};

WidestWrap widest_wrap(const FailingComponent& failing, const WrapBudget& budget,
                       const Monitor& monitor) {
  constexpr double gap = wrap_gaps.back();
  WidestWrap result{budget, std::nullopt};
  try {
    result.wrap = wrap_solid(failing.surface, gap, budget, monitor);
  } catch (const WrapTooLarge&) {  // so is any other
    return result;
  }
  if (result.wrap) {
    result.budget.for_expected = std::max(
        budget.for_expected, vertices_for_expected(result.wrap->surface, failing.surface, gap));
  }
  return result;
}

/// `made`, if there is one, is not made again; it must outlive the plan.
Plan<Attempt> wrap_plan(const FailingComponent& failing, double gap,
                        const std::optional<WrappedSolid>& made, const WrapBudget& budget,
                        const ExtractOptions& options) {
  return {try_wrapped, [gap](const auto&) { return why_wrapped(gap); },
          [&failing, gap, &made, budget, &options](const Plan<Attempt>::Room& room) {
            auto wrapped = made ? made : wrap_solid(failing.surface, gap, budget, room.monitor);
            if (!wrapped) throw GaveUp("the wrap encloses next to nothing");
            const Extraction found = extract_once(wrapped->surface, options, room.monitor, nullptr,
                                                  room.log, room.number)
                                         .extraction;
            // Its own skeleton only tells how good the wrap is.
            for (int n = room.number + 1; n < room.log.next(); ++n) room.log.drop(n);
            if (found.certificate.correct()) {
              const std::string losses =
                  losses_by_wrap(failing, found.skeleton, options.certificate, room.monitor);
              if (!losses.empty()) throw GaveUp(losses);
            }
            return Attempt{std::move(*wrapped), found.certificate};
          }};
}

/// From narrow to wide the best of those whose certificate holds.
std::optional<Attempt> best_wrap(const FailingComponent& failing, double gap,
                                 const WrapBudget& budget, const ExtractOptions& options,
                                 const Plan<Extracted>::Room& room) {
  const WidestWrap widest =
      gap > 0 ? WidestWrap{budget, std::nullopt} : widest_wrap(failing, budget, room.monitor);
  const std::optional<WrappedSolid> not_made;
  std::vector<Plan<Attempt>> plans;
  for (const double one : wrap_gaps) {
    const auto& made = one == wrap_gaps.back() ? widest.wrap : not_made;
    plans.push_back(wrap_plan(failing, gap > 0 ? gap : one, made, widest.budget, options));
    if (gap > 0) break;
  }
  const auto takes = [&](const Attempt& wider, const Attempt* best) {
    return wider.certificate.correct() &&
           (best == nullptr || better(wider.certificate, best->certificate, failing.genus));
  };
  return carry_out(
             plans, {failing.number, room.number}, takes,
             [](const Attempt& one) { return in_brief(one.certificate); }, room.monitor, room.log)
      .best;
}

/// For each component that fails, as it crosses itself, the best of its wraps, if one has a
/// certificate that holds. Of another kind the wrap would only be another shape.
std::vector<ComponentWrap> wraps_of(const std::vector<FailingComponent>& failing, double gap,
                                    Eigen::Index vertices, const ExtractOptions& options,
                                    const Plan<Extracted>::Room& room) {
  std::vector<ComponentWrap> wraps;
  for (const FailingComponent& one : failing) {
    if (!crosses_itself(one.surface)) continue;
    const double share = double(one.surface.positions.rows()) / double(vertices);
    const WrapBudget budget = gap > 0 ? WrapBudget() : budget_for_one(failing.size());
    auto best = best_wrap(one, gap, budget, options_for_one(options, share), room);
    if (best) wraps.push_back({one.number, std::move(best->wrap)});
  }
  return wraps;
}

/// "the certificate failed (...), so what it fails for".
std::string why_again(const Certificate& certificate, const CertificateOptions& options) {
  if (certificate.correct()) return std::string(turned_limbs) + ", so their component";
  return "the certificate failed (" + failures(certificate, options) + "), so what it fails for";
}

/// Which of the failing components were wrapped.
std::string which_were(std::size_t wrapped, std::size_t failing) {
  if (wrapped == failing) return "was wrapped";
  return "was wrapped in " + std::to_string(wrapped) + " of the " + std::to_string(failing) +
         " components (no wrap of the others has a certificate that holds)";
}

/// The results of the components that are not wrapped, as the surface with the wraps numbers them.
StandingResults beside_wraps(const Extracted& before, const std::vector<ComponentWrap>& wraps) {
  StandingResults standing;
  for (const ComponentResult& one : before.components) standing.emplace_back(taken_over(one));
  for (std::size_t k = wraps.size(); k-- > 0;) {
    const auto place = standing.erase(standing.begin() + wraps[k].component);
    standing.insert(place, idx(topology(wraps[k].wrap.surface).components()), std::nullopt);
  }
  return standing;
}

Extracted extracted_from_wraps(const RepairedSurface& repaired, const RepairOptions& as_repaired,
                               const ExtractOptions& options, const Plan<Extracted>::Room& given) {
  const auto start = std::chrono::steady_clock::now();
  Monitor silent = given.monitor;  // what comes to nothing is not said
  silent.note = nullptr;
  const Plan<Extracted>::Room room{given.so_far, silent, given.log, given.number};
  const Extraction& failed = given.so_far.best->found.extraction;
  const auto failing = failing_of(repaired.surface, failed, options.certificate,
                                  repaired.changes.faces_flipped > 0, silent);
  const auto wraps =
      wraps_of(failing, as_repaired.wrap_gap, repaired.surface.positions.rows(), options, room);
  if (wraps.empty()) throw GaveUp("no wrap has a certificate that holds");
  auto wrapped = with_wraps(repaired, wraps, silent);
  ExtractOptions from_wraps = options;
  from_wraps.rims = wrapped.rims;
  Assembled whole = extract_once(wrapped.surface, from_wraps, silent, nullptr, room.log,
                                 room.number, beside_wraps(*given.so_far.best, wraps));
  RepairedExtraction found{std::move(whole.extraction), std::move(wrapped)};
  if (!wraps_hold(found, wraps, options.certificate, silent)) {
    throw GaveUp("the wraps fail beside the other components: " +
                 failures(found.extraction.certificate, options.certificate));
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  found.extraction.times = {{"wrap", taken.count()}};
  return {std::move(found),
          why_again(failed.certificate, options.certificate) + " " +
              which_were(wraps.size(), failing.size()) + ", and the skeleton extracted again",
          std::move(whole.parts), std::move(whole.components)};
}

RepairedExtraction extracted(const RepairedSurface& repaired, const RepairOptions& as_repaired,
                             const ExtractOptions& options, const Monitor& monitor,
                             ExtractionCache::Implementation* kept) {
  require_valid(as_repaired);
  require_sound(repaired, "extract");
  ExtractOptions with_rims = options;
  with_rims.rims = repaired.rims;
  const ExtractOptions its = admitted(repaired.surface, with_rims);
  auto plans = extraction_plans(repaired.surface, its, kept);
  const auto why = [&](const Plan<Extracted>::SoFar& so_far) -> std::optional<std::string> {
    if (!so_far.best || as_repaired.wrap != Wrapping::needed) return std::nullopt;
    const Certificate& found = so_far.best->found.extraction.certificate;
    if (!found.correct()) return failures(found, its.certificate);
    if (repaired.changes.faces_flipped == 0) return std::nullopt;
    const SurfaceTree tree(repaired.surface, its.threads);
    if (turned_share(repaired.surface, tree) < least_turned) return std::nullopt;
    return std::string(turned_limbs);
  };
  const auto why_cut = [&](const Plan<Extracted>::SoFar& so_far) -> std::optional<std::string> {
    if (!so_far.best || as_repaired.wrap != Wrapping::needed) return std::nullopt;
    const Certificate& found = so_far.best->found.extraction.certificate;
    if (found.correct() || found.genus == 0) return std::nullopt;
    return failures(found, its.certificate);
  };
  plans.push_back({try_handles_cut, why_cut, [&](const Plan<Extracted>::Room& room) {
                     return extracted_without_small_handles(repaired, its, room);
                   }});
  plans.push_back({try_wrapped, why, [&](const Plan<Extracted>::Room& room) {
                     const auto& left = room.so_far.best->found.repaired_again;
                     return extracted_from_wraps(left ? *left : repaired, as_repaired, its, room);
                   }});
  RepairedExtraction best = carry_out_plans(plans, monitor);
  const Repairs& repairs = best.repaired_again ? best.repaired_again->repairs : repaired.repairs;
  best.extraction.certificate.wrap_followed = repairs.wrap_followed;
  if (as_repaired.least_handle <= 0 && !best.repaired_again) {
    const int genus = best.extraction.certificate.genus;
    const auto hint = hint_at_small_handles(repaired.surface, genus, monitor.stop);
    if (hint) monitor.say(*hint);
  }
  return best;
}

}  // namespace

bool wraps_hold(const RepairedExtraction& found, const std::vector<ComponentWrap>& wraps,
                const CertificateOptions& options, const Monitor& monitor) {
  if (found.extraction.certificate.correct()) return true;
  const auto failing =
      failing_of(found.repaired_again->surface, found.extraction, options, false, monitor);
  int added = 0;  // components so far that wraps have beyond one each
  for (const ComponentWrap& one : wraps) {
    const int first = one.component + added;
    const int own = topology(one.wrap.surface).components();
    const bool fails = std::any_of(failing.begin(), failing.end(), [&](const auto& component) {
      return component.number >= first && component.number < first + own;
    });
    if (fails) return false;
    added += own - 1;
  }
  return true;
}

RepairedExtraction extract_repaired(const RepairedSurface& repaired,
                                    const RepairOptions& as_repaired, const ExtractOptions& options,
                                    const Monitor& monitor) {
  return extracted(repaired, as_repaired, options, monitor, nullptr);
}

RepairedExtraction extract_repaired(const RepairedSurface& repaired,
                                    const RepairOptions& as_repaired, const ExtractOptions& options,
                                    const Monitor& monitor, ExtractionCache& cache) {
  ExtractionCache::Implementation& kept = cache.implementation();
  kept.keep_only(repaired.surface);
  return extracted(repaired, as_repaired, options, monitor, &kept);
}

CurveSkeleton on_input_vertices(const RepairedSurface& repaired, CurveSkeleton skeleton) {
  const Eigen::VectorXi of_surface = std::move(skeleton.node_of_vertex);
  require_below(repaired.vertex_of_input, of_surface.size(), "on_input_vertices");
  skeleton.node_of_vertex = repaired.vertex_of_input.unaryExpr(
      [&](int vertex) { return vertex < 0 ? -1 : of_surface[vertex]; });
  return skeleton;
}

}  // namespace curveskel
