#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "skeleton/pipeline/component.hpp"
#include "skeleton/pipeline/copies.hpp"
#include "skeleton/pipeline/notes_of_components.hpp"

namespace curveskel {
namespace {

/// Twice the greatest distance from the mean of the vertices: the same in every position.
double extent_of(const Positions& positions) {
  const Eigen::RowVector3d mean = positions.colwise().mean();
  return 2 * std::sqrt((positions.rowwise() - mean).rowwise().squaredNorm().maxCoeff());
}

/// The extents of the components over that of the whole.
std::vector<double> extents_over_whole(const std::vector<Component>& components) {
  if (components.size() == 1) return {1};
  std::vector<double> extents;
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  Eigen::Index count = 0;
  for (const Component& one : components) {
    sum += one.surface.positions.colwise().sum();
    count += one.surface.positions.rows();
    extents.push_back(extent_of(one.surface.positions));
  }
  const Eigen::RowVector3d mean = sum / double(count);
  double farthest = 0;
  for (const Component& one : components) {
    const auto squares = (one.surface.positions.rowwise() - mean).rowwise().squaredNorm();
    farthest = std::max(farthest, squares.maxCoeff());
  }
  for (double& extent : extents) extent = std::min(1.0, extent / (2 * std::sqrt(farthest)));
  return extents;
}

/// A component's share of the working vertices. Small parts of a whole have less to tell: what each
/// is sure of falls with its extent over that of the whole, and with the number of components, so
/// that the work grows no faster than the surface; less far where its own vertices have a shape to
/// tell than where they would be made by refining.
/// The most grows with the component's handles: with fewer vertices each, surgery cannot cut them.
WorkingSize working_size(const ExtractOptions& options, int vertices, int genus, double extent,
                         const Topology& whole) {
  constexpr int sure_in_all = 200000;
  // Few enough for any number, enough for the simplest of shapes, and of those with a handle.
  const int fewest_made = genus == 0 ? 40 : 100;
  constexpr int fewest_left = 200;
  constexpr int per_handle = 32;
  WorkingSize size;
  const int by_extent = static_cast<int>(std::lround(options.least_resolution * extent));
  size.least = std::min({options.least_resolution, std::max(fewest_made, by_extent),
                         std::max(fewest_made, sure_in_all / whole.components())});
  size.most = std::max(size.least, vertices);
  if (options.resolution <= 0) return size;
  const auto all = static_cast<double>(whole.component_of_vertex.size());
  const double share = double(options.resolution) * double(vertices) / all;
  const int sure_to_stay =
      std::min(options.least_resolution, std::max(fewest_left, sure_in_all / whole.components()));
  size.most = std::max(
      {size.least, sure_to_stay, static_cast<int>(std::lround(share)), per_handle * genus});
  return size;
}

/// A try within another one of its log goes where that goes.
void renumber(Try& one, int first, int new_first) {
  if (one.part_of >= first) one.part_of += new_first - first;
}

/// As written down for the first of the kind, from number `first` on.
std::vector<Try> tries_of_copy(const TryLog& log, int copy, int first) {
  std::vector<Try> tries = log.tries;
  for (Try& one : tries) {
    one.component = copy;
    one.seconds = 0;
    renumber(one, log.first, first);
  }
  return tries;
}

/// Puts the components' tries one after the other, and tells each component its own.
void write_down(const std::vector<TryLog>& logs, TryLog& log, std::vector<ComponentResult>& all) {
  for (std::size_t c = 0; c < logs.size(); ++c) {
    const int first = log.next();
    for (const Try& one : logs[c].tries) {
      if (one.outcome == Outcome::kept) all[c].tries.push_back(log.next());
      log.tries.push_back(one);
      renumber(log.tries.back(), logs[c].first, first);
    }
  }
}

/// Those with so few working vertices that threads leave nothing to share out, none that stands.
std::vector<std::size_t> small_parts(const std::vector<Part>& parts, const Topology& counted,
                                     const ExtractOptions& options,
                                     const StandingResults& standing) {
  constexpr int fewest_shared = 2000;
  const bool on_host = options.contraction.solver == Solver::automatic ||
                       options.contraction.solver == Solver::cholesky;
  std::vector<std::size_t> small;
  if (!on_host || options.fairing) return small;
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const WorkingSize& size = parts[c].size;
    const int working = std::max(size.least, std::min(size.most, counted.vertices[c]));
    if (!standing[c] && working < fewest_shared) small.push_back(c);
  }
  return small;
}

/// Of each part the first that it is a copy of, itself unless there are many small ones.
std::vector<std::size_t> first_of_each(const std::vector<Part>& parts,
                                       const std::vector<std::size_t>& small) {
  constexpr std::size_t fewest_with_copies = 500;  // fewer are soon extracted, one by one
  std::vector<std::size_t> first(parts.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  if (small.size() < fewest_with_copies) return first;
  const std::vector<std::size_t> firsts = firsts_of_kind(parts, small);
  for (std::size_t i = 0; i < small.size(); ++i) first[small[i]] = firsts[i];
  return first;
}

/// The results so far; different components may be made by different threads.
struct ResultsInMaking {
  const std::vector<Part>& parts;
  std::vector<ComponentStages>* kept;
  int part_of;
  std::vector<std::size_t> first;  ///< see `first_of_each`
  std::vector<ComponentResult> all;
  std::vector<TryLog> logs;

  ResultsInMaking(const std::vector<Part>& components, std::vector<ComponentStages>* stages,
                  int outer_try, std::vector<std::size_t> first_of_kind)
      : parts(components),
        kept(stages),
        part_of(outer_try),
        first(std::move(first_of_kind)),
        all(components.size()),
        logs(components.size()) {}

  void make(std::size_t c, const ExtractOptions& options, const Monitor& monitor) {
    ComponentStages* const stages = kept != nullptr ? &(*kept)[c] : nullptr;
    all[c] = component_result(parts[c], options, monitor, stages, logs[c], part_of);
    if (parts.size() > 1) all[c].tree.reset();
  }

  /// False where there is none of the kind before it, or its curve would leave this one.
  bool take_over(std::size_t c, const std::stop_token& stop) {
    if (first[c] == c) return false;
    throw_if_stopped(stop);
    auto made = result_of_copy(parts[first[c]], all[first[c]], parts[c]);
    if (!made) return false;
    all[c] = std::move(*made);
    logs[c].tries = tries_of_copy(logs[first[c]], static_cast<int>(c), logs[c].first);
    return true;
  }
};

/// With one thread each; the first of each kind before its copies.
void make_side_by_side(ResultsInMaking& making, const std::vector<std::size_t>& components,
                       const ExtractOptions& options, NotesOfComponents& notes,
                       const std::stop_token& stop) {
  ExtractOptions alone = options;
  if (making.parts.size() > 1) {
    alone.threads = alone.fair.threads = alone.contraction.threads = alone.certificate.threads = 1;
  }
  const std::thread::id caller = std::this_thread::get_id();
  const auto make = [&](std::size_t c) {
    making.make(c, alone, notes.monitor_of(c, std::this_thread::get_id() == caller));
  };
  parallel_for(components.size(), 1, options.threads, [&](std::size_t i, std::size_t) {
    if (making.first[components[i]] == components[i]) make(components[i]);
  });
  parallel_for(components.size(), 1, options.threads, [&](std::size_t i, std::size_t) {
    const std::size_t c = components[i];
    if (making.first[c] != c && !making.take_over(c, stop)) make(c);
  });
}

}  // namespace

std::vector<Part> parts_of(const Parts& whole, const ExtractOptions& options) {
  const Topology& counted = whole.counted;
  const std::vector<double> extents = extents_over_whole(whole.components);
  std::vector<Part> parts;
  parts.reserve(extents.size());
  for (std::size_t c = 0; c < extents.size(); ++c) {
    parts.push_back(
        {whole.components[c], static_cast<int>(c), counted.genus[c],
         working_size(options, counted.vertices[c], counted.genus[c], extents[c], counted),
         extents[c]});
  }
  return parts;
}

ComponentResult taken_over(const ComponentResult& made) {
  return {made.skeleton, nullptr, made.record, {}, {}, made.tries, made.has_all_vertices};
}

std::vector<ComponentResult> component_results(const Parts& whole, const ExtractOptions& options,
                                               const Monitor& monitor,
                                               std::vector<ComponentStages>* kept, TryLog& log,
                                               int part_of, StandingResults standing) {
  if (kept != nullptr) kept->resize(whole.components.size());
  standing.resize(whole.components.size());
  const std::vector<Part> parts = parts_of(whole, options);
  const std::vector<std::size_t> small = small_parts(parts, whole.counted, options, standing);
  NotesOfComponents notes(monitor, parts.size());
  ResultsInMaking making(parts, kept, part_of, first_of_each(parts, small));
  const bool watched = monitor.frame || monitor.curve;
  std::vector<char> waits(parts.size(), 0);  // to be made side by side
  if (!watched) {
    for (const std::size_t c : small) waits[c] = 1;
  }
  int next = log.next();  // what is shown has the number that it is written down with
  for (TryLog& own : making.logs) own.first = next;
  for (std::size_t c = 0; c < parts.size(); ++c) {
    if (standing[c]) making.all[c] = std::move(*standing[c]);
    if (standing[c] || waits[c] != 0) continue;
    making.logs[c].first = next;
    if (!making.take_over(c, monitor.stop)) making.make(c, options, notes.monitor_of(c, true));
    next = making.logs[c].next();
  }
  if (!watched) make_side_by_side(making, small, options, notes, monitor.stop);
  notes.say_all();
  write_down(making.logs, log, making.all);
  return std::move(making.all);
}

}  // namespace curveskel
