#include <curveskel/extract.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <future>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/topology.hpp>
#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "skeleton/embed/ends/rims.hpp"
#include "skeleton/pipeline/component.hpp"
#include "skeleton/pipeline/stages.hpp"

namespace curveskel {
namespace {

/// The components' skeletons one after the other; the vertex map goes from the whole surface.
CurveSkeleton joined(const std::vector<ComponentResult>& results,
                     const std::vector<Component>& parts, Eigen::Index vertices) {
  Eigen::Index nodes = 0;
  Eigen::Index edges = 0;
  for (const ComponentResult& one : results) {
    nodes += one.skeleton->nodes.rows();
    edges += one.skeleton->edges.rows();
  }
  CurveSkeleton whole;
  whole.nodes.resize(nodes, 3);
  whole.radii.resize(nodes);
  whole.edges.resize(edges, 2);
  whole.node_of_vertex.setConstant(vertices, -1);
  nodes = edges = 0;
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const CurveSkeleton& part = *results[c].skeleton;
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

/// Bytes needed at least: less than measured (0.7 KB a vertex, 2 KB a working vertex).
double least_memory_bytes(const Surface& surface, const ExtractOptions& options) {
  const auto vertices = static_cast<double>(surface.positions.rows());
  const double working =
      options.resolution > 0 ? std::min(vertices, double(options.resolution)) : vertices;
  return 500 * vertices + 1000 * working;
}

SurfaceStages::CertifiedFrom certified_from(const std::vector<ComponentResult>& results,
                                            const ExtractOptions& options) {
  std::vector<Shared<CurveSkeleton>> skeletons;
  skeletons.reserve(results.size());
  for (const ComponentResult& one : results) skeletons.push_back(one.skeleton);
  return {std::move(skeletons), options.openings, what_counts(options.certificate)};
}

/// The tree for the certificate of several components grows in the background; a single component
/// has its tree by then.
class TreeOfAll {
 public:
  TreeOfAll(const Surface& surface, const Parts& parts, SurfaceStages* kept, int threads)
      : kept_(kept) {
    if (parts.components.size() == 1) return;
    if (kept != nullptr && kept->tree.value) {
      tree_ = kept->tree.value;
    } else {
      planted_ = in_background(threads, [&surface] { return SurfaceTree(surface); });
    }
  }
  const SurfaceTree& get(const std::vector<ComponentResult>& results) {
    if (planted_.valid()) {
      tree_ = std::make_shared<const SurfaceTree>(planted_.get());
      if (kept_ != nullptr) kept_->tree.value = tree_;
    }
    return tree_ ? *tree_ : *results.front().tree;
  }

 private:
  SurfaceStages* kept_;
  Shared<SurfaceTree> tree_;
  std::future<SurfaceTree> planted_;
};

bool has_stage(const std::vector<StageTime>& times, std::string_view stage) {
  return std::any_of(times.begin(), times.end(),
                     [&](const StageTime& time) { return time.stage == stage; });
}

/// Of the stages in `taken` those that never ran, in order, each once.
std::vector<std::string> only_reused(const std::vector<std::string>& taken,
                                     const std::vector<StageTime>& ran) {
  constexpr std::array stages{"normalise", "fair",    "coarsen", "balls",
                              "contract",  "surgery", "embed",   "certify"};
  std::vector<std::string> result;
  for (const char* stage : stages) {
    if (std::find(taken.begin(), taken.end(), stage) == taken.end()) continue;
    if (!has_stage(ran, stage)) result.emplace_back(stage);
  }
  return result;
}

/// As the options say.
Extraction extract_once(const Surface& surface, const ExtractOptions& options,
                        const Monitor& monitor, SurfaceStages* kept) {
  Extraction result;
  require_memory(least_memory_bytes(surface, options), available_memory_bytes(), "the extraction",
                 Fault::input,
                 options.resolution > 0
                     ? "decimate the surface first"
                     : "choose a coarser --resolution or decimate the surface first");
  SurfaceStages passing;
  SurfaceStages& stages = kept != nullptr ? *kept : passing;
  std::vector<std::string> taken;
  StageRun stage(result.times, taken, monitor, kept != nullptr);
  const Shared<Parts> parts = stage("normalise", stages.parts, {}, [&] {
    Topology counted = topology(surface);
    auto components = split_components(surface, counted);
    return Parts{std::move(counted), std::move(components)};
  });
  TreeOfAll tree_of_all(surface, *parts, kept, options.threads);
  auto results =
      component_results(*parts, options, monitor, kept != nullptr ? &kept->components : nullptr);
  for (ComponentResult& one : results) {
    for (const StageTime& time : one.times) stage.clock.add(time);
    taken.insert(taken.end(), one.reused.begin(), one.reused.end());
    result.components.push_back(std::move(one.record));
  }
  const Shared<CertifiedSkeleton> certified =
      stage("certify", stages.certified, certified_from(results, options), [&] {
        CertifiedSkeleton made{joined(results, parts->components, surface.positions.rows()), {}};
        const SurfaceTree& tree = tree_of_all.get(results);
        reach_rims(made.skeleton, surface, tree, options.openings);
        made.certificate = evaluate({surface, tree, bounding_box_diagonal(surface.positions),
                                     parts->counted.components(), parts->counted.total_genus()},
                                    made.skeleton, options.certificate, monitor);
        return made;
      });
  result.skeleton = certified->skeleton;
  result.certificate = certified->certificate;
  result.reused = only_reused(taken, result.times);
  return result;
}

/// Gives the second run the stages that fairing does not touch.
void share_beginning(const SurfaceStages& from, SurfaceStages& to) {
  to.parts = from.parts;
  to.tree = from.tree;
  to.components.resize(from.components.size());
  for (std::size_t c = 0; c < from.components.size(); ++c) {
    to.components[c].canonical = from.components[c].canonical;
    to.components[c].tree = from.components[c].tree;
  }
}

bool better(const Certificate& a, const Certificate& b) {
  return std::pair(a.topology_correct(), a.inside_fraction) >
         std::pair(b.topology_correct(), b.inside_fraction);
}

/// Runs with other options and keeps the better result; whether that is the new one.
bool try_again(Extraction& result, const Surface& surface, const ExtractOptions& options,
               const Monitor& monitor, SurfaceStages* kept) {
  std::optional<Extraction> other;
  const auto start = std::chrono::steady_clock::now();
  try {
    other = extract_once(surface, options, monitor, kept);
  } catch (const Error&) {  // a part too thin to be faired is no noise
    const auto lost = std::chrono::steady_clock::now() - start;
    result.times.push_back({"second try", std::chrono::duration<double>(lost).count()});
    return false;
  }
  std::vector<StageTime> ran = result.times;
  ran.insert(ran.end(), other->times.begin(), other->times.end());
  std::vector<std::string> reused = result.reused;
  reused.insert(reused.end(), other->reused.begin(), other->reused.end());
  const bool is_better = better(other->certificate, result.certificate);
  if (is_better) result = std::move(*other);
  result.reused = only_reused(reused, ran);
  result.times = std::move(ran);
  return is_better;
}

bool was_coarsened(const Extraction& extraction) {
  return std::any_of(
      extraction.components.begin(), extraction.components.end(),
      [](const ComponentRecord& one) { return one.working_vertices < one.vertices; });
}

Extraction extract_with(const Surface& surface, const ExtractOptions& options,
                        const Monitor& monitor, ExtractionCache::Implementation* kept) {
  Extraction result =
      extract_once(surface, options, monitor, kept != nullptr ? &kept->as_asked : nullptr);
  // A limb as thin as the coarsened triangles are long has other handles there.
  constexpr Eigen::Index most_for_all = 50000;
  if (!result.certificate.topology_correct() && options.all_vertices_if_failed &&
      was_coarsened(result) && surface.positions.rows() <= most_for_all) {
    ExtractOptions finest = options;
    finest.resolution = 0;
    if (kept != nullptr) share_beginning(kept->as_asked, kept->all_vertices);
    if (try_again(result, surface, finest, monitor,
                  kept != nullptr ? &kept->all_vertices : nullptr)) {
      result.all_vertices_again = true;
      monitor.say("the certificate failed, so the skeleton was extracted again from all vertices");
    }
  }
  // Noise as thick as the limbs turns them inside out here and there; without it the curve has a
  // way through.
  if (!result.certificate.inside_enough && !options.fairing && options.fair_if_outside) {
    ExtractOptions gentler = options;
    gentler.fairing = true;
    gentler.fair.iterations = 30;
    if (kept != nullptr) share_beginning(kept->as_asked, kept->faired_again);
    if (try_again(result, surface, gentler, monitor,
                  kept != nullptr ? &kept->faired_again : nullptr)) {
      result.faired_again = true;
      monitor.say(
          "the curve left the surface, so it was extracted again from the faired surface (30 "
          "iterations)");
    }
  }
  return result;
}

}  // namespace

Extraction extract(const Surface& surface, const ExtractOptions& options, const Monitor& monitor) {
  return extract_with(surface, options, monitor, nullptr);
}

Extraction extract(const Surface& surface, const ExtractOptions& options, const Monitor& monitor,
                   ExtractionCache& cache) {
  ExtractionCache::Implementation& kept = cache.implementation();
  kept.keep_only(surface);
  return extract_with(surface, options, monitor, &kept);
}

}  // namespace curveskel
