#include <curveskel/extract.hpp>

#include <algorithm>
#include <array>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/topology.hpp>
#include "base/memory.hpp"
#include "base/option_ranges.hpp"
#include "base/parallel.hpp"
#include "skeleton/embed/ends/rims.hpp"
#include "skeleton/pipeline/component.hpp"
#include "skeleton/pipeline/extraction_plans.hpp"
#include "skeleton/pipeline/stages.hpp"
#include "surface/mesh/lids.hpp"
#include "surface/mesh/overlaps.hpp"

namespace curveskel {
namespace {

/// The faces and the vertices that they use. `number` is -1 of all vertices, before and after.
Surface part_of(const Surface& surface, const std::vector<Eigen::Index>& faces,
                std::vector<std::int32_t>& number) {
  Surface part;
  part.triangles = surface.triangles(faces, Eigen::all);
  std::vector<std::int32_t> used;
  for (std::int32_t& v : part.triangles.reshaped<Eigen::RowMajor>()) {
    if (number[idx(v)] < 0) {
      number[idx(v)] = static_cast<std::int32_t>(used.size());
      used.push_back(v);
    }
    v = number[idx(v)];
  }
  part.positions = surface.positions(used, Eigen::all);
  for (const std::int32_t v : used) number[idx(v)] = -1;
  return part;
}

/// Of each component that has rims its faces without those that close holes.
std::vector<Surface> open_components(
    const Surface& surface, const Topology& counted,
    const std::vector<std::vector<std::vector<std::int32_t>>>& rims_of_component) {
  std::vector<std::vector<Eigen::Index>> faces(rims_of_component.size());
  std::vector<std::vector<std::int32_t>> rims;
  for (const auto& own : rims_of_component) rims.insert(rims.end(), own.begin(), own.end());
  if (rims.empty()) return std::vector<Surface>(rims_of_component.size());
  const std::vector<char> in_rim = faces_in_rims(surface, rims);
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    const std::size_t component = idx(counted.component_of_vertex[surface.triangles(f, 0)]);
    if (rims_of_component[component].empty() || in_rim[idx(f)] != 0) continue;
    faces[component].push_back(f);
  }
  std::vector<std::int32_t> number(idx(surface.positions.rows()), -1);
  std::vector<Surface> open;
  open.reserve(faces.size());
  for (const auto& own : faces) open.push_back(part_of(surface, own, number));
  return open;
}

/// The components' skeletons, those led on to their rims that have any. Each by its own surface: in
/// another component, which may overlap it, it is as good as outside.
std::vector<Shared<CurveSkeleton>> on_to_rims(const std::vector<ComponentResult>& results,
                                              const Surface& surface, const Parts& parts,
                                              const SurfaceTree& tree_of_all,
                                              const std::vector<std::vector<std::int32_t>>& rims) {
  std::vector<std::vector<std::vector<std::int32_t>>> own(results.size());
  for (const auto& rim : rims) {
    if (rim.empty()) continue;
    own[idx(parts.counted.component_of_vertex[rim.front()])].push_back(rim);
  }
  const std::vector<Surface> open = open_components(surface, parts.counted, own);
  const double diagonal = bounding_box_diagonal(surface.positions);
  std::vector<Shared<CurveSkeleton>> skeletons;
  skeletons.reserve(results.size());
  for (std::size_t c = 0; c < results.size(); ++c) {
    skeletons.push_back(results[c].skeleton);
    if (own[c].empty()) continue;
    std::optional<SurfaceTree> its;
    if (results.size() > 1) its.emplace(parts.components[c].surface);
    CurveSkeleton led = *results[c].skeleton;
    reach_rims(led, surface, diagonal, its ? *its : tree_of_all, open[c], own[c]);
    skeletons.back() = std::make_shared<const CurveSkeleton>(std::move(led));
  }
  return skeletons;
}

/// The components' skeletons one after the other; the vertex map goes from the whole surface.
CurveSkeleton joined(const std::vector<Shared<CurveSkeleton>>& skeletons,
                     const std::vector<Component>& parts, Eigen::Index vertices) {
  Eigen::Index nodes = 0;
  Eigen::Index edges = 0;
  for (const auto& one : skeletons) {
    nodes += one->nodes.rows();
    edges += one->edges.rows();
  }
  CurveSkeleton whole;
  whole.nodes.resize(nodes, 3);
  whole.radii.resize(nodes);
  whole.edges.resize(edges, 2);
  whole.lives.setZero(nodes);
  whole.node_of_vertex.setConstant(vertices, -1);
  nodes = edges = 0;
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const CurveSkeleton& part = *skeletons[c];
    whole.nodes.middleRows(nodes, part.nodes.rows()) = part.nodes;
    whole.radii.segment(nodes, part.radii.size()) = part.radii;
    whole.lives.segment(nodes, part.lives.size()) = part.lives;
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
  return {std::move(skeletons), options.rims, what_counts(options.certificate)};
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
      planted_ =
          in_background(threads, [&surface, threads] { return SurfaceTree(surface, threads); });
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

}  // namespace

std::vector<std::string> only_reused(const std::vector<std::string>& taken,
                                     const std::vector<StageTime>& ran) {
  constexpr std::array stages{"normalise", "fair",  "coarsen", "balls",  "contract",
                              "surgery",   "embed", "level",   "certify"};
  std::vector<std::string> result;
  for (const char* stage : stages) {
    if (std::find(taken.begin(), taken.end(), stage) == taken.end()) continue;
    if (!has_stage(ran, stage)) result.emplace_back(stage);
  }
  return result;
}

Assembled extract_once(const Surface& surface, const ExtractOptions& options,
                       const Monitor& monitor, SurfaceStages* kept, TryLog& log, int part_of,
                       StandingResults standing) {
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
    auto overlaps = overlaps_of(surface, counted, monitor);
    return Parts{std::move(counted), std::move(components), std::move(overlaps)};
  });
  TreeOfAll tree_of_all(surface, *parts, kept, options.threads);
  auto results =
      component_results(*parts, options, monitor, kept != nullptr ? &kept->components : nullptr,
                        log, part_of, std::move(standing));
  for (ComponentResult& one : results) {
    for (const StageTime& time : one.times) stage.clock.add(time);
    taken.insert(taken.end(), one.reused.begin(), one.reused.end());
    one.record.inside_component = parts->overlaps.around[result.components.size()];
    one.record.overlaps = parts->overlaps.met[result.components.size()];
    result.components.push_back(one.record);
  }
  const Shared<CertifiedSkeleton> certified =
      stage("certify", stages.certified, certified_from(results, options), [&] {
        const SurfaceTree& tree = tree_of_all.get(results);
        CertifiedSkeleton made{joined(on_to_rims(results, surface, *parts, tree, options.rims),
                                      parts->components, surface.positions.rows()),
                               {}};
        made.certificate = evaluate({surface, tree, bounding_box_diagonal(surface.positions),
                                     parts->counted.components(), parts->counted.total_genus()},
                                    made.skeleton, options.certificate, monitor);
        return made;
      });
  result.skeleton = certified->skeleton;
  result.certificate = certified->certificate;
  result.reused = only_reused(taken, result.times);
  for (ComponentResult& one : results) one = taken_over(one);
  return {std::move(result), parts, std::move(results)};
}

void require_valid(const ExtractOptions& options) {
  constexpr OptionRange refined{0, 1e6};
  const OptionCheck check("ExtractOptions");
  check.number("resolution", options.resolution, {});
  check.number("least_resolution", options.least_resolution, refined);
  check.number("threads", options.threads, thread_range);
  require_valid(options.fair);
  require_valid(options.contraction);
  require_valid(options.surgery);
  require_valid(options.embed);
  require_valid(options.certificate);
}

ExtractOptions admitted(const Surface& surface, const ExtractOptions& options) {
  require_valid(options);
  require_closed_manifold(surface, "extract", options.threads);
  for (const auto& rim : options.rims) {
    for (const std::int32_t vertex : rim) {
      if (vertex >= 0 && vertex < surface.positions.rows()) continue;
      throw Error(Fault::usage, "ExtractOptions::rims has vertex " + std::to_string(vertex) +
                                    ", needed 0.." + std::to_string(surface.positions.rows() - 1));
    }
  }
  ExtractOptions its = options;
  its.fair.threads = its.contraction.threads = its.certificate.threads = options.threads;
  return its;
}

Extraction extract(const Surface& surface, const ExtractOptions& options, const Monitor& monitor) {
  const ExtractOptions its = admitted(surface, options);
  return carry_out_plans(extraction_plans(surface, its, nullptr), monitor).extraction;
}

Extraction extract(const Surface& surface, const ExtractOptions& options, const Monitor& monitor,
                   ExtractionCache& cache) {
  const ExtractOptions its = admitted(surface, options);
  ExtractionCache::Implementation& kept = cache.implementation();
  kept.keep_only(surface);
  return carry_out_plans(extraction_plans(surface, its, &kept), monitor).extraction;
}

}  // namespace curveskel
