#include "skeleton/extract.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "skeleton/bands.hpp"
#include "skeleton/openings.hpp"
#include "surface/canonical.hpp"
#include "surface/coarsen.hpp"
#include "surface/inscribed_balls.hpp"
#include "surface/measures.hpp"
#include "surface/memory.hpp"
#include "surface/parallel.hpp"
#include "surface/refine.hpp"
#include "surface/topology.hpp"
#include "surface/tree.hpp"

namespace curveskel {
namespace {

using Clock = std::chrono::steady_clock;

/// Adds the time of each stage to the list, in the order of first use.
class StageClock {
 public:
  explicit StageClock(std::vector<StageTime>& times) : times_(times) {}

  template <typename Work>
  auto operator()(const char* stage, const Work& work) {
    const auto start = Clock::now();
    auto result = work();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    auto found = std::find_if(times_.begin(), times_.end(),
                              [&](const StageTime& t) { return t.stage == stage; });
    if (found == times_.end()) found = times_.insert(times_.end(), {stage, 0});
    found->seconds += seconds;
    return result;
  }

 private:
  std::vector<StageTime>& times_;
};

/// One component, from its canonical form to its skeleton there.
class Pipeline {
 public:
  Pipeline(const ExtractOptions& options, const Monitor& monitor, StageClock& clock)
      : options_(options), monitor_(monitor), clock_(clock) {}

  struct Result {
    CurveSkeleton skeleton;
    SurfaceTree tree;  // over the canonical surface
  };

  Result run(const Surface& canonical, int resolution, ComponentRecord& record) {
    Surface faired;
    if (options_.fairing) {
      faired = clock_("fair", [&] { return fair(canonical, options_.fair, monitor_); });
    }
    const Surface& source = options_.fairing ? faired : canonical;
    CoarsenOptions coarsening;
    coarsening.target_vertices = resolution;
    // The surface's own tree takes as long as coarsening it; where the halfway surface can stand in
    // for it, it grows beside the stages that leave a core idle.
    const bool has_halfway = coarsens_in_parts(source.positions.rows(), coarsening);
    const auto grow = [&](const Surface& surface) {
      return in_background(options_.threads, [&surface] { return SurfaceTree(surface); });
    };
    std::future<SurfaceTree> growing;
    if (!has_halfway) growing = grow(canonical);
    Coarsened working = clock_("coarsen", [&] { return at_resolution(source, coarsening); });
    if (has_halfway) growing = grow(canonical);
    record.working_vertices = static_cast<int>(working.surface.positions.rows());

    const SurfaceTree rough = clock_("balls", [&] { return SurfaceTree(working.surface); });
    std::optional<SurfaceTree> fine;
    const SurfaceTree near = clock_("balls", [&] {
      if (has_halfway) return SurfaceTree(working.halfway);
      if (options_.fairing) return SurfaceTree(source);
      fine = growing.get();
      return fine->in_frame(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 1);
    });
    auto balls =
        clock_("balls", [&] { return inscribed_balls(working.surface, near, options_.threads); });

    std::optional<VertexGraph> graph = graph_by_contraction(working.surface, balls, record);
    if (!graph) {
      BandGraph bands = clock_("surgery", [&] { return band_graph(working.surface, monitor_); });
      for (int& v : working.vertex_of_input) v = bands.vertex_of_input[v];
      working.surface = std::move(bands.surface);
      graph = std::move(bands.graph);
      balls = inscribed_balls(working.surface, near, options_.threads);
      record.bands = true;
    }

    // Most of the embedding's rays go against the working surface, which fits the cache.
    CurveSkeleton skeleton = clock_("embed", [&] {
      const auto finer = [&]() -> const SurfaceTree& {
        if (!fine) fine = growing.get();
        return *fine;
      };
      return embed(working.surface, rough, finer, balls, *graph, options_.embed, options_.threads,
                   monitor_);
    });
    Eigen::VectorXi node_of_vertex(canonical.positions.rows());
    for (Eigen::Index v = 0; v < node_of_vertex.size(); ++v) {
      node_of_vertex[v] = skeleton.node_of_vertex[working.vertex_of_input[v]];
    }
    skeleton.node_of_vertex = std::move(node_of_vertex);
    return {std::move(skeleton), std::move(*fine)};
  }

 private:
  Coarsened at_resolution(const Surface& source, const CoarsenOptions& coarsening) const {
    const auto vertices = static_cast<int>(source.positions.rows());
    if (vertices >= options_.least_resolution) return coarsen(source, coarsening, monitor_);
    return {refine(source, options_.least_resolution),
            Eigen::VectorXi::LinSpaced(vertices, 0, vertices - 1),
            {}};
  }

  std::optional<VertexGraph> graph_by_contraction(const Surface& working,
                                                  const InscribedBalls& balls,
                                                  ComponentRecord& record) {
    ContractionOptions contraction = options_.contraction;
    constexpr int most_attempts = 2;
    for (record.attempts = 1; record.attempts <= most_attempts; ++record.attempts) {
      Contraction contracted = clock_(
          "contract", [&] { return contract(working, balls.centres, contraction, monitor_); });
      auto graph = clock_("surgery",
                          [&] { return surgery(working, contracted, options_.surgery, monitor_); });
      record.steps = std::move(contracted.steps);
      record.stop = contracted.stop;
      if (graph) return graph;
      contraction.contraction_weight /= 3;
      contraction.contraction_growth = 1 + (contraction.contraction_growth - 1) / 3;
      contraction.collapse_length /= 2;
    }
    record.attempts = most_attempts;
    return std::nullopt;
  }

  const ExtractOptions& options_;
  const Monitor& monitor_;
  StageClock& clock_;
};

/// The surface's working vertices that a component gets.
int share_of_resolution(const ExtractOptions& options, Eigen::Index vertices, Eigen::Index all) {
  if (options.resolution <= 0) return static_cast<int>(vertices);
  const double share = double(options.resolution) * double(vertices) / double(all);
  return std::max(options.least_resolution, static_cast<int>(std::lround(share)));
}

/// Appends a component's skeleton, its vertex map going from local to whole.
void append(CurveSkeleton& whole, const CurveSkeleton& part, const std::vector<int>& whole_vertex) {
  const Eigen::Index nodes = whole.nodes.rows();
  const Eigen::Index edges = whole.edges.rows();
  whole.nodes.conservativeResize(nodes + part.nodes.rows(), 3);
  whole.nodes.bottomRows(part.nodes.rows()) = part.nodes;
  whole.radii.conservativeResize(nodes + part.nodes.rows());
  whole.radii.tail(part.nodes.rows()) = part.radii;
  whole.edges.conservativeResize(edges + part.edges.rows(), 2);
  whole.edges.bottomRows(part.edges.rows()) = part.edges.array() + static_cast<int>(nodes);
  for (std::size_t v = 0; v < whole_vertex.size(); ++v) {
    whole.node_of_vertex[whole_vertex[v]] =
        part.node_of_vertex[static_cast<Eigen::Index>(v)] + static_cast<int>(nodes);
  }
}

std::vector<int> vertices_in_whole(const Component& part, const Canonical& canonical) {
  std::vector<int> whole_vertex(part.vertex_in_whole.size());
  for (std::size_t v = 0; v < whole_vertex.size(); ++v) {
    whole_vertex[v] = part.vertex_in_whole[static_cast<std::size_t>(
        canonical.input_of_vertex[static_cast<Eigen::Index>(v)])];
  }
  return whole_vertex;
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
  result.skeleton.nodes.resize(0, 3);
  result.skeleton.edges.resize(0, 2);
  result.skeleton.node_of_vertex = Eigen::VectorXi::Constant(surface.positions.rows(), -1);

  for (std::size_t c = 0; c < parts.size(); ++c) {
    const Component& part = parts[c];
    const auto vertices = part.surface.positions.rows();
    ComponentRecord record;
    record.vertices = static_cast<int>(vertices);
    record.genus = counted.genus[c];
    const Canonical canonical =
        clock("normalise", [&] { return canonical_form(part.surface, options.threads); });
    auto [skeleton, tree] =
        Pipeline(options, monitor, clock)
            .run(canonical.surface,
                 share_of_resolution(options, vertices, surface.positions.rows()), record);
    skeleton.nodes = canonical.to_model(skeleton.nodes);
    skeleton.radii *= canonical.scale;
    append(result.skeleton, skeleton, vertices_in_whole(part, canonical));
    if (parts.size() == 1) {
      tree_of_all = tree.in_frame(canonical.rotation, canonical.origin, canonical.scale);
    }
    result.components.push_back(std::move(record));
  }
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
