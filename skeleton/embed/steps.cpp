#include "skeleton/embed/steps.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "skeleton/embed/arc_projection.hpp"
#include "skeleton/embed/branches/grow_branches.hpp"
#include "skeleton/embed/branches/mirror_branches.hpp"
#include "skeleton/embed/branches/prune.hpp"
#include "skeleton/embed/contain/bottleneck.hpp"
#include "skeleton/embed/contain/inside.hpp"
#include "skeleton/embed/ends/tips.hpp"
#include "skeleton/embed/first_course.hpp"
#include "skeleton/embed/place/convex_axis.hpp"
#include "skeleton/embed/place/junctions.hpp"
#include "skeleton/embed/place/mirror.hpp"
#include "skeleton/embed/place/relax.hpp"
#include "skeleton/embed/place/settle.hpp"

namespace curveskel {
namespace {

// Each step, in the order of the tables below.
namespace step {

bool start(SkeletonGraph& graph, const Setting& in) {
  auto course = first_course(in);
  if (!course) return false;
  graph = std::move(*course);
  return true;
}

bool widen_junctions(SkeletonGraph& graph, const Setting& in) {
  centre_junctions(graph, in.tree);
  return true;
}

bool merge(SkeletonGraph& graph, const Setting& in) {
  merge_junctions(graph, in.tree, in.guard, in.options.merge);
  return true;
}

bool straighten(SkeletonGraph& graph, const Setting& in) {
  straighten_at_junctions(graph, in.tree, in.options.straight, false);
  return true;
}

bool space(SkeletonGraph& graph, const Setting& in) {
  space_evenly(graph, in.tree, in.spacing);
  return true;
}

RelaxOptions relaxing(const Setting& in, int rounds) {
  RelaxOptions options;
  options.rounds = rounds;
  options.keep = in.options.keep_radius;
  options.tuning = in.tuning.relax;
  options.section = in.tuning.section;
  options.stop = in.stop;
  return options;
}

bool centre(SkeletonGraph& graph, const Setting& in) {
  relax(graph, in.tree, in.sections, relaxing(in, in.options.first_rounds), in.guard, in.threads);
  return true;
}

bool shape_ends(SkeletonGraph& graph, const Setting& in) {
  shape_tips(graph, in.tree, in.options.tip_reach, in.options.tip_gap, in.tuning.tips);
  lengthen_short_leaves(graph, in.tree, in.tuning.tips);
  return true;
}

bool prune(SkeletonGraph& graph, const Setting& in) {
  return prune_spurs(graph, in.tree, in.tuning.spur);
}

bool stay_inside(SkeletonGraph& graph, const Setting& in) {
  InsideOptions options;
  if (in.options.go_below) options.below = in.full;
  options.stop = in.stop;
  return keep_inside(graph, in.working, in.partition, in.tree, in.guard, options) == 0;
}

/// Takes a change only if it makes something to which a way inside is found.
template <typename Change>
bool change_inside(SkeletonGraph& graph, const Setting& in, const Change& change) {
  SkeletonGraph changed = graph;
  if (change(changed) == 0) return false;
  InsideOptions options;
  options.all_or_nothing = true;
  options.stop = in.stop;
  if (keep_inside(changed, in.working, in.partition, in.tree, in.guard, options) > 0) return false;
  graph = std::move(changed);
  return true;
}

bool widen_bottlenecks(SkeletonGraph& graph, const Setting& in) {
  return change_inside(graph, in, [&in](SkeletonGraph& changed) {
    return reroute_bottlenecks(changed, in.working, in.partition, in.tree, in.tuning.bottleneck,
                               in.stop);
  });
}

bool grow(SkeletonGraph& graph, const Setting& in) {
  return change_inside(graph, in, [&in](SkeletonGraph& changed) {
    return grow_branches(changed, in.working, in.tree, in.partition, in.tuning.prominence,
                         in.tuning.growth, in.stop, in.threads);
  });
}

bool complete_mirror_image(SkeletonGraph& graph, const Setting& in) {
  bool any = false;
  for (const MirrorPlane& plane : in.mirror_planes) {
    const bool changed = change_inside(graph, in, [&in, &plane](SkeletonGraph& whole) {
      return mirror_branches(whole, plane.axis, in.working, in.tree, in.partition);
    });
    any = any || changed;
  }
  return any;
}

/// The cut divides a body without limbs anyhow: along any diagonal, and into corners. So its axis
/// takes the place of all that the cut would become.
bool draw_axis(SkeletonGraph& graph, const Setting& in) {
  if (in.guard.has_handles() || !is_convex(in.working, in.tree, in.tuning.convex_dent)) {
    return false;
  }
  return change_inside(graph, in, [&in](SkeletonGraph& changed) {
    changed = axis_of_convex_body(in.working.surface(), in.partition, in.tree, in.options.tip_reach,
                                  in.options.tip_gap, in.tuning.tips);
    return changed.living_arcs();
  });
}

/// Copies the graph where there are handles, and gives arcs that left theirs their points back.
template <typename Change>
bool keep_handles(SkeletonGraph& graph, const Setting& in, const Change& change) {
  if (!in.guard.has_handles()) return change();
  const SkeletonGraph before = graph;
  const bool result = change();
  in.guard.restore_arcs(before, graph, in.tree);
  return result;
}

/// Once no arc comes or goes: the places of junctions decide which leaves are spurs.
bool centre_at_last(SkeletonGraph& graph, const Setting& in) {
  constexpr int times_spaced = 3;  // the radii change as the points move
  SettleOptions settling;
  settling.keep = in.options.keep_radius;
  settling.tuning = in.tuning.relax;
  settling.section = in.tuning.section;
  settling.stop = in.stop;
  const auto projections = project_on_arcs(graph, in.working, in.partition, in.threads);
  settling.is_own = [&](int triangle, int arc) {
    const auto corners = in.working.surface().triangles.row(triangle);
    return std::any_of(corners.begin(), corners.end(),
                       [&](int vertex) { return projections[idx(vertex)].arc == arc; });
  };
  for (int spaced = 0; spaced < times_spaced; ++spaced) {
    keep_handles(graph, in, [&] {
      space_by_radius(graph, in.tree, in.spacing);
      return true;
    });
    const auto rounds_until = [&](int times) {
      return in.options.relax_rounds * times / times_spaced;
    };
    settling.rounds = rounds_until(spaced + 1) - rounds_until(spaced);
    settle(graph, in.tree, settling, in.guard, in.threads);
  }
  return true;
}

bool tell_apart(SkeletonGraph& graph, const Setting& /*in*/) {
  keep_simple(graph);
  return true;
}

bool tell_twins(SkeletonGraph& graph, const Setting& /*in*/) {
  tell_twins_apart(graph);
  return true;
}

bool thin(SkeletonGraph& graph, const Setting& in) {
  thin_out(graph, in.tree, in.spacing);
  return true;
}

bool thin_straight(SkeletonGraph& graph, const Setting& in) {
  thin_straight_runs(graph, in.tree, in.spacing, in.tuning.spacing);
  return true;
}

bool shortcut(SkeletonGraph& graph, const Setting& in) {
  cut_detours(graph, in.tree, in.tuning.relax);
  return true;
}

bool smooth(SkeletonGraph& graph, const Setting& in) {
  RelaxOptions smoothing = relaxing(in, in.options.smooth_rounds);
  smoothing.covered = true;
  relax(graph, in.tree, in.sections, smoothing, in.guard, in.threads);
  return true;
}

bool straighten_at_last(SkeletonGraph& graph, const Setting& in) {
  straighten_at_junctions(graph, in.tree, in.options.straight_at_last, true);
  return true;
}

bool mirror(SkeletonGraph& graph, const Setting& in) {
  for (const MirrorPlane& plane : in.mirror_planes) {
    if (!plane.exact) continue;  // the curve is in the middle of what is there
    change_inside(graph, in, [&in, &plane](SkeletonGraph& changed) {
      return mirror_arcs(changed, plane.axis, in.tree, in.options.keep_radius);
    });
  }
  return true;
}

bool lengthen(SkeletonGraph& graph, const Setting& in) {
  lengthen_short_leaves(graph, in.tree, in.tuning.tips);
  return true;
}

}  // namespace step

/// One change of the graph, known by its name to reports and to the viewer.
struct EmbedStep {
  std::string_view name;
  /// Returns true if the steps of `then` are to follow.
  bool (*apply)(SkeletonGraph& graph, const Setting& setting);
  /// Arcs that the step leads off their handle get their points back.
  bool guarded = false;
  std::span<const EmbedStep> then{};
};

/// Steps in their order.
struct EmbedPhase {
  std::span<const EmbedStep> steps;
  bool until_no_spur = false;  ///< spurs are pruned after the last step; if there were any, again
  double done = 0;             ///< share of the embedding that is done then, for progress
};

constexpr bool guarded = true;

constexpr EmbedStep prune_the_spurs{"prune spurs", step::prune};

constexpr std::array after_growth{
    EmbedStep{"straighten", step::straighten, guarded},
    EmbedStep{"space", step::space, guarded},
    EmbedStep{"centre", step::centre},
    prune_the_spurs,
};
constexpr std::array after_rerouting{
    after_growth[0],
    after_growth[1],
    after_growth[2],
    prune_the_spurs,
    EmbedStep{"shape tips", step::shape_ends},  // they were shaped as the old ways arrived
};

constexpr EmbedStep draw_the_axis{"axis of a convex body", step::draw_axis};

constexpr EmbedStep take_first_course{"first course", step::start};

constexpr std::array beginning{
    EmbedStep{"widen junctions", step::widen_junctions, guarded},
    EmbedStep{"merge junctions", step::merge},
};
constexpr std::array settling_branches{
    EmbedStep{"straighten", step::straighten, guarded},
    EmbedStep{"space", step::space, guarded},
    EmbedStep{"centre", step::centre},
    EmbedStep{"straighten", step::straighten, guarded},
    EmbedStep{"shape tips", step::shape_ends},
};
constexpr std::array branching{
    EmbedStep{"widen bottlenecks", step::widen_bottlenecks, false, after_rerouting},
    EmbedStep{"grow branches", step::grow, false, after_growth},
    EmbedStep{"complete the mirror image", step::complete_mirror_image, false, after_growth},
    EmbedStep{"merge junctions", step::merge},  // centred, they may have come together
};
constexpr std::array limb_phases{
    EmbedPhase{beginning, false, 0.2},
    EmbedPhase{settling_branches, true, 0.4},
    EmbedPhase{branching, false, 0.5},
};

constexpr std::array centring{
    EmbedStep{"mirror", step::mirror, guarded},
    EmbedStep{"centre at last", step::centre_at_last},
};
constexpr std::array centring_phases{EmbedPhase{centring, false, 0.6}};

constexpr std::array settling{
    EmbedStep{"keep inside", step::tell_apart},
    EmbedStep{"keep inside", step::stay_inside},
    EmbedStep{"thin out", step::thin, guarded},
    EmbedStep{"cut detours", step::shortcut, guarded},
    EmbedStep{"smooth", step::smooth},
    EmbedStep{"straighten at last", step::straighten_at_last, guarded},
    EmbedStep{"cut detours", step::shortcut, guarded},
    EmbedStep{"lengthen leaves", step::lengthen},
};
constexpr std::array at_last{
    EmbedStep{"mirror", step::mirror, guarded},
    EmbedStep{"thin straight runs", step::thin_straight, guarded},
    EmbedStep{"tell apart", step::tell_twins},
};
constexpr std::array full_phases{
    EmbedPhase{settling, true, 0.9},
    EmbedPhase{at_last, false, 0.95},
};

/// The radii stay with the points, so that the next step need not ask.
int points_outside(const SkeletonGraph& graph, const SurfaceTree& tree) {
  int count = 0;
  const auto add = [&](const CurvePoint& point) { count += point.radius(tree) < 0 ? 1 : 0; };
  for (const Node& node : graph.nodes) {
    if (node.alive) add(node.point);
  }
  for (const Arc& arc : graph.arcs) {
    if (arc.alive) std::for_each(arc.points.begin(), arc.points.end(), add);
  }
  return count;
}

bool run_step(const EmbedStep& one, SkeletonGraph& graph, const Setting& in, StepClock& clock,
              const Monitor& monitor) {
  throw_if_stopped(in.stop);
  const bool goes_on = clock(one.name, [&] {
    return one.guarded ? step::keep_handles(graph, in, [&] { return one.apply(graph, in); })
                       : one.apply(graph, in);
  });
  clock.found_outside(one.name, points_outside(graph, in.tree));
  if (goes_on) {
    for (const EmbedStep& next : one.then) run_step(next, graph, in, clock, monitor);
  }
  return goes_on;
}

void run_phases(std::span<const EmbedPhase> phases, SkeletonGraph& graph, const Setting& setting,
                StepClock& clock, const Monitor& monitor) {
  for (const EmbedPhase& phase : phases) {
    do {
      for (const EmbedStep& one : phase.steps) run_step(one, graph, setting, clock, monitor);
    } while (phase.until_no_spur && run_step(prune_the_spurs, graph, setting, clock, monitor));
    monitor.report("embed", phase.done);
  }
}

}  // namespace

bool embed_in_working_surface(SkeletonGraph& graph, const Setting& setting, StepClock& clock,
                              const Monitor& monitor) {
  if (!run_step(draw_the_axis, graph, setting, clock, monitor)) {
    if (!run_step(take_first_course, graph, setting, clock, monitor)) return false;
    run_phases(limb_phases, graph, setting, clock, monitor);
  }
  run_phases(centring_phases, graph, setting, clock, monitor);
  return true;
}

void embed_in_full_surface(SkeletonGraph& graph, const Setting& setting, StepClock& clock,
                           const Monitor& monitor) {
  run_phases(full_phases, graph, setting, clock, monitor);
}

}  // namespace curveskel
