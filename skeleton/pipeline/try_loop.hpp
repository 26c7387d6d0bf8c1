// The one loop over the tries of an extraction, and the one policy for what a failed try means.
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/tries.hpp>

namespace curveskel {

/// A try that found nothing although nothing went wrong: the next plan may.
class GaveUp : public Error {
 public:
  explicit GaveUp(const std::string& message) : Error(Fault::solver, message) {}
};

struct TryFailure {
  std::string message;
  bool gave_up = false;
  std::exception_ptr thrown;
};

/// Runs the work and hands back what it threw, if that is an Error or a lack of memory: then the
/// try has failed, and what else there is stands. Cancelled, Error(Fault::usage), which no other
/// try mends, and defects of the program pass through.
[[nodiscard]] std::optional<TryFailure> failure_of(const std::function<void()>& work);

/// The same, but frames and curves say that they are of this try (its name is not read), or of one
/// within it; and the name is put before theirs. Refers to `monitor` and `name`.
[[nodiscard]] Monitor in_try(const Monitor& monitor, const ShownTry& shown, std::string_view name);

/// The tries as they are made; a part of the whole history that begins at number `first`.
struct TryLog {
  std::vector<Try> tries;
  int first = 0;

  [[nodiscard]] int next() const { return first + static_cast<int>(tries.size()); }
  [[nodiscard]] Try& operator[](int number) { return tries[idx(number - first)]; }
  /// Says of a try and of all that is part of it that they are not part of the result.
  void drop(int number);
};

/// One plan for a try of something that ends in a Value.
template <typename Value>
struct Plan {
  struct SoFar {
    std::optional<Value> best;
    int number = -1;                  ///< of the best
    std::optional<TryFailure> first;  ///< that failed
    std::optional<TryFailure> last;   ///< the try just before, if it failed
  };
  /// To make a try in.
  struct Room {
    const SoFar& so_far;
    const Monitor& monitor;
    TryLog& log;
    int number;  ///< of the try
  };
  std::string_view name;
  /// Why it is made after what there is so far; nothing if it is not.
  std::function<std::optional<std::string>(const SoFar&)> why;
  std::function<Value(const Room&)> make;  ///< a failure is thrown
};

/// The subject of the tries: the whole surface, or one of its components.
struct TriesOf {
  int component = -1;
  int part_of = -1;
  int of_surface = -1;  ///< number of the try whose surface they are of; -1 = they have their own
};

/// Carries out the plans in their order, each if it has a reason, and writes down how it went.
/// `takes(value, best)` tells if a value takes the place of the best so far, null before the first;
/// `brief(value)` is the certificate that is written down. Ends with the best, or with nothing but
/// a failure; neither if no plan had a reason or nothing was taken.
template <typename Value, typename Takes, typename Brief>
typename Plan<Value>::SoFar carry_out(const std::vector<Plan<Value>>& plans, const TriesOf& of,
                                      const Takes& takes, const Brief& brief,
                                      const Monitor& monitor, TryLog& log) {
  typename Plan<Value>::SoFar so_far;
  for (const Plan<Value>& plan : plans) {
    std::optional<std::string> why = plan.why(so_far);
    if (!why) continue;
    const int number = log.next();
    log.tries.push_back({.name = std::string(plan.name),
                         .component = of.component,
                         .part_of = of.part_of,
                         .why = std::move(*why),
                         .message = {},
                         .certificate = {}});
    const Monitor marked =
        in_try(monitor, {number, of.of_surface >= 0 ? of.of_surface : number, {}}, plan.name);
    std::optional<Value> made;
    const auto start = std::chrono::steady_clock::now();
    auto failure = failure_of([&] { made.emplace(plan.make({so_far, marked, log, number})); });
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    log[number].seconds = taken.count();
    if (failure) {
      log.drop(number);
      log[number].message = failure->message;
      if (!so_far.first) so_far.first = failure;
      so_far.last = std::move(failure);
      continue;
    }
    so_far.last.reset();
    log[number].certificate = brief(*made);
    if (!takes(*made, so_far.best ? &*so_far.best : nullptr)) {
      log[number].outcome = Outcome::kept;
      log.drop(number);
      continue;
    }
    if (so_far.best) log.drop(so_far.number);
    log[number].outcome = Outcome::kept;
    so_far.best = std::move(made);
    so_far.number = number;
  }
  return so_far;
}

/// The best of what was carried out; throws the last failure if there is none.
template <typename SoFar>
auto best_of(SoFar so_far) {
  if (!so_far.best) std::rethrow_exception(so_far.last->thrown);
  return std::move(*so_far.best);
}

}  // namespace curveskel
