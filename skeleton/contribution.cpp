#include "skeleton/contribution.hpp"

#include <future>
#include <optional>
#include <utility>

#include "skeleton/bands.hpp"
#include "skeleton/stage_clock.hpp"
#include "surface/canonical.hpp"
#include "surface/coarsen.hpp"
#include "surface/inscribed_balls.hpp"
#include "surface/parallel.hpp"
#include "surface/refine.hpp"

namespace curveskel {
namespace {

/// One component, from its canonical form to its skeleton there.
class Pipeline {
 public:
  Pipeline(const ExtractOptions& options, const Monitor& monitor, StageClock& clock)
      : options_(options), monitor_(monitor), clock_(clock) {}

  struct Result {
    CurveSkeleton skeleton;
    SurfaceTree tree;  // over the canonical surface
  };

  Result run(const Surface& canonical, const WorkingSize& size, ComponentRecord& record) {
    Surface faired;
    if (options_.fairing) {
      faired = clock_("fair", [&] { return fair(canonical, options_.fair, monitor_); });
    }
    const Surface& source = options_.fairing ? faired : canonical;
    CoarsenOptions coarsening;
    coarsening.target_vertices = size.most;
    coarsening.threads = options_.threads;
    // The surface's own tree takes as long as coarsening it; where the halfway surface can stand in
    // for it, it grows beside the stages that leave a core idle.
    const bool has_halfway = coarsens_in_parts(source.positions.rows(), coarsening);
    const auto grow = [&](const Surface& surface) {
      return in_background(options_.threads, [&surface] { return SurfaceTree(surface); });
    };
    std::future<SurfaceTree> growing;
    if (!has_halfway) growing = grow(canonical);
    Coarsened working =
        clock_("coarsen", [&] { return at_resolution(source, size.least, coarsening); });
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
  Coarsened at_resolution(const Surface& source, int least,
                          const CoarsenOptions& coarsening) const {
    const auto vertices = static_cast<int>(source.positions.rows());
    if (vertices >= least) return coarsen(source, coarsening, monitor_);
    return {refine(source, least), Eigen::VectorXi::LinSpaced(vertices, 0, vertices - 1), {}};
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

}  // namespace

Contribution contribution_of(const Component& part, int genus, const WorkingSize& size,
                             const ExtractOptions& options, const Monitor& monitor) {
  Contribution result;
  StageClock clock(result.times);
  result.record.vertices = static_cast<int>(part.surface.positions.rows());
  result.record.genus = genus;
  const Canonical canonical =
      clock("normalise", [&] { return canonical_form(part.surface, options.threads); });
  auto [skeleton, tree] =
      Pipeline(options, monitor, clock).run(canonical.surface, size, result.record);
  skeleton.nodes = canonical.to_model(skeleton.nodes);
  skeleton.radii *= canonical.scale;
  const Eigen::VectorXi node_of_canonical = std::move(skeleton.node_of_vertex);
  skeleton.node_of_vertex = node_of_canonical(canonical.vertex_of_input);
  result.skeleton = std::move(skeleton);
  result.tree = tree.in_frame(canonical.rotation, canonical.origin, canonical.scale);
  return result;
}

}  // namespace curveskel
