#include "skeleton/pipeline/component.hpp"

#include <algorithm>
#include <future>
#include <memory>
#include <optional>
#include <utility>

#include <curveskel/levels.hpp>
#include "base/parallel.hpp"
#include "skeleton/embed/embed_tuned.hpp"
#include "skeleton/embed/place/mirror.hpp"
#include "skeleton/lives/finer_branches.hpp"
#include "skeleton/pipeline/all_vertices.hpp"
#include "surface/resample/coarsen_whole.hpp"
#include "surface/resample/refine.hpp"

namespace curveskel {
namespace {

/// The tree over the canonical surface. It takes as long as coarsening it; so it grows beside the
/// stages that leave a core idle.
class GrowingTree {
 public:
  GrowingTree(Shared<Canonical> canonical, ComponentStages& stages, bool keep, int threads)
      : canonical_(std::move(canonical)), stages_(stages), keep_(keep), threads_(threads) {
    if (stages.tree.value && stages.tree.key == std::tuple(canonical_)) tree_ = stages.tree.value;
  }
  void start() {
    if (tree_ || growing_.valid()) return;
    growing_ = in_background(threads_, [surface = &canonical_->surface, threads = threads_] {
      return SurfaceTree(*surface, threads);
    });
  }
  const Shared<SurfaceTree>& get() {
    start();
    if (!tree_) {
      tree_ = std::make_shared<const SurfaceTree>(growing_.get());
      if (keep_) stages_.tree = {canonical_, tree_};
    }
    return tree_;
  }

 private:
  Shared<Canonical> canonical_;
  ComponentStages& stages_;
  bool keep_;
  int threads_;
  Shared<SurfaceTree> tree_;
  std::future<SurfaceTree> growing_;
};

/// Rounds of smoothing of the centres that the contraction is drawn to.
constexpr int target_rounds = 2;

/// One component, from its canonical form to its skeleton.
class Pipeline {
 public:
  Pipeline(Shared<Canonical> canonical, const Part& part, const ExtractOptions& options,
           const Monitor& monitor, ComponentStages& kept, StageRun& stage, GrowingTree& fine)
      : canonical_(std::move(canonical)),
        size_(part.size),
        extent_(part.extent),
        options_(options),
        monitor_(monitor),
        kept_(kept),
        stage_(stage),
        fine_(fine) {}

  /// Null if no cycles go round all handles although they have to.
  Shared<CurveSkeleton> run(ComponentRecord& record, TryLog& log, const TriesOf& of,
                            bool needs_all_handles) {
    const Shared<Surface> source = source_surface();
    const Shared<Coarsened> working = working_surface(source);
    record.working_vertices = static_cast<int>(working->surface.positions.rows());
    if (options_.embed.method == EmbedMethod::none) {
      using Made = Shared<CurveSkeleton>;
      const std::vector<Plan<Made>> only{
          {try_as_asked, [](const Plan<Made>::SoFar&) { return std::string(); },
           [&](const Plan<Made>::Room& room) {
             return as_contracted(*source, working, record, room.monitor);
           }}};
      return best_of(carry_out(
          only, of, [](const Made&, const Made*) { return true; },
          [](const Made&) { return std::nullopt; }, monitor_, log));
    }
    const Shared<WorkingBalls> balls = balls_in(*source, working);
    auto lives = started_lives(working);
    const Cut cut = best_of(carry_out(
        plans(working, balls, record), of, [](const Cut&, const Cut*) { return true; },
        [](const Cut&) { return std::nullopt; }, monitor_, log));
    auto skeleton = embedded(cut, *balls, lives, needs_all_handles);
    if (skeleton && stage_.keeps()) kept_.lives = {{working}, lives.get()};
    return skeleton;
  }

 private:
  using Lives = std::shared_future<Shared<std::vector<TipLife>>>;

  /// Beside the contraction, which leaves a core idle. Those kept are there already.
  Lives started_lives(const Shared<Coarsened>& working) {
    if (kept_.lives.value && kept_.lives.key == std::tuple(working)) {
      return in_background(1, [kept = kept_.lives.value] { return kept; }).share();
    }
    return in_background(options_.threads,
                         [working, stop = monitor_.stop] {
                           return std::make_shared<const std::vector<TipLife>>(
                               lives_of(working->surface, stop));
                         })
        .share();
  }

  /// By fewer samples where there are few vertices.
  static std::vector<TipLife> lives_of(const Surface& surface, const std::stop_token& stop) {
    constexpr int vertices_per_sample = 64;
    LifeOptions lives;
    lives.samples = std::clamp(static_cast<int>(surface.positions.rows()) / vertices_per_sample, 8,
                               lives.samples);
    lives.threads = 1;
    Monitor silent;
    silent.stop = stop;
    return tip_lives(surface, lives, silent);
  }

  /// A surface that is cut, and where.
  struct Cut {
    Shared<PartitionGraph> graph;
    Shared<Surface> surface;
    Shared<InscribedBalls> balls;
    Shared<Eigen::VectorXi> vertex_of_canonical;
  };

  /// Each is made if the surgery gave up before.
  std::vector<Plan<Cut>> plans(const Shared<Coarsened>& working, const Shared<WorkingBalls>& balls,
                               ComponentRecord& record) {
    using SoFar = Plan<Cut>::SoFar;
    const auto by_contraction = [&](ContractionAttempt& kept, const ContractionOptions& options) {
      return [&, options](const Plan<Cut>::Room& room) {
        return cut_by_contraction(working, balls, options, kept, record, room.monitor);
      };
    };
    const auto if_given_up = [](const SoFar& so_far) -> std::optional<std::string> {
      if (so_far.best || !so_far.first || !so_far.first->gave_up) return std::nullopt;
      return so_far.last->message;
    };
    ContractionOptions gentler = options_.contraction;
    gentler.contraction_weight /= 3;
    gentler.contraction_growth = 1 + (gentler.contraction_growth - 1) / 3;
    gentler.collapse_length /= 2;
    return {{try_as_asked, [](const SoFar&) { return std::string(); },
             by_contraction(kept_.contractions[0], options_.contraction)},
            {try_gentler, if_given_up, by_contraction(kept_.contractions[1], gentler)},
            {try_level_sets, if_given_up, [&](const Plan<Cut>::Room& room) {
               return cut_by_level_sets(*working, balls, room.monitor);
             }}};
  }

  Shared<Surface> source_surface() {
    if (!options_.fairing) return {canonical_, &canonical_->surface};
    return stage_("fair", kept_.faired, {canonical_, what_counts(options_.fair)},
                  [&] { return fair(canonical_->surface, options_.fair, monitor_); });
  }

  [[nodiscard]] CoarsenOptions coarsening() const { return {size_.most, options_.threads}; }

  /// True if the halfway surface can stand in for the full one until the full tree has grown.
  [[nodiscard]] bool has_halfway(const Surface& source) const {
    return coarsens_in_parts(source.positions.rows(), coarsening());
  }

  Shared<Coarsened> working_surface(const Shared<Surface>& source) {
    if (!has_halfway(*source)) fine_.start();
    auto working = stage_("coarsen", kept_.working, {source, size_}, [&]() -> Coarsened {
      const auto vertices = static_cast<int>(source->positions.rows());
      if (vertices >= size_.least) return coarsen_whole(*source, coarsening(), monitor_);
      return {
          refine(*source, size_.least), Eigen::VectorXi::LinSpaced(vertices, 0, vertices - 1), {}};
    });
    fine_.start();
    return working;
  }

  Shared<WorkingBalls> balls_in(const Surface& source, const Shared<Coarsened>& working) {
    const auto plant_near = [&] {
      if (has_halfway(source)) return SurfaceTree(working->halfway, options_.threads);
      if (options_.fairing) return SurfaceTree(source, options_.threads);
      return fine_.get()->in_frame(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 1);
    };
    return stage_("balls", kept_.balls, {working}, [&] {
      SurfaceTree rough(working->surface, options_.threads);
      SurfaceTree near = plant_near();
      InscribedBalls balls =
          inscribed_balls(working->surface, near, options_.threads, monitor_.stop);
      Positions targets = smoothed_centres(
          working->surface, balls,
          working->surface.positions.rows() < source.positions.rows() ? target_rounds : 0);
      return WorkingBalls{std::move(rough), std::move(near), std::move(balls), std::move(targets)};
    });
  }

  Cut cut_by_contraction(const Shared<Coarsened>& working, const Shared<WorkingBalls>& balls,
                         const ContractionOptions& options, ContractionAttempt& kept,
                         ComponentRecord& record, const Monitor& monitor) {
    const Shared<Contraction> contracted =
        stage_("contract", kept.contraction, {balls, what_counts(options)},
               [&] { return contract(working->surface, balls->targets, options, monitor); });
    const auto graph = stage_("surgery", kept.graph, {contracted, options_.surgery}, [&] {
      auto made = surgery(working->surface, *contracted, options_.surgery, monitor);
      const Surface& left = contracted->surface;
      if (made && monitor.curve) {
        show_curve(*made, left.positions(contracted->vertex_of_input, Eigen::all), monitor);
      }
      return made;
    });
    record.steps = contracted->steps;
    record.stop = contracted->stop;
    if (!*graph) throw GaveUp("the surgery found no cut of what the contraction left");
    return {{graph, &**graph},
            {working, &working->surface},
            {balls, &balls->balls},
            {working, &working->vertex_of_input}};
  }

  Cut cut_by_level_sets(const Coarsened& working, const Shared<WorkingBalls>& balls,
                        const Monitor& monitor) {
    const Shared<LevelSets> level_sets = stage_("surgery", kept_.level_sets, {balls}, [&] {
      LevelSets made;
      made.cut = level_set_graph(working.surface, monitor);
      made.vertex_of_input = made.cut.vertex_of_input(working.vertex_of_input);
      made.balls = inscribed_balls(made.cut.surface, balls->near, options_.threads, monitor_.stop);
      if (monitor.curve) show_curve(made.cut.graph, made.cut.surface.positions, monitor);
      return made;
    });
    return {{level_sets, &level_sets->cut.graph},
            {level_sets, &level_sets->cut.surface},
            {level_sets, &level_sets->balls},
            {level_sets, &level_sets->vertex_of_input}};
  }

  /// Without embedding: one contraction, and balls only where its flow is drawn to them.
  Shared<CurveSkeleton> as_contracted(const Surface& source, const Shared<Coarsened>& working,
                                      ComponentRecord& record, const Monitor& monitor) {
    const Shared<WorkingBalls> balls =
        options_.contraction.flow == Flow::medial ? balls_in(source, working) : nullptr;
    StagesAsContracted& kept = kept_.as_contracted;
    const Shared<Contraction> contracted = stage_(
        "contract", kept.contraction, {working, balls, what_counts(options_.contraction)}, [&] {
          return contract(working->surface, balls ? balls->targets : Positions(0, 3),
                          options_.contraction, monitor);
        });
    const Shared<SkeletonAsContracted> operated =
        stage_("surgery", kept.operated, {contracted, options_.surgery}, [&] {
          auto made =
              skeleton_as_contracted(working->surface, *contracted, options_.surgery, monitor);
          if (monitor.curve) {
            monitor.curve({"surgery", 0, made.skeleton.nodes, made.skeleton.edges});
          }
          return made;
        });
    record.steps = contracted->steps;
    record.stop = contracted->stop;
    if (operated->level_sets) monitor.say("the surgery gave up, so level sets cut the surface");
    return stage_("embed", kept.skeleton, {operated}, [&] {
      CurveSkeleton skeleton = operated->skeleton;
      skeleton.radii = inscribed_radii(skeleton.nodes, *fine_.get());
      return on_model(std::move(skeleton), working->vertex_of_input);
    });
  }

  /// The graph of a surface whose vertices are there. Precondition: someone watches.
  static void show_curve(const PartitionGraph& graph, const Positions& vertices,
                         const Monitor& monitor) {
    monitor.curve({"surgery", 0, middles_of_groups(graph, vertices), graph.edges});
  }

  Shared<CurveSkeleton> embedded(const Cut& cut, const WorkingBalls& trees, const Lives& lives,
                                 bool needs_all_handles) {
    EmbedOptions embedding = options_.embed;
    embedding.detail = EmbedOptions().detail;  // a level is made of it below
    const Surface& surface = *cut.surface;
    const auto curve = stage_(
        "embed", kept_.curve, {cut.graph, embedding, extent_, needs_all_handles},
        [&](StepClock& steps) -> std::optional<EmbeddedCurve> {
          EmbedTuning tuning;
          tuning.spacing = tuning.spacing.of_part(extent_);
          // Most of the embedding's rays go against the working surface, which fits the cache.
          const auto fine_tree = [this]() -> const SurfaceTree& { return *fine_.get(); };
          auto skeleton = embed_tuned(
              {surface, trees.rough, fine_tree, *cut.balls, *cut.graph, &canonical_->surface},
              embedding, tuning, {options_.threads, needs_all_handles}, steps, monitor_);
          if (!skeleton) return std::nullopt;
          EmbeddedCurve made{std::move(*skeleton), {}};
          steps("lives", [&] {
            made.lives = *lives.get();  // what levels cut keeps its vertices' numbers
            set_lives(made.skeleton, made.lives);
            // Tips so clear that they stay at every level.
            draw_missing(made.skeleton, surface, made.lives, trees.rough, least_life(0));
          });
          return made;
        });
    if (!*curve) return nullptr;
    const double detail = options_.embed.detail;
    return stage_("level", kept_.skeleton, {curve, detail}, [&] {
      CurveSkeleton level = level_of((*curve)->skeleton, least_life(detail));
      if (detail > EmbedOptions().detail) {
        draw_missing(level, surface, (*curve)->lives, trees.rough, least_deficit(detail));
      }
      return on_model(std::move(level), *cut.vertex_of_canonical);
    });
  }

  /// The branches that `skeleton` lacks for tips with these lives.
  void draw_missing(CurveSkeleton& skeleton, const Surface& surface,
                    const std::vector<TipLife>& lives, const SurfaceTree& rough, double least) {
    const auto is_clear = [&](const TipLife& tip) { return tip.life >= least; };
    if (std::none_of(lives.begin(), lives.end(), is_clear)) return;
    const double tolerance = SpacingTuning().of_part(extent_).least;
    std::vector<int> mirror_axes;
    for (const MirrorPlane& plane : mirror_planes(surface, rough, tolerance, options_.threads)) {
      mirror_axes.push_back(plane.axis);
    }
    add_finer_branches(skeleton, surface, *fine_.get(), lives, mirror_axes, least, tolerance);
  }

  /// From the canonical frame to the model's, its vertex map from the component's vertices.
  [[nodiscard]] CurveSkeleton on_model(CurveSkeleton skeleton,
                                       const Eigen::VectorXi& vertex_of_canonical) const {
    skeleton.nodes = canonical_->to_model(skeleton.nodes);
    skeleton.radii *= canonical_->scale;
    const Eigen::VectorXi node_of_canonical = skeleton.node_of_vertex(vertex_of_canonical);
    skeleton.node_of_vertex = node_of_canonical(canonical_->vertex_of_input);
    return skeleton;
  }

  Shared<Canonical> canonical_;
  const WorkingSize& size_;
  double extent_;
  const ExtractOptions& options_;
  const Monitor& monitor_;
  ComponentStages& kept_;
  StageRun& stage_;
  GrowingTree& fine_;
};

/// The same, but for frames and curves of component `number`, which come in the canonical frame and
/// leave in the model's. Refers to both.
Monitor in_model(const Monitor& monitor, const Canonical& canonical, int number) {
  Monitor within = monitor;
  if (monitor.curve) {
    within.curve = [&monitor, &canonical, number](const CurveFrame& curve) {
      const Positions moved = canonical.to_model(curve.nodes);
      monitor.curve({curve.stage, number, moved, curve.edges, curve.made_in});
    };
  }
  if (!monitor.frame) return within;
  within.frame = [&monitor, &canonical, number](const Frame& frame) {
    const Surface moved{canonical.to_model(frame.surface.positions),
                        canonical.to_model(frame.surface.triangles)};
    monitor.frame({frame.stage, number, frame.iteration, frame.area_ratio, frame.volume_ratio,
                   frame.residual, moved, frame.made_in});
  };
  return within;
}

/// Without a skeleton if no cycles go round all handles although they have to.
ComponentResult made_once(const Part& part, const ExtractOptions& options, const Monitor& monitor,
                          ComponentStages* kept, TryLog& log, const TriesOf& of,
                          bool needs_all_handles) {
  ComponentStages passing;
  ComponentStages& stages = kept != nullptr ? *kept : passing;
  ComponentResult result;
  StageRun stage(result.times, result.reused, monitor, kept != nullptr);
  const Surface& surface = part.component.surface;
  result.record.vertices = static_cast<int>(surface.positions.rows());
  result.record.genus = part.genus;
  const Shared<Canonical> canonical = stage(
      "normalise", stages.canonical, {}, [&] { return canonical_form(surface, options.threads); });
  const Monitor within = in_model(monitor, *canonical, part.number);
  GrowingTree fine(canonical, stages, stage.keeps(), options.threads);
  result.skeleton = Pipeline(canonical, part, options, within, stages, stage, fine)
                        .run(result.record, log, of, needs_all_handles);
  result.tree = std::make_shared<const SurfaceTree>(
      fine.get()->in_frame(canonical->rotation, canonical->origin, canonical->scale));
  return result;
}

/// True if the component may be made from all its vertices should coarsening cost it handles.
bool may_be_finer(const Part& part, const ExtractOptions& options) {
  const auto vertices = static_cast<int>(part.component.surface.positions.rows());
  return options.all_vertices_if_failed && options.embed.method == EmbedMethod::own &&
         part.genus > 0 && part.size.most < vertices && is_quick_with_all(vertices);
}

}  // namespace

ComponentResult component_result(const Part& part, const ExtractOptions& options,
                                 const Monitor& monitor, ComponentStages* kept, TryLog& log,
                                 int part_of) {
  const TriesOf of{part.number, part_of, part_of};
  if (!may_be_finer(part, options)) return made_once(part, options, monitor, kept, log, of, false);
  ComponentStages passing;
  ComponentStages& stages = kept != nullptr ? *kept : passing;
  const int first = log.next();
  ComponentResult coarse = made_once(part, options, monitor, &stages, log, of, true);
  if (coarse.skeleton) return coarse;
  for (int n = first; n < log.next(); ++n) log.drop(n);
  const ExtractOptions finest = with_all_vertices(options);
  if (!stages.of_all_vertices) stages.of_all_vertices = std::make_shared<ComponentStages>();
  Part whole = part;
  whole.size.most =
      std::max(part.size.least, static_cast<int>(part.component.surface.positions.rows()));
  using Made = ComponentResult;
  const std::vector<Plan<Made>> finer{
      {try_all_vertices,
       [](const Plan<Made>::SoFar&) {
         return std::string("coarsened, the cycles do not go round all of its handles");
       },
       [&](const Plan<Made>::Room& room) {
         return made_once(whole, finest, room.monitor, stages.of_all_vertices.get(), room.log,
                          {part.number, room.number, part_of}, false);
       }}};
  auto so_far = carry_out(
      finer, of, [](const Made&, const Made*) { return true; },
      [](const Made&) { return std::nullopt; }, monitor, log);
  const bool is_finer = so_far.best.has_value();
  ComponentResult result = is_finer ? std::move(*so_far.best)
                                    : made_once(part, options, monitor, &stages, log, of, false);
  result.times.insert(result.times.begin(), coarse.times.begin(), coarse.times.end());
  result.has_all_vertices = is_finer;
  return result;
}

}  // namespace curveskel
