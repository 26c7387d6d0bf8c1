#include "skeleton/pipeline/extract_again.hpp"

#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include "skeleton/pipeline/failing_components.hpp"
#include "skeleton/pipeline/notes_of_components.hpp"

namespace curveskel {
namespace {

/// Makes components another way, each in a try that is part of one of the whole.
class OtherTries {
 public:
  OtherTries(const AnotherWay& way, const Parts& parts, SurfaceStages& stages, bool keep,
             const Plan<Extracted>::Room& room, const Monitor& monitor)
      : way_(way),
        all_(parts_of(parts, way.options)),
        stages_(stages),
        keep_(keep),
        room_(room),
        monitor_(monitor) {
    stages_.components.resize(all_.size());
  }

  /// The component's result, none if its try failed.
  std::optional<ComponentResult> make(std::size_t c) {
    const int first = room_.log.next();
    std::optional<ComponentResult> made;
    const auto failure = failure_of([&] {
      made = component_result(all_[c], way_.options, monitor_,
                              keep_ ? &stages_.components[c] : nullptr, room_.log, room_.number);
    });
    if (failure) {
      room_.log.tries.push_back({.name = std::string(way_.name),
                                 .component = static_cast<int>(c),
                                 .part_of = room_.number,
                                 .why = {},
                                 .message = failure->message,
                                 .certificate = {}});
      last_thrown_ = failure->thrown;
      return std::nullopt;
    }
    for (int n = first; n < room_.log.next(); ++n) {
      if (room_.log[n].outcome == Outcome::kept) made->tries.push_back(n);
    }
    return made;
  }

  /// Says of a result that another one stays.
  void drop(const ComponentResult& made) {
    for (const int n : made.tries) room_.log.drop(n);
  }

  [[nodiscard]] std::exception_ptr last_thrown() const { return last_thrown_; }

 private:
  const AnotherWay& way_;
  std::vector<Part> all_;
  SurfaceStages& stages_;
  bool keep_;
  const Plan<Extracted>::Room& room_;
  const Monitor& monitor_;
  std::exception_ptr last_thrown_;
};

}  // namespace

bool better_than(const Certificate& one, const Certificate& other) {
  return std::pair(one.topology_correct(), one.inside_fraction) >
         std::pair(other.topology_correct(), other.inside_fraction);
}

Extracted extract_again(const Surface& surface, const AnotherWay& way, SurfaceStages* kept,
                        const Plan<Extracted>::Room& room) {
  const Extracted& before = *room.so_far.best;
  SurfaceStages passing;
  SurfaceStages& stages = kept != nullptr ? *kept : passing;
  stages.parts.value = before.parts;
  const bool single = before.components.size() == 1;
  const double diagonal = bounding_box_diagonal(surface.positions);
  const auto judged = [&](std::size_t c, const ComponentResult& result) {
    return verdict_alone(before.parts->components[c].surface, before.parts->counted.genus[c],
                         diagonal, *result.skeleton, way.options.certificate, room.monitor);
  };
  NotesOfComponents notes(room.monitor, 1);
  const Monitor noting = notes.monitor_of(0, true);  // one after the other
  OtherTries tries(way, *before.parts, stages, kept != nullptr, room, noting);
  StandingResults standing;
  bool any = false;
  for (std::size_t c = 0; c < before.components.size(); ++c) {
    standing.emplace_back(taken_over(before.components[c]));
    std::optional<Certificate> was;
    if (!single) {
      was = judged(c, before.components[c]);
      const Surface& own = before.parts->components[c].surface;
      if (!way.may_help(before.components[c], own, *was)) continue;
    }
    auto made = tries.make(c);
    if (!made) continue;
    if (was && !better_than(judged(c, *made), *was)) {
      tries.drop(*made);
      continue;
    }
    if (!single) made->tree.reset();
    standing.back() = std::move(made);
    any = true;
  }
  notes.say_all();
  if (!any && tries.last_thrown()) std::rethrow_exception(tries.last_thrown());
  if (!any) throw GaveUp("no component's own certificate is better so");
  Assembled whole = extract_once(surface, way.options, room.monitor, &stages, room.log, room.number,
                                 std::move(standing));
  return {
      {std::move(whole.extraction), {}}, {}, std::move(whole.parts), std::move(whole.components)};
}

}  // namespace curveskel
