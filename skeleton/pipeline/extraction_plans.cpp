#include "skeleton/pipeline/extraction_plans.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "skeleton/pipeline/all_vertices.hpp"
#include "skeleton/pipeline/extract_again.hpp"
#include "surface/mesh/crosses_itself.hpp"
#include "surface/mesh/flat_edges.hpp"

namespace curveskel {
namespace {

using SoFar = Plan<Extracted>::SoFar;
using Room = Plan<Extracted>::Room;

/// Gives another try what neither fairing nor the resolution touches.
void share_beginning(const SurfaceStages& from, SurfaceStages& to) {
  to.parts = from.parts;
  to.tree = from.tree;
  to.components.resize(from.components.size());
  for (std::size_t c = 0; c < from.components.size(); ++c) {
    to.components[c].canonical = from.components[c].canonical;
    to.components[c].tree = from.components[c].tree;
  }
}

bool was_coarsened(const ComponentRecord& one) { return one.working_vertices < one.vertices; }

/// "it was extracted again", or how many of the components were in that try.
std::string again(const Extracted& made, int number) {
  const std::size_t all = made.components.size();
  if (all == 1) return "it was extracted again";
  const auto anew = std::count_if(
      made.components.begin(), made.components.end(),
      [&](const ComponentResult& one) { return !one.tries.empty() && one.tries.front() > number; });
  return std::to_string(anew) + " of the " + std::to_string(all) + " components " +
         (anew == 1 ? "was" : "were") + " extracted again";
}

/// A wrap is only made of what fails, and comes to nothing unless it holds there.
bool takes(const Extracted& other, const Extracted* best) {
  if (best == nullptr) return true;
  const Certificate& a = other.found.extraction.certificate;
  const Certificate& b = best->found.extraction.certificate;
  if (other.found.repaired_again) {
    return std::pair(a.topology_correct(), a.inside_enough) >=
           std::pair(b.topology_correct(), b.inside_enough);
  }
  return better_than(a, b);
}

/// Of all tries that led to something, whatever was kept.
struct Spent {
  std::vector<StageTime> times;
  std::vector<std::string> reused;

  void add(const Extraction& one) {
    times.insert(times.end(), one.times.begin(), one.times.end());
    reused.insert(reused.end(), one.reused.begin(), one.reused.end());
  }
};

Plan<Extracted> as_asked(const Surface& surface, const ExtractOptions& options,
                         ExtractionCache::Implementation* kept) {
  return {try_as_asked, [](const SoFar&) { return std::string(); },
          [&surface, &options, kept](const Room& room) {
            SurfaceStages* const stages = kept != nullptr ? &kept->as_asked : nullptr;
            Assembled whole =
                extract_once(surface, options, room.monitor, stages, room.log, room.number);
            return Extracted{{std::move(whole.extraction), {}},
                             {},
                             std::move(whole.parts),
                             std::move(whole.components)};
          }};
}

/// Noise leaves next to no edge flat, so a surface with this many has none to be faired off.
bool may_be_noisy(const Surface& surface) {
  constexpr double flat_where_sides_are_plane = 0.25;
  return share_of_flat_edges(surface) < flat_where_sides_are_plane;
}

/// Noise as thick as the limbs turns them inside out here and there; without it the curve has a way
/// through.
Plan<Extracted> faired(const Surface& surface, const ExtractOptions& options,
                       ExtractionCache::Implementation* kept) {
  const auto why = [&surface, &options](const SoFar& so_far) -> std::optional<std::string> {
    if (!so_far.best || options.fairing || !options.fair_if_outside) return std::nullopt;
    const Certificate& found = so_far.best->found.extraction.certificate;
    if (found.inside_enough) return std::nullopt;
    const bool single = so_far.best->components.size() == 1;
    if (single && (!found.topology_correct() || !may_be_noisy(surface))) return std::nullopt;
    return failures(found, options.certificate);
  };
  const auto make = [&surface, &options, kept](const Room& room) {
    ExtractOptions gentler = options;
    gentler.fairing = true;
    gentler.fair.iterations = 30;
    if (kept != nullptr) share_beginning(kept->as_asked, kept->faired);
    const AnotherWay way{try_faired, gentler,
                         [](const ComponentResult&, const Surface& itself, const Certificate& own) {
                           return own.topology_correct() && !own.inside_enough &&
                                  may_be_noisy(itself);
                         }};
    Extracted made = extract_again(surface, way, kept != nullptr ? &kept->faired : nullptr, room);
    made.note = "the curve left the surface, so " + again(made, room.number) +
                " from the faired surface (30 iterations)";
    return made;
  };
  return {try_faired, why, make};
}

/// Limbs as thin as the coarsened triangles are long have other handles there, and no way inside.
/// A curve that has no way inside all vertices' surface either goes just below it: the last thing
/// tried, as noise that fairing takes off would have its curve below each of its spikes.
Plan<Extracted> from_all_vertices(const Surface& surface, const ExtractOptions& options,
                                  ExtractionCache::Implementation* kept) {
  const bool embeds = options.embed.method == EmbedMethod::own;  // else nothing keeps it inside
  const auto may_help = [embeds](const ComponentResult& one, const Certificate& found) {
    const bool leaves = embeds && !found.inside_enough;
    const bool is_wrong = leaves || !found.topology_correct();
    return is_wrong && !one.has_all_vertices && is_quick_with_all(one.record.vertices) &&
           (embeds || was_coarsened(one.record));
  };
  // A surface that crosses itself has no inside that all its handles bound.
  const auto has_hope = [](const ComponentRecord& one, const Surface& own,
                           const Certificate& found) {
    const bool handles_fail = found.components_right() && !found.topology_correct();
    return !handles_fail || was_coarsened(one) || !crosses_itself(own);
  };
  const auto why = [&surface, &options, may_help,
                    has_hope](const SoFar& so_far) -> std::optional<std::string> {
    if (!so_far.best || !options.all_vertices_if_failed) return std::nullopt;
    const Certificate& found = so_far.best->found.extraction.certificate;
    const std::vector<ComponentResult>& components = so_far.best->components;
    const bool single = components.size() == 1;
    const bool helps =
        std::any_of(components.begin(), components.end(), [&](const ComponentResult& one) {
          return may_help(one, found) && (!single || has_hope(one.record, surface, found));
        });
    if (!helps) return std::nullopt;
    return failures(found, options.certificate);
  };
  const auto make = [&surface, &options, kept, may_help, has_hope](const Room& room) {
    const ExtractOptions finest = with_all_vertices(options);
    if (kept != nullptr) share_beginning(kept->as_asked, kept->all_vertices);
    const AnotherWay way{
        try_all_vertices, finest,
        [&](const ComponentResult& one, const Surface& itself, const Certificate& own) {
          return may_help(one, own) && has_hope(one.record, itself, own);
        }};
    Extracted made =
        extract_again(surface, way, kept != nullptr ? &kept->all_vertices : nullptr, room);
    made.note = "the certificate failed, so " + again(made, room.number) + " from all vertices";
    return made;
  };
  return {try_all_vertices, why, make};
}

}  // namespace

std::vector<Plan<Extracted>> extraction_plans(const Surface& surface, const ExtractOptions& options,
                                              ExtractionCache::Implementation* kept) {
  return {as_asked(surface, options, kept), faired(surface, options, kept),
          from_all_vertices(surface, options, kept)};
}

RepairedExtraction carry_out_plans(const std::vector<Plan<Extracted>>& plans,
                                   const Monitor& monitor) {
  Spent spent;
  std::vector<Plan<Extracted>> counted = plans;
  for (Plan<Extracted>& plan : counted) {
    plan.make = [&spent, make = plan.make](const Room& room) {
      Extracted made = make(room);
      spent.add(made.found.extraction);
      return made;
    };
  }
  TryLog log;
  Extracted best = best_of(carry_out(
      counted, {}, takes,
      [](const Extracted& one) { return in_brief(one.found.extraction.certificate); }, monitor,
      log));
  for (const Try& one : log.tries) {
    if (one.part_of >= 0 || one.outcome != Outcome::failed) continue;
    spent.times.push_back({one.name == try_wrapped ? "wrap" : "second try", one.seconds});
  }
  Extraction& result = best.found.extraction;
  result.reused = best.found.repaired_again ? std::vector<std::string>()
                                            : only_reused(spent.reused, spent.times);
  result.times = std::move(spent.times);
  // A component that a later try took over is part of the result, its try of the whole is not.
  for (const ComponentResult& one : best.components) {
    for (const int number : one.tries) log[number].outcome = Outcome::kept;
  }
  result.history = std::move(log.tries);
  if (!best.note.empty()) monitor.say(best.note);
  return std::move(best.found);
}

ExtractOptions options_for_one(const ExtractOptions& options, double share_of_vertices) {
  ExtractOptions one = options;
  one.rims.clear();
  if (options.resolution > 0) {
    one.resolution =
        std::max(1, static_cast<int>(std::lround(options.resolution * share_of_vertices)));
  }
  return one;
}

}  // namespace curveskel
