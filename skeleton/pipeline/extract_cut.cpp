#include "skeleton/pipeline/extract_cut.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include "skeleton/pipeline/failing_components.hpp"
#include "surface/repair/cut_handles.hpp"

namespace curveskel {
namespace {

std::string share_of_extent(double length) {
  std::ostringstream words;
  words.precision(3);
  words << length;
  return words.str();
}

/// What is left of a component, and the certificate of what is extracted from it.
struct CutAttempt {
  CutSurface cut;
  Certificate certificate;
};

Plan<CutAttempt> cut_plan(const FailingComponent& failing, double length,
                          const ExtractOptions& options) {
  const auto why = [length](const auto& so_far) -> std::optional<std::string> {
    if (so_far.best) return std::nullopt;
    return "the component's certificate failed; handles with loops of up to " +
           share_of_extent(length) + " of its extent are cut";
  };
  const auto make = [&failing, length, &options](const Plan<CutAttempt>::Room& room) {
    const double longest = length * bounding_box_diagonal(failing.surface.positions);
    CutSurface cut = cut_handles(failing.surface, longest, room.monitor.stop);
    if (cut.handles_cut == 0) throw GaveUp("the component has no handle as small");
    const Extraction found =
        extract_once(cut.surface, options, room.monitor, nullptr, room.log, room.number).extraction;
    for (int n = room.number + 1; n < room.log.next(); ++n) room.log.drop(n);
    return CutAttempt{std::move(cut), found.certificate};
  };
  return {try_handles_cut, why, make};
}

std::optional<CutSurface> least_cut(const FailingComponent& failing, const ExtractOptions& options,
                                    const Plan<Extracted>::Room& room) {
  std::vector<Plan<CutAttempt>> plans;
  for (const double length : handle_lengths) plans.push_back(cut_plan(failing, length, options));
  auto best =
      carry_out(
          plans, {failing.number, room.number},
          [](const CutAttempt& one, const CutAttempt* /*best*/) {
            return one.certificate.correct();
          },
          [](const CutAttempt& one) { return in_brief(one.certificate); }, room.monitor, room.log)
          .best;
  if (!best) return std::nullopt;
  return std::move(best->cut);
}

}  // namespace

Extracted extracted_without_small_handles(const RepairedSurface& repaired,
                                          const ExtractOptions& options,
                                          const Plan<Extracted>::Room& given) {
  const auto start = std::chrono::steady_clock::now();
  Monitor silent = given.monitor;  // what comes to nothing is not said
  silent.note = nullptr;
  const Plan<Extracted>::Room room{given.so_far, silent, given.log, given.number};
  const Extracted& failed = *given.so_far.best;
  const CertificateOptions& judging = options.certificate;
  const double vertices = double(repaired.surface.positions.rows());
  std::vector<ComponentCut> cuts;
  StandingResults standing;
  for (const ComponentResult& one : failed.components) standing.emplace_back(taken_over(one));
  const auto all_failing =
      failing_of(repaired.surface, failed.found.extraction, judging, false, silent);
  for (const FailingComponent& one : all_failing) {
    if (one.genus == 0) continue;
    const double share = double(one.surface.positions.rows()) / vertices;
    auto cut = least_cut(one, options_for_one(options, share), room);
    if (!cut) continue;
    standing[idx(one.number)].reset();
    cuts.push_back({one.number, std::move(*cut)});
  }
  if (cuts.empty()) throw GaveUp("without small handles no certificate holds either");
  RepairedSurface left = with_handles_cut(repaired, cuts, silent);
  ExtractOptions its = options;
  its.rims = left.rims;
  Assembled whole =
      extract_once(left.surface, its, silent, nullptr, room.log, room.number, std::move(standing));
  const auto still_failing = failing_of(left.surface, whole.extraction, judging, false, silent);
  const bool fails_again = std::any_of(cuts.begin(), cuts.end(), [&](const ComponentCut& cut) {
    return std::any_of(still_failing.begin(), still_failing.end(),
                       [&](const auto& one) { return one.number == cut.component; });
  });
  if (fails_again) {
    throw GaveUp("what is left fails beside the other components: " +
                 failures(whole.extraction.certificate, judging));
  }
  const Repairs& repairs = left.repairs;
  const std::string note = "the certificate failed (" +
                           failures(failed.found.extraction.certificate, judging) + "), so " +
                           std::to_string(repairs.handles_cut) +
                           " small handles were cut, and the skeleton "
                           "extracted again; to evaluate it, use --least-handle " +
                           share_of_extent(repairs.longest_handle_loop);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  whole.extraction.times = {{"second try", taken.count()}};
  return {RepairedExtraction{std::move(whole.extraction), std::move(left)}, note,
          std::move(whole.parts), std::move(whole.components)};
}

}  // namespace curveskel
