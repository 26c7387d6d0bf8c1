// Where the nodes go: central, inside, smooth; without spurs.
#pragma once

#include "skeleton/circles.hpp"
#include "skeleton/curve_skeleton.hpp"
#include "skeleton/network.hpp"
#include "surface/inscribed_balls.hpp"
#include "surface/monitor.hpp"
#include "surface/surface.hpp"
#include "surface/tree.hpp"

namespace curveskel {

struct EmbedOptions {
  double detail = 0.5;    ///< 0..1: how blunt a branch may be and stay; 1 keeps nearly all
  double merge = 1;       ///< junctions nearer than this x the inscribed radius become one
  double straight = 0.5;  ///< of a junction's inscribed radius: branches run straight within it
  double straight_at_last = 0.9;  ///< the same, once everything has found its place
  int first_rounds = 3;           ///< of centring and smoothing before tips and spurs are judged
  int relax_rounds = 10;          ///< of centring and smoothing
  int smooth_rounds = 8;          ///< the same, within what is known to be inside
  double keep_radius = 0.8;       ///< share of its inscribed radius that a moved point must keep
  double tip_reach = 1.5;         ///< what ends within this x the local radius is cut back first
  double tip_gap = 1.25;  ///< tips grow until the surface ends within this x the local radius
};

/// The slenderness below which `detail` prunes a branch: 3 at 0, 1.5 at 0.5, 0 at 1.
[[nodiscard]] double slenderness_limit(double detail);

/// The first half: places the graph's nodes from the inscribed balls of the surface's vertices,
/// prunes, merges junctions, grows the tips, centres and smooths.
/// Precondition: one closed component with D = 1; `balls` are the vertices'; `tree` is over the
/// surface itself. Time is spent in rays against the tree, so that a coarse surface pays.
[[nodiscard]] Network lay_out(const Surface& surface, const SurfaceTree& tree,
                              const InscribedBalls& balls, const VertexGraph& graph,
                              const EmbedOptions& options, int threads, const Monitor& monitor);

/// The second half: what lay_out gave, within the surface that counts. Every edge is brought
/// inside, spurs of that surface go, all is smoothed once more where it stays inside.
/// `tree` is over the surface or the finer one that it was coarsened from; the radii are distances
/// to the tree's surface. The rest as in lay_out.
[[nodiscard]] CurveSkeleton settle(Network network, const Surface& surface, const SurfaceTree& tree,
                                   const InscribedBalls& balls, const VertexGraph& graph,
                                   const EmbedOptions& options, int threads,
                                   const Monitor& monitor);

}  // namespace curveskel
