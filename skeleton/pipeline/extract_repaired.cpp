#include <curveskel/extract_repaired.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/certificate.hpp>
#include <curveskel/topology.hpp>
#include "skeleton/pipeline/failing_components.hpp"
#include "surface/repair/wrap_components.hpp"
#include "surface/repair/wrap_solid.hpp"

namespace curveskel {
namespace {

/// The best wrap so far, and the certificate of its skeleton.
struct Attempt {
  WrappedSolid wrap;
  Certificate certificate;
};

/// The component's wrap with this wrap gap, if its own skeleton is certified.
std::optional<Attempt> attempt(const Surface& component, double opening,
                               const ExtractOptions& options, const Monitor& monitor) {
  try {
    auto wrapped = wrap_solid(component, opening, monitor);
    if (!wrapped) return std::nullopt;
    const Certificate found = extract(wrapped->surface, options, monitor).certificate;
    if (found.holds()) return Attempt{std::move(*wrapped), found};
  } catch (const Error&) {           // too large to be wrapped, or too thin to be contracted
  } catch (const std::bad_alloc&) {  // nobody knew
  }
  return std::nullopt;
}

/// True if the first has the genus and the second has not, or else explains more of its surface: a
/// wrap that goes round every spike of noise is mostly spikes.
bool better(const Certificate& wider, const Certificate& narrower, int genus) {
  if ((wider.genus == genus) != (narrower.genus == genus)) return wider.genus == genus;
  constexpr double clearly = 0.05;  // of the vertices
  return wider.coverage > narrower.coverage + clearly;
}

/// From narrow to wide the best of those whose certificate holds.
std::optional<WrappedSolid> best_wrap(const FailingComponent& failing, double opening,
                                      const ExtractOptions& options, const Monitor& monitor) {
  std::optional<Attempt> best;
  for (const double one : wrap_openings) {
    auto found = attempt(failing.surface, opening > 0 ? opening : one, options, monitor);
    if (found && (!best || better(found->certificate, best->certificate, failing.genus))) {
      best = std::move(found);
    }
    if (opening > 0) break;
  }
  if (!best) return std::nullopt;
  return std::move(best->wrap);
}

/// Options with which one component alone is extracted as it will be among the others.
ExtractOptions for_one(const ExtractOptions& options, double share_of_vertices) {
  ExtractOptions one = options;
  one.openings.clear();
  one.fair_if_outside = one.all_vertices_if_failed = false;
  if (options.resolution > 0) {
    one.resolution =
        std::max(1, static_cast<int>(std::lround(options.resolution * share_of_vertices)));
  }
  return one;
}

/// For each component that fails the best of its wraps, where one has a certificate that holds.
std::vector<ComponentWrap> wraps_of(const std::vector<FailingComponent>& failing, double opening,
                                    Eigen::Index vertices, const ExtractOptions& options,
                                    const Monitor& monitor) {
  std::vector<ComponentWrap> wraps;
  for (const FailingComponent& one : failing) {
    const double share = double(one.surface.positions.rows()) / double(vertices);
    auto wrap = best_wrap(one, opening, for_one(options, share), monitor);
    if (wrap) wraps.push_back({one.number, std::move(*wrap)});
  }
  return wraps;
}

/// Says which of the failing components were wrapped.
std::string which_were(std::size_t wrapped, std::size_t failing) {
  if (wrapped == failing) return "what it fails for was wrapped";
  return std::to_string(wrapped) + " of the " + std::to_string(failing) +
         " components that it fails for were wrapped (no wrap of the others has one that holds)";
}

/// From wraps of the components that fail, if any helps.
std::optional<RepairedExtraction> extracted_from_wraps(const RepairedSurface& repaired,
                                                       const RepairOptions& as_repaired,
                                                       const Extraction& failed,
                                                       const ExtractOptions& options,
                                                       const Monitor& monitor) {
  Monitor silent = monitor;  // a try that comes to nothing is not mentioned
  silent.note = nullptr;
  const Topology counted = topology(repaired.surface);
  const auto failing =
      failing_components(repaired.surface, counted, failed.skeleton,
                         component_by_map(failed.skeleton, counted), options.certificate, silent);
  const auto wraps = wraps_of(failing, as_repaired.wrap_opening, repaired.surface.positions.rows(),
                              options, silent);
  if (wraps.empty()) return std::nullopt;
  auto wrapped = with_wraps(repaired, wraps, silent);
  ExtractOptions from_wraps = options;
  from_wraps.openings = wrapped.openings;
  from_wraps.fair_if_outside = from_wraps.all_vertices_if_failed = false;
  RepairedExtraction found{extract(wrapped.surface, from_wraps, silent), std::move(wrapped)};
  const auto rank = [](const Certificate& one) {
    return std::pair(one.topology_correct(), one.inside_enough);
  };
  if (rank(found.extraction.certificate) < rank(failed.certificate)) return std::nullopt;
  monitor.say("the certificate failed (" + failures(failed.certificate, options.certificate) +
              "), so " + which_were(wraps.size(), failing.size()) +
              ", and the skeleton extracted again");
  return found;
}

RepairedExtraction wrapped_if_failed(const RepairedSurface& repaired,
                                     const RepairOptions& as_repaired, Extraction extraction,
                                     const ExtractOptions& options, const Monitor& monitor) {
  if (extraction.certificate.holds() || as_repaired.wrap != Wrapping::needed) {
    return {std::move(extraction), std::nullopt};
  }
  const auto start = std::chrono::steady_clock::now();
  auto found = extracted_from_wraps(repaired, as_repaired, extraction, options, monitor);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  extraction.times.push_back({"wrap", taken.count()});
  if (!found) return {std::move(extraction), std::nullopt};
  found->extraction.times = std::move(extraction.times);
  return std::move(*found);
}

ExtractOptions with_openings(ExtractOptions options, const RepairedSurface& repaired) {
  options.openings = repaired.openings;
  return options;
}

}  // namespace

RepairedExtraction extract_repaired(const RepairedSurface& repaired,
                                    const RepairOptions& as_repaired, const ExtractOptions& options,
                                    const Monitor& monitor) {
  return wrapped_if_failed(repaired, as_repaired,
                           extract(repaired.surface, with_openings(options, repaired), monitor),
                           options, monitor);
}

RepairedExtraction extract_repaired(const RepairedSurface& repaired,
                                    const RepairOptions& as_repaired, const ExtractOptions& options,
                                    const Monitor& monitor, ExtractionCache& cache) {
  return wrapped_if_failed(
      repaired, as_repaired,
      extract(repaired.surface, with_openings(options, repaired), monitor, cache), options,
      monitor);
}

}  // namespace curveskel
