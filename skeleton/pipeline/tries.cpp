#include <curveskel/tries.hpp>

#include <algorithm>
#include <new>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "skeleton/pipeline/try_loop.hpp"

namespace curveskel {
namespace {

/// "faired, gentler contraction"; what is as asked needs no word.
std::string joined(std::string_view outer, std::string_view inner) {
  if (inner.empty() || inner == try_as_asked) return std::string(outer);
  if (outer == try_as_asked || inner.starts_with(outer)) return std::string(inner);
  return std::string(outer) + ", " + std::string(inner);
}

template <typename Shown>
void pass_on(const std::function<void(const Shown&)>& to, const Shown& shown,
             const ShownTry& made_in, std::string_view name) {
  const std::string whole_name = joined(name, shown.made_in.name);
  Shown marked = shown;
  if (marked.made_in.number < 0) marked.made_in = made_in;
  marked.made_in.name = whole_name;
  to(marked);
}

}  // namespace

CertificateInBrief in_brief(const Certificate& certificate) {
  return {certificate.topology_correct(), certificate.inside_enough, certificate.inside_fraction,
          certificate.tips, certificate.junctions};
}

std::string full_name(const std::vector<Try>& history, int number) {
  std::string name;
  int end = static_cast<int>(history.size());  // a try is made in an earlier one
  for (int n = number; n >= 0; n = history[idx(n)].part_of) {
    if (n >= end) {
      throw Error(Fault::input, "full_name: found the try " + std::to_string(n) +
                                    ", needed one of the first " + std::to_string(end) +
                                    ", or -1 for none");
    }
    end = n;
    name = joined(history[idx(n)].name, name);
  }
  return name;
}

bool is_kept(const std::vector<Try>& history, std::string_view name, std::optional<int> component) {
  return std::any_of(history.begin(), history.end(), [&](const Try& one) {
    return one.outcome == Outcome::kept && one.name == name &&
           (!component || one.component == *component);
  });
}

std::optional<TryFailure> failure_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const GaveUp& nothing) {
    return TryFailure{nothing.what(), true, std::current_exception()};
  } catch (const Error& error) {
    if (error.fault() == Fault::usage) throw;
    return TryFailure{error.what(), false, std::current_exception()};
  } catch (const std::bad_alloc&) {
    return TryFailure{"out of memory", false, std::current_exception()};
  }
  return std::nullopt;
}

Monitor in_try(const Monitor& monitor, const ShownTry& shown, std::string_view name) {
  Monitor marked = monitor;
  if (monitor.frame) {
    marked.frame = [&monitor, shown, name](const Frame& frame) {
      pass_on(monitor.frame, frame, shown, name);
    };
  }
  if (monitor.curve) {
    marked.curve = [&monitor, shown, name](const CurveFrame& curve) {
      pass_on(monitor.curve, curve, shown, name);
    };
  }
  return marked;
}

void TryLog::drop(int number) {
  std::vector<char> dropped(tries.size(), 0);
  dropped[idx(number - first)] = 1;
  for (std::size_t i = idx(number - first); i < tries.size(); ++i) {
    const int whole = tries[i].part_of - first;
    if (whole >= 0 && dropped[idx(whole)] != 0) dropped[i] = 1;
    if (dropped[i] != 0 && tries[i].outcome == Outcome::kept) {
      tries[i].outcome = Outcome::not_better;
    }
  }
}

}  // namespace curveskel
