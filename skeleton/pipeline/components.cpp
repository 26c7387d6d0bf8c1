#include <algorithm>
#include <cmath>
#include <optional>
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

/// As written down for the first of the kind.
std::vector<Try> tries_of_copy(std::vector<Try> tries, int copy) {
  for (Try& one : tries) {
    one.component = copy;
    one.seconds = 0;
  }
  return tries;
}

/// Puts the components' tries one after the other, and tells each component its own.
void write_down(const std::vector<TryLog>& logs, TryLog& log, std::vector<ComponentResult>& all) {
  for (std::size_t c = 0; c < logs.size(); ++c) {
    for (const Try& one : logs[c].tries) {
      if (one.outcome == Outcome::kept) all[c].tries.push_back(log.next());
      log.tries.push_back(one);
    }
  }
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
  return {made.skeleton, nullptr, made.record, {}, {}, made.tries};
}

std::vector<ComponentResult> component_results(const Parts& whole, const ExtractOptions& options,
                                               const Monitor& monitor,
                                               std::vector<ComponentStages>* kept, TryLog& log,
                                               int part_of, StandingResults standing) {
  constexpr int small = 2000;  // working vertices that leave nothing to share out
  constexpr std::size_t fewest_with_copies = 500;  // fewer are soon extracted, one by one
  const Topology& counted = whole.counted;
  const bool several = whole.components.size() > 1;
  if (kept != nullptr) kept->resize(whole.components.size());
  standing.resize(whole.components.size());
  const std::vector<Part> parts = parts_of(whole, options);
  std::vector<ComponentResult> all(whole.components.size());
  std::vector<TryLog> logs(whole.components.size());
  std::vector<std::size_t> side_by_side;
  NotesOfComponents notes(monitor);
  const auto contribute = [&](std::size_t c, const ExtractOptions& its, const Monitor& own) {
    all[c] = component_result(parts[c], its, own, kept != nullptr ? &(*kept)[c] : nullptr, logs[c],
                              part_of);
    if (several) all[c].tree.reset();
  };
  const bool on_host = options.contraction.solver == Solver::automatic ||
                       options.contraction.solver == Solver::cholesky;
  const bool watched = monitor.frame || monitor.curve;
  int next = log.next();  // what is shown has the number that it is written down with
  for (std::size_t c = 0; c < parts.size(); ++c) {
    if (standing[c]) {
      all[c] = std::move(*standing[c]);
      continue;
    }
    const WorkingSize size = parts[c].size;
    if (on_host && !options.fairing && !watched &&
        std::max(size.least, std::min(size.most, counted.vertices[c])) < small) {
      side_by_side.push_back(c);
    } else {
      logs[c].first = next;
      contribute(c, options, notes.monitor());
      next = logs[c].next();
    }
  }
  ExtractOptions alone = options;
  if (several) {
    alone.threads = alone.fair.threads = alone.contraction.threads = alone.certificate.threads = 1;
  }
  Monitor silent;  // callbacks are for the calling thread
  silent.stop = monitor.stop;
  const std::thread::id caller = std::this_thread::get_id();
  const auto contribute_alone = [&](std::size_t c) {
    const bool here = std::this_thread::get_id() == caller;
    contribute(c, alone, here ? notes.monitor() : silent);
  };
  const std::vector<std::size_t> firsts =
      side_by_side.size() < fewest_with_copies ? side_by_side : firsts_of_kind(parts, side_by_side);
  parallel_for(side_by_side.size(), 1, options.threads, [&](std::size_t i, std::size_t) {
    if (firsts[i] == side_by_side[i]) contribute_alone(side_by_side[i]);
  });
  parallel_for(side_by_side.size(), 1, options.threads, [&](std::size_t i, std::size_t) {
    const std::size_t c = side_by_side[i];
    if (firsts[i] == c) return;
    throw_if_stopped(monitor.stop);
    auto made = result_of_copy(parts[firsts[i]], all[firsts[i]], parts[c]);
    if (!made) return contribute_alone(c);
    all[c] = std::move(*made);
    logs[c].tries = tries_of_copy(logs[firsts[i]].tries, static_cast<int>(c));
  });
  notes.say_all();
  write_down(logs, log, all);
  return all;
}

}  // namespace curveskel
