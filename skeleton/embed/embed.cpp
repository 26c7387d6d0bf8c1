#include <curveskel/advanced/embed.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "base/option_ranges.hpp"
#include "skeleton/embed/embed_tuned.hpp"
#include "skeleton/embed/place/mirror.hpp"
#include "skeleton/embed/steps.hpp"
#include "surface/resample/canonical.hpp"

namespace curveskel {
namespace {

/// The graph's points as nodes, with their inscribed radii and the vertices that they stand for.
CurveSkeleton finished(const SkeletonGraph& graph, const Setting& in) {
  EmbeddedNodes nodes = skeleton_of(graph, in.partition.groups, &in.tree);
  nodes.skeleton.node_of_vertex =
      nearest_nodes(nodes, in.partition.group_of_vertex, in.working.balls().centres);
  return std::move(nodes.skeleton);
}

void require_same_vertices(const EmbedInput& input) {
  const PartitionGraph& partition = input.partition;
  const InscribedBalls& balls = input.balls;
  const Eigen::Index vertices = input.surface.positions.rows();
  if (partition.group_of_vertex.size() == vertices && balls.radii.size() == vertices &&
      balls.centres.rows() == vertices) {
    return;
  }
  throw Error(Fault::input, "embed: found a partition of " +
                                std::to_string(partition.group_of_vertex.size()) +
                                " vertices and " + std::to_string(balls.radii.size()) +
                                " balls, needed both of the " + std::to_string(vertices) +
                                " vertices of the surface");
}

}  // namespace

void require_valid(const EmbedOptions& options) {
  constexpr OptionRange radii{0, 1e3};
  const OptionCheck check("EmbedOptions");
  check.choice("method", options.method, embed_methods);
  check.number("detail", options.detail, share_range);
  check.number("merge", options.merge, radii);
  check.number("straight", options.straight, radii);
  check.number("straight_at_last", options.straight_at_last, radii);
  check.number("first_rounds", options.first_rounds, iteration_range);
  check.number("relax_rounds", options.relax_rounds, iteration_range);
  check.number("smooth_rounds", options.smooth_rounds, iteration_range);
  check.number("keep_radius", options.keep_radius, share_range);
  check.number("tip_reach", options.tip_reach, radii);
  check.number("tip_gap", options.tip_gap, radii);
}

std::optional<CurveSkeleton> embed_tuned(const EmbedInput& input, const EmbedOptions& options,
                                         const EmbedTuning& tuning, const EmbedDemand& demand,
                                         StepClock& clock, const Monitor& monitor) {
  const int threads = demand.threads;
  const Surface& surface = input.surface;
  const SurfaceTree& tree = input.tree;
  monitor.report("embed", 0);
  // The surface given, of which this one is a rounded copy, may lie as far beside it.
  const double rounding = options.go_below ? 2 * canonical_step : 0;
  HomologyGuard guard =
      clock("handle loops", [&] { return HomologyGuard(surface, monitor.stop, rounding, &tree); });
  const WorkingSurface working(surface, input.balls);
  const Spacing spacing = spacing_on(surface, tuning.spacing);
  const std::vector<MirrorPlane> planes = clock(
      "mirror planes", [&] { return mirror_planes(surface, tree, tuning.spacing.least, threads); });
  SkeletonGraph graph;
  Setting at_first{working, tree,    tree,  input.partition, options,     tuning,
                   spacing, threads, guard, planes,          monitor.stop};
  at_first.needs_all_handles = demand.all_handles;
  if (!embed_in_working_surface(graph, at_first, clock, monitor)) return std::nullopt;
  const SurfaceTree* const full_tree =
      clock("wait for the tree", [&] { return &input.full_tree(); });
  graph.forget_radii();
  const Setting at_last{working, *full_tree, tree,         input.partition,
                        options, tuning,     spacing,      threads,
                        guard,   planes,     monitor.stop, input.full_surface};
  embed_in_full_surface(graph, at_last, clock, monitor);
  CurveSkeleton skeleton = clock("radii", [&] { return finished(graph, at_last); });
  monitor.report("embed", 1);
  return skeleton;
}

CurveSkeleton embed(const EmbedInput& input, const EmbedOptions& options, int threads,
                    const Monitor& monitor, StepClock* steps) {
  require_valid(options);
  require_closed_manifold(input.surface, "embed", threads);
  require_same_vertices(input);
  StepClock unread;
  return *embed_tuned(input, options, {}, {threads}, steps != nullptr ? *steps : unread, monitor);
}

}  // namespace curveskel
