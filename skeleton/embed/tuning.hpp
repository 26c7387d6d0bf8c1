// The constants of the embedding, in one place; docs/method.md says what chose each.
#pragma once

#include <algorithm>
#include <cstddef>

namespace curveskel {

/// Bounds of the distance between neighbouring points of an arc. D = 1.
struct SpacingTuning {
  double least = 1.0 / 400;  ///< points need not be nearer, however thin the limb
  double most = 1.0 / 60;
  double of_edge = 0.3;            ///< of the surface's mean edge, if that is more than `most`
  double straight = 1.0 / 200;     ///< points on straight runs are no nearer at last
  double bend = 0.1;               ///< inscribed radii: lesser bends are straight
  double least_bend = 1.0 / 3200;  ///< the same, however thin the limb

  /// For a part with this share of the extent of a whole, whose D these lengths are then of. A part
  /// is measured out by its own length, too: its points are no farther apart than a twentieth of
  /// it. The smaller the part, the less its straight runs have to tell.
  [[nodiscard]] SpacingTuning of_part(double share) const {
    SpacingTuning of;
    of.most = std::min(most / share, 3 * most);
    of.least = std::min(least / share, of.most);
    of.of_edge = of_edge;
    of.straight = std::min(straight / (share * share), most / share);
    of.bend = bend;
    of.least_bend = std::min(least_bend / (share * share), 4 * least_bend / share);
    return of;
  }
};

/// The middle of a limb, from rays in the plane across it.
struct SectionTuning {
  double ray_limit = 3;       ///< inscribed radii: farther off lies another limb
  double longest_step = 0.5;  ///< widths, where rays go on beyond the limit
};

/// Rounds of centring and smoothing.
struct RelaxTuning {
  double rest = 3e-3;             ///< inscribed radii: points that moved less are at rest
  double section_rest = 0.03;     ///< widths: a point that moved less keeps its section
  double section_turn = 0.1;      ///< the same for the direction across it, in radians
  double axes_hold = 0.1;         ///< weight of a junction's own place beside one axis
  double spur_margin = 1.05;      ///< a junction makes no leaf shorter than this x its radius
  double detour_reach = 0.9;      ///< of the smaller of two balls that hold each other's centre
  double detour_length = 1.4;     ///< chords: a longer way between such balls is cut
  double tip_keep = 0.95;         ///< share of its first radius that a tip keeps when centred
  double heading_way = 1.0 / 25;  ///< of D: the least length that a tip's heading is taken over
};

/// Ends of limbs.
struct TipTuning {
  double corner_reach = 1.75;  ///< inscribed radii: a curl into a narrow corner reaches so far
  double narrow = 0.3;         ///< of the radius before it: a narrower tip is in a corner
  double tolerance = 1.05;     ///< of the nearest distance ahead: a farther one is taken back
  double least_radius = 1.0 / 1000;  ///< of D: thinner tips do not grow
  double leaf_margin = 1.02;         ///< short leaves reach this x the junction's radius
  double leaf_narrowest = 0.4;       ///< of the junction's radius: the tip of such a leaf keeps it
};

/// Branches that the surgery did not make. Lengths in inscribed radii where a branch begins.
struct GrowthTuning {
  double least_branch = 1.5;
  double least_extension = 2;
  double least_branch_ball = 0.12;     ///< at the apex: less is a crease
  double least_extension_ball = 0.25;  ///< the same beyond a tip
  double most_ball = 1.2;              ///< a wider one is where the arc comes from
  double least_extension_prominence = 1.5;
  double entered = 0.6;  ///< a part is not entered while its places are this much nearer
  double beyond = 1.1;   ///< a tip that is nearer would be a spur
  double least_tip_ball = 0.2;
  std::size_t fewest_vertices = 8;  ///< fewer may be noise
};

/// Arcs that squeeze past a hollow.
struct BottleneckTuning {
  double wider = 2;           ///< times, in the narrowest place
  double cheaper = 3;         ///< times, on the whole
  double shortest = 1.0 / 3;  ///< of the old length: the limb must still be reached
};

struct EmbedTuning {
  SpacingTuning spacing;
  SectionTuning section;
  RelaxTuning relax;
  TipTuning tips;
  GrowthTuning growth;
  BottleneckTuning bottleneck;
  double prominence = 1.15;   ///< blunter branches go, and do not grow
  double convex_dent = 0.05;  ///< largest inscribed radii: shallower dents leave a body convex
  double spur = 1;  ///< leaves shorter than this x their junction's inscribed radius are pruned
};

}  // namespace curveskel
