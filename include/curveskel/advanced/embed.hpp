// Embedding: nodes that are central, inside and smooth; no spurs.
#pragma once

#include <functional>

#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/names.hpp>
#include <curveskel/advanced/step_clock.hpp>
#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

enum class EmbedMethod { own, none };

inline constexpr NameTable<EmbedMethod, 2> embed_methods{{
    {EmbedMethod::own, "own", "central, inside and smooth, without spurs"},
    {EmbedMethod::none, "none", "nodes stay where contraction and surgery leave them"},
}};

struct EmbedOptions {
  EmbedMethod method = EmbedMethod::own;  ///< none: `extract` leaves all below aside
  double detail = 0.5;    ///< 0..1: which branches `extract` shows, see `least_life`; `embed` makes
                          ///< the same ones at any
  double merge = 1;       ///< junctions nearer than this x the inscribed radius become one
  double straight = 0.5;  ///< of a junction's inscribed radius: branches run straight within it
  double straight_at_last = 0.9;  ///< the same, once everything has found its place
  int first_rounds = 3;           ///< of centring and smoothing before tips and spurs are judged
  int relax_rounds = 15;          ///< of centring and smoothing, junctions where axes meet
  int smooth_rounds = 8;          ///< the same, within balls known to be inside
  double keep_radius = 0.8;       ///< share of its inscribed radius that a moved point must keep
  double tip_reach = 1.5;         ///< leaves ending within this x the local radius are cut back
  double tip_gap = 1.15;  ///< tips grow until the surface ends within this x the local radius
  bool go_below = false;  ///< `extract` alone: where no balls lead on inside, arcs run just below
                          ///< the full surface: certain, but not central

  [[nodiscard]] bool operator==(const EmbedOptions&) const = default;
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const EmbedOptions& options);

/// A surface that the surgery has cut. Kept by reference.
struct EmbedInput {
  const Surface& surface;   ///< one closed component with D = 1
  const SurfaceTree& tree;  ///< over it
  /// Gives a tree over the surface that this one was coarsened from, or `tree`. Called once,
  /// half-way, so that the tree may grow till then.
  std::function<const SurfaceTree&()> full_tree;
  const InscribedBalls& balls;  ///< of the vertices
  const PartitionGraph& partition;
  const Surface* full_surface = nullptr;  ///< of `full_tree`; null if it is not at hand
};

/// Places the graph's nodes from the inscribed balls of the surface's vertices, prunes, merges
/// junctions, grows the tips, centres and smooths, all within the surface; then keeps every edge
/// inside the surface of `full_tree`, prunes spurs there and smooths once more. Radii are the
/// distances to that surface. Most of the time is spent in rays against `tree`: a coarse surface
/// pays. Seconds of its steps go to `steps`, if there is one.
[[nodiscard]] CurveSkeleton embed(const EmbedInput& input, const EmbedOptions& options, int threads,
                                  const Monitor& monitor, StepClock* steps = nullptr);

}  // namespace curveskel
