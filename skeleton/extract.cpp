#include "skeleton/extract.hpp"

#include <algorithm>
#include <cmath>
#include <future>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "skeleton/contribution.hpp"
#include "skeleton/openings.hpp"
#include "skeleton/stage_clock.hpp"
#include "surface/measures.hpp"
#include "surface/memory.hpp"
#include "surface/parallel.hpp"
#include "surface/topology.hpp"
#include "surface/tree.hpp"

namespace curveskel {
namespace {

/// A component's share of the working vertices. So that no number of components makes the work grow
/// faster than the surface, what each is sure of falls where there are many of them.
/// What it may have grows with its handles: with fewer each, surgery finds no way to cut them.
WorkingSize working_size(const ExtractOptions& options, int vertices, int genus,
                         const Topology& whole) {
  constexpr int sure_in_all = 200000;
  constexpr int fewest = 200;  // few enough for any number, enough for the simplest of shapes
  constexpr int per_handle = 32;
  WorkingSize size;
  size.least =
      std::min(options.least_resolution, std::max(fewest, sure_in_all / whole.components()));
  size.most = std::max(size.least, vertices);
  if (options.resolution <= 0) return size;
  const auto all = static_cast<double>(whole.component_of_vertex.size());
  const double share = double(options.resolution) * double(vertices) / all;
  size.most = std::max({size.least, static_cast<int>(std::lround(share)), per_handle * genus});
  return size;
}

/// All components. Each of the larger ones has all threads to itself; the small ones, of which
/// there may be many, go side by side with one thread each.
std::vector<Contribution> contributions_of(const std::vector<Component>& parts,
                                           const Topology& counted, const ExtractOptions& options,
                                           const Monitor& monitor) {
  constexpr int small = 2000;  // working vertices that leave nothing to share out
  std::vector<Contribution> all(parts.size());
  std::vector<std::size_t> side_by_side;
  const auto size_of = [&](std::size_t c) {
    return working_size(options, counted.vertices[c], counted.genus[c], counted);
  };
  const bool on_host = options.contraction.solver == Solver::automatic ||
                       options.contraction.solver == Solver::cholesky;
  const bool may_share = on_host && !options.fairing && !monitor.frame;
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const WorkingSize size = size_of(c);
    if (may_share && std::max(size.least, std::min(size.most, counted.vertices[c])) < small) {
      side_by_side.push_back(c);
      continue;
    }
    all[c] = contribution_of(parts[c], counted.genus[c], size, options, monitor);
    if (parts.size() > 1) all[c].tree.reset();
  }
  ExtractOptions alone = options;
  if (parts.size() > 1) alone.threads = 1;
  Monitor silent;  // callbacks are for the calling thread
  silent.stop = monitor.stop;
  const std::thread::id caller = std::this_thread::get_id();
  parallel_for(side_by_side.size(), 1, options.threads, [&](std::size_t i, std::size_t) {
    const std::size_t c = side_by_side[i];
    const bool here = std::this_thread::get_id() == caller;
    all[c] =
        contribution_of(parts[c], counted.genus[c], size_of(c), alone, here ? monitor : silent);
    if (parts.size() > 1) all[c].tree.reset();
  });
  return all;
}

/// The components' skeletons one after the other; the vertex map goes from the whole surface.
CurveSkeleton joined(const std::vector<Contribution>& contributions,
                     const std::vector<Component>& parts, Eigen::Index vertices) {
  Eigen::Index nodes = 0;
  Eigen::Index edges = 0;
  for (const Contribution& one : contributions) {
    nodes += one.skeleton.nodes.rows();
    edges += one.skeleton.edges.rows();
  }
  CurveSkeleton whole;
  whole.nodes.resize(nodes, 3);
  whole.radii.resize(nodes);
  whole.edges.resize(edges, 2);
  whole.node_of_vertex.setConstant(vertices, -1);
  nodes = edges = 0;
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const CurveSkeleton& part = contributions[c].skeleton;
    whole.nodes.middleRows(nodes, part.nodes.rows()) = part.nodes;
    whole.radii.segment(nodes, part.radii.size()) = part.radii;
    whole.edges.middleRows(edges, part.edges.rows()) = part.edges.array() + static_cast<int>(nodes);
    for (std::size_t v = 0; v < parts[c].vertex_in_whole.size(); ++v) {
      whole.node_of_vertex[parts[c].vertex_in_whole[v]] =
          part.node_of_vertex[static_cast<Eigen::Index>(v)] + static_cast<int>(nodes);
    }
    nodes += part.nodes.rows();
    edges += part.edges.rows();
  }
  return whole;
}

/// What it takes at least: below what was measured (0.7 KB a vertex, 2 KB a working vertex).
double least_memory_bytes(const Surface& surface, const ExtractOptions& options) {
  const auto vertices = static_cast<double>(surface.positions.rows());
  const double working =
      options.resolution > 0 ? std::min(vertices, double(options.resolution)) : vertices;
  return 500 * vertices + 1000 * working;
}

/// As the options say.
Extraction extract_once(const Surface& surface, const ExtractOptions& options,
                        const Monitor& monitor) {
  Extraction result;
  require_memory(least_memory_bytes(surface, options), available_memory_bytes(), "the extraction",
                 Fault::input, "choose a coarser --resolution or decimate the surface first");
  StageClock clock(result.times);
  const Topology counted = clock("normalise", [&] { return topology(surface); });
  const auto parts = clock("normalise", [&] { return split_components(surface, counted); });
  // Several components need a tree of their own for the certificate, in the background; a single
  // one has its tree by then.
  std::optional<SurfaceTree> tree_of_all;
  std::future<SurfaceTree> planted;
  if (parts.size() > 1) {
    planted = in_background(options.threads, [&] { return SurfaceTree(surface); });
  }
  auto contributions = contributions_of(parts, counted, options, monitor);
  result.skeleton = joined(contributions, parts, surface.positions.rows());
  for (Contribution& one : contributions) {
    for (const StageTime& time : one.times) clock.add(time);
    result.components.push_back(std::move(one.record));
  }
  if (parts.size() == 1) tree_of_all = std::move(contributions.front().tree);
  result.certificate = clock("certify", [&] {
    if (planted.valid()) tree_of_all = planted.get();
    reach_openings(result.skeleton, surface, *tree_of_all, options.openings);
    return evaluate({surface.positions, *tree_of_all, bounding_box_diagonal(surface.positions),
                     counted.components(), counted.total_genus()},
                    result.skeleton, options.certificate, monitor);
  });
  return result;
}

}  // namespace

Extraction extract(const Surface& surface, const ExtractOptions& options, const Monitor& monitor) {
  Extraction result = extract_once(surface, options, monitor);
  if (result.certificate.inside_enough || options.fairing || !options.fair_if_outside) {
    return result;
  }
  // Noise as thick as the limbs turns them inside out here and there; without it the curve has a
  // way through.
  ExtractOptions gentler = options;
  gentler.fairing = true;
  gentler.fair.iterations = 30;
  std::optional<Extraction> faired;
  try {
    faired = extract_once(surface, gentler, monitor);
  } catch (const Error&) {
    return result;  // what is too thin to be faired is no noise
  }
  if (faired->certificate.inside_fraction <= result.certificate.inside_fraction) return result;
  faired->times.insert(faired->times.begin(), result.times.begin(), result.times.end());
  monitor.say(
      "the curve left the surface, so it was extracted again from the faired surface (30 "
      "iterations)");
  faired->faired_again = true;
  return std::move(*faired);
}

}  // namespace curveskel
