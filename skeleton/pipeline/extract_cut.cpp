#include "skeleton/pipeline/extract_cut.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
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

/// A component without its small handles, and all that is extracted from it.
struct CutAttempt {
  CutSurface cut;
  Assembled made;
};

CutAttempt attempt(const FailingComponent& failing, const ExtractOptions& options,
                   const Plan<CutAttempt>::Room& room) {
  CutSurface cut = without_small_handles(failing.surface, room.monitor.stop);
  if (cut.handles_cut == 0) throw GaveUp("no handle of the component is small");
  Assembled made = extract_once(cut.surface, options, room.monitor, nullptr, room.log, room.number);
  return {std::move(cut), std::move(made)};
}

/// If its certificate holds.
std::optional<CutAttempt> cut_that_holds(const FailingComponent& failing,
                                         const ExtractOptions& options,
                                         const Plan<Extracted>::Room& room) {
  const auto why = [](const auto&) -> std::optional<std::string> {
    return "the component's certificate failed; handles with loops of up to " +
           share_of_extent(small_handle) + " of its extent are cut";
  };
  const std::vector<Plan<CutAttempt>> plans{
      {try_handles_cut, why,
       [&](const Plan<CutAttempt>::Room& inner) { return attempt(failing, options, inner); }}};
  const auto certificate = [](const CutAttempt& one) { return one.made.extraction.certificate; };
  return carry_out(
             plans, {failing.number, room.number},
             [&](const CutAttempt& one, const CutAttempt* /*best*/) {
               return certificate(one).correct();
             },
             [&](const CutAttempt& one) { return in_brief(certificate(one)); }, room.monitor,
             room.log)
      .best;
}

/// Throws GaveUp if one of what is left fails beside the other components.
Assembled extracted_beside(const RepairedSurface& left, const std::vector<ComponentCut>& cuts,
                           StandingResults standing, const ExtractOptions& options,
                           const Plan<Extracted>::Room& room) {
  ExtractOptions its = options;
  its.rims = left.rims;
  Assembled whole = extract_once(left.surface, its, room.monitor, nullptr, room.log, room.number,
                                 std::move(standing));
  const auto failing =
      failing_of(left.surface, whole.extraction, options.certificate, false, room.monitor);
  const bool fails_again = std::any_of(cuts.begin(), cuts.end(), [&](const ComponentCut& cut) {
    return std::any_of(failing.begin(), failing.end(),
                       [&](const auto& one) { return one.number == cut.component; });
  });
  if (fails_again) {
    throw GaveUp("what is left fails beside the other components: " +
                 failures(whole.extraction.certificate, options.certificate));
  }
  return whole;
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
  // Extracted alone, it is the whole.
  const bool is_single = failed.components.size() == 1 && repaired.rims.empty();
  std::optional<Assembled> alone;
  double longest = 0;
  std::vector<ComponentCut> cuts;
  StandingResults standing;
  for (const ComponentResult& one : failed.components) standing.emplace_back(taken_over(one));
  const auto all_failing =
      failing_of(repaired.surface, failed.found.extraction, judging, false, silent);
  for (const FailingComponent& one : all_failing) {
    if (one.genus == 0) continue;
    const double share = double(one.surface.positions.rows()) / vertices;
    auto left = cut_that_holds(one, options_for_one(options, share), room);
    if (!left) continue;
    standing[idx(one.number)].reset();
    if (is_single) alone = std::move(left->made);
    longest = std::max(longest, small_handle * bounding_box_diagonal(one.surface.positions));
    cuts.push_back({one.number, std::move(left->cut)});
  }
  if (cuts.empty()) throw GaveUp("without small handles no certificate holds either");
  RepairedSurface left = with_handles_cut(repaired, cuts, silent);
  Assembled whole =
      alone ? std::move(*alone) : extracted_beside(left, cuts, std::move(standing), options, room);
  const std::int64_t count = left.repairs.handles_cut;
  const std::string note =
      "the certificate failed (" + failures(failed.found.extraction.certificate, judging) +
      "), so " + std::to_string(count) +
      (count == 1 ? " small handle was" : " small handles were") +
      " cut, and the skeleton extracted again; to evaluate it, use --least-handle " +
      share_of_extent(longest / bounding_box_diagonal(repaired.surface.positions));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  whole.extraction.times = {{"second try", taken.count()}};
  return {RepairedExtraction{std::move(whole.extraction), std::move(left)}, note,
          std::move(whole.parts), std::move(whole.components)};
}

std::optional<std::string> hint_at_small_handles(const Surface& surface, int genus,
                                                 const std::stop_token& stop) {
  constexpr int many = 8;  // with fewer a look at the skeleton tells
  if (genus < many) return std::nullopt;
  const CutSurface cut = without_small_handles(surface, stop);
  const double diagonal = bounding_box_diagonal(surface.positions);
  if (2 * cut.handles_cut <= genus) return std::nullopt;
  return std::to_string(cut.handles_cut) + " of the " + std::to_string(genus) +
         " handles are small, with loops of up to " + share_of_extent(cut.longest_loop / diagonal) +
         " D; if they are noise, --least-handle " + share_of_extent(small_handle) + " cuts them";
}

}  // namespace curveskel
