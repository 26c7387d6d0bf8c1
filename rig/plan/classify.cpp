#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/plan/roles.hpp"
#include "rig/plan/wings.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

// Shares of the body's height or size; means over artists' rigs lie well within.
struct LegLimits {
  double shortest;        ///< of the size
  double aside;           ///< of its length, that the tip lies beside the root at most
  double off_ground = 0;  ///< of the size: a low body's height is no measure
};
constexpr LegLimits upright_legs{0.1, 0.45};
constexpr LegLimits sprawling_legs{0.05, 0.8, 0.02};

bool reaches_ground(const CurveTree& tree, const LimbPair& pair, const LegLimits& limits) {
  const double off = std::max(near_ground * tree.height, limits.off_ground * tree.size);
  return pair.lowest < tree.ground + off;
}

bool is_leg(const CurveTree& tree, const LimbPair& pair, const LegLimits& limits = upright_legs) {
  const Vector3d& root = tree.nodes[idx(pair.root)];
  const Vector3d& tip = tree.nodes[idx(pair.ways.front().path.back())];
  const bool goes_down = tip.y() < root.y() - 0.1 * tree.height;
  const bool mostly_down = std::abs(tip.x() - root.x()) < limits.aside * pair.length;
  return reaches_ground(tree, pair, limits) && pair.length > limits.shortest * tree.size &&
         goes_down && mostly_down;
}

std::vector<int> legs_within(const CurveTree& tree, const Limbs& limbs, const LegLimits& limits) {
  std::vector<int> legs;
  for (int k = 0; k < static_cast<int>(limbs.pairs.size()); ++k) {
    if (is_leg(tree, limbs.pairs[idx(k)], limits)) legs.push_back(k);
  }
  return legs;
}

/// Short or sprawling ones, as a crocodile's, if there are two pairs and no others: arms may hang
/// so.
std::vector<int> find_legs(const CurveTree& tree, const Limbs& limbs) {
  std::vector<int> legs = legs_within(tree, limbs, upright_legs);
  if (!legs.empty()) return legs;
  std::vector<int> sprawling = legs_within(tree, limbs, sprawling_legs);
  return sprawling.size() == 2 ? sprawling : legs;
}

/// Of a body on one pair of legs a second pair, if it hangs down from another place of a trunk that
/// is not upright, is about as long, and long enough to stand on. A tyrannosaur's arms are not. It
/// may be lifted in a pose, else it stands, if aslant.
void add_second_legs(const CurveTree& tree, const Limbs& limbs, bool in_pose,
                     std::vector<int>& legs) {
  constexpr double about = 1.7;
  constexpr double nearly = 0.75;  // of the way down, as the other pair may be bent
  constexpr double apart = 0.1;    // of the size or height
  const LimbPair& standing = limbs.pairs[idx(legs.front())];
  const Vector3d& hips = tree.nodes[idx(standing.root)];
  for (int k = 0; k < static_cast<int>(limbs.pairs.size()); ++k) {
    const LimbPair& pair = limbs.pairs[idx(k)];
    const Vector3d& root = tree.nodes[idx(pair.root)];
    const double down = root.y() - tree.nodes[idx(pair.ways.front().path.back())].y();
    const double along = std::abs(root.z() - hips.z());
    const bool is_alike =
        pair.length * about > standing.length && pair.length < about * standing.length;
    const bool is_long_enough = pair.length > nearly * (root.y() - tree.ground);
    const bool is_elsewhere = along > apart * tree.size && along > std::abs(root.y() - hips.y());
    if (k == legs.front() || !is_alike || !is_long_enough || !is_elsewhere ||
        down < apart * tree.height) {
      continue;
    }
    if (!in_pose && !is_leg(tree, pair, sprawling_legs)) continue;
    legs.push_back(k);
    return;
  }
}

/// Limbs that reach the ground and are no legs are of a body with more of them: a scorpion.
bool has_other_feet(const CurveTree& tree, const Limbs& limbs, const PlanFound& found) {
  const double leg = limbs.pairs[idx(found.legs.front())].length;
  for (int k = 0; k < static_cast<int>(limbs.pairs.size()); ++k) {
    const LimbPair& pair = limbs.pairs[idx(k)];
    const bool is_known =
        k == found.arms || std::find(found.legs.begin(), found.legs.end(), k) != found.legs.end();
    if (!is_known && 2 * pair.length > leg && reaches_ground(tree, pair, upright_legs)) return true;
  }
  return false;
}

/// Of the upper pairs that begin no lower than the legs the one that reaches farthest sideways: not
/// the longest, which may be pigtails.
int find_arms(const CurveTree& tree, const Limbs& limbs, int leg) {
  const double hips = tree.nodes[idx(limbs.pairs[idx(leg)].root)].y();
  int arms = -1;
  double farthest = 0;
  for (int k = 0; k < static_cast<int>(limbs.pairs.size()); ++k) {
    const LimbPair& pair = limbs.pairs[idx(k)];
    if (k == leg || is_leg(tree, pair) || pair.length <= 0.12 * tree.size) continue;
    if (tree.nodes[idx(pair.root)].y() <= hips - 0.02 * tree.height) continue;
    const double aside = std::abs(tree.aside(pair.ways.front().path.back()));
    if (aside <= farthest) continue;
    farthest = aside;
    arms = k;
  }
  return arms;
}

struct Posture {
  double lean = 0;         // degrees of the trunk from upright
  double back = 0;         // of the size, that the trunk reaches behind the legs
  double tail = 0;         // the same but for the trunk's way up to the arms, and what lies beyond
  bool is_forked = false;  // it goes up ahead of the legs, and not down behind them, as a hen's
};

/// Up to the arms; where these begin in the ball of the hips, in which the curve may have one
/// junction or two, up to its top.
int top_of_trunk(const CurveTree& tree, const Limbs& limbs, int root, int arms) {
  const Vector3d& hips = tree.nodes[idx(root)];
  if (arms >= 0) {
    const int chest = limbs.pairs[idx(arms)].root;
    if ((tree.nodes[idx(chest)] - hips).norm() > tree.radii[idx(root)]) return chest;
  }
  int top = root;
  for (const int node : limbs.trunk) {
    if (tree.nodes[idx(node)].y() > tree.nodes[idx(top)].y()) top = node;
  }
  return top;
}

Posture posture_of(const CurveTree& tree, const Limbs& limbs, int leg, int arms) {
  constexpr double clearly = 0.1;  // of the size
  const int root = limbs.pairs[idx(leg)].root;
  const Vector3d& hips = tree.nodes[idx(root)];
  const int top = top_of_trunk(tree, limbs, root, arms);
  std::vector<char> goes_up(tree.nodes.size(), 0);
  for (const int node : ways_from(tree, root).path(top)) goes_up[idx(node)] = 1;
  if (top != root) {
    std::vector<char> seen = goes_up;
    for (const int node : part_of(tree, top, seen)) goes_up[idx(node)] = 1;
  }
  double rearmost = hips.z();
  bool rises_ahead = false;
  bool rises_behind = false;
  double rearmost_of_tail = hips.z();
  for (const int node : limbs.trunk) {
    const double z = tree.nodes[idx(node)].z();
    rearmost = std::min(rearmost, z);
    const double above = tree.nodes[idx(node)].y() - hips.y();
    const double ahead = z - hips.z();
    rises_ahead = rises_ahead || std::min(above, ahead) > clearly * tree.size;
    rises_behind = rises_behind || (above > 0 && -ahead > clearly * tree.size);
    if (goes_up[idx(node)] == 0) rearmost_of_tail = std::min(rearmost_of_tail, z);
  }
  const Vector3d trunk = tree.nodes[idx(top)] - hips;
  const double length = std::max(trunk.norm(), 1e-9 * tree.size);
  return {std::acos(std::clamp(trunk.y() / length, -1.0, 1.0)) * 180 / std::numbers::pi,
          (hips.z() - rearmost) / tree.size, (hips.z() - rearmost_of_tail) / tree.size,
          rises_ahead && rises_behind};
}

std::string rounded(double value) { return std::to_string(std::lround(value)); }

/// True if the trunk reaches above the arms: by half a head, which the shoulders of a body without
/// a head do, too.
bool has_shoulders(const CurveTree& tree, const Limbs& limbs, int arms) {
  constexpr double half_head = 1.0 / 16;  // of a human's height
  const double above = tree.nodes[idx(limbs.pairs[idx(arms)].root)].y() + half_head * tree.height;
  return std::any_of(limbs.trunk.begin(), limbs.trunk.end(), [&](int node) {
    return tree.nodes[idx(node)].y() + tree.radii[idx(node)] > above;
  });
}

/// Longer limbs than its legs and arms, up to the top: on these it stands, turned over, and its
/// legs here are ears.
bool is_upside_down(const CurveTree& tree, const Limbs& limbs, const PlanFound& found) {
  const double longest =
      std::max(limbs.pairs[idx(found.legs.front())].length, limbs.pairs[idx(found.arms)].length);
  const double top = tree.ground + (1 - near_ground) * tree.height;
  return std::any_of(limbs.pairs.begin(), limbs.pairs.end(), [&](const LimbPair& pair) {
    const int tip = pair.ways.front().path.back();
    return pair.length > longest && tree.nodes[idx(tip)].y() + tree.radii[idx(tip)] > top;
  });
}

/// Why what stands upright with a pair of upper limbs is no human; empty for a human.
std::string why_no_human(const CurveTree& tree, const Limbs& limbs, const PlanFound& found) {
  constexpr double shortest_arm = 1.0 / 3;  // of the leg: a rex has such arms, and a chair
  constexpr int most_cycles = 4;            // by folded hands, hands on hips, crossed legs
  if (tree.cycles > most_cycles) return "the curve has more cycles than a human has limbs; ";
  const double leg = limbs.pairs[idx(found.legs.front())].length;
  if (limbs.pairs[idx(found.arms)].length < shortest_arm * leg) {
    return "the upper limbs are shorter than a third of the legs; ";
  }
  if (is_upside_down(tree, limbs, found)) return "it stands upside down; ";
  return has_shoulders(tree, limbs, found.arms) ? "" : "nothing rises above the upper limbs; ";
}

void name_biped(const CurveTree& tree, const Limbs& limbs, bool in_pose, PlanFound& found) {
  const int leg = found.legs.front();
  const Posture posture = posture_of(tree, limbs, leg, found.arms);
  found.lean = posture.lean;
  const std::string leans = "the trunk leans by " + rounded(posture.lean) +
                            (std::lround(posture.lean) == 1 ? " degree, " : " degrees, ") +
                            rounded(100 * posture.back) + " % of the size lies behind the legs";
  const double leg_length = limbs.pairs[idx(leg)].length;
  const double arm_length = found.arms < 0 ? 0 : limbs.pairs[idx(found.arms)].length;
  constexpr double level = 90;
  constexpr double upright = level / 3;  // so stand people in robes, whose hem is no tail
  if (found.arms >= 0 && posture.lean < 35 && posture.tail < 0.2) {
    const std::string why = why_no_human(tree, limbs, found);
    if (why.empty()) found.plan = BodyKind::humanoid;
    found.reason = why + "one pair of legs and one of arms above them; " + leans;
  } else if (posture.lean >= level) {
    found.reason = "the upper end of the trunk lies below the hips; " + leans;
  } else if (found.arms >= 0 && arm_length > 1.3 * leg_length && posture.back < 0.6) {
    found.plan = BodyKind::bird;
    found.reason = "one pair of legs, wings longer than these; " + leans;
  } else if (found.arms >= 0 ||
             (posture.back > 0.1 && (posture.lean >= upright || (posture.is_forked && !in_pose)))) {
    found.plan = BodyKind::tailed_biped;
    found.reason = "one pair of legs; " + leans;
  } else {
    found.reason = "one pair of limbs reaches the ground, but there are neither arms nor a tail";
  }
}

/// With legs wide apart, as in a star jump: one sprawling pair, if what stands on it is human.
std::optional<PlanFound> straddling_human(const CurveTree& tree, const Limbs& limbs) {
  PlanFound found;
  found.legs = legs_within(tree, limbs, sprawling_legs);
  if (found.legs.size() != 1) return std::nullopt;
  found.arms = find_arms(tree, limbs, found.legs.front());
  name_biped(tree, limbs, false, found);
  if (found.plan != BodyKind::humanoid) return std::nullopt;
  found.is_astride = true;
  return found;
}

bool may_be_bird(BodyKind wanted) {
  return wanted == BodyKind::automatic || wanted == BodyKind::bird;
}

/// Of a bird that glides the legs may be drawn in, or left out.
bool spreads_wings(const CurveTree& tree, const Limbs& limbs, PlanFound& found) {
  const int wings = flat_wings(tree, limbs);
  if (wings < 0 || (!found.legs.empty() && found.legs.front() == wings)) return false;
  found.plan = BodyKind::bird;
  found.arms = wings;
  found.spreads_wings = true;
  found.reason = std::string("flat wings beside a level trunk, ") +
                 (found.legs.empty() ? "no pair of legs" : "one pair of legs");
  return true;
}

}  // namespace

PlanFound classify(const CurveTree& tree, const Limbs& limbs, BodyKind wanted, Standing standing) {
  PlanFound found;
  found.legs = find_legs(tree, limbs);
  const bool in_pose = standing == Standing::in_pose;
  if (found.legs.size() == 1) add_second_legs(tree, limbs, in_pose, found.legs);
  const std::size_t legs = found.legs.size();
  if (legs < 2 && may_be_bird(wanted) && spreads_wings(tree, limbs, found)) return found;
  const bool is_asked_for = wanted == BodyKind::fish && !limbs.trunk.empty();
  const bool looks_like_it = wanted == BodyKind::automatic && legs == 0 && is_fish(tree, limbs);
  if (is_asked_for || looks_like_it) {
    found.plan = BodyKind::fish;
    found.reason = is_asked_for ? "as asked"
                                : "a long level trunk with fins, none of which reaches the ground";
    found.legs.clear();
    return found;
  }
  if (legs == 0 && wanted == BodyKind::humanoid) {
    if (const std::optional<PlanFound> human = straddling_human(tree, limbs)) return *human;
  }
  if (legs == 0) {
    found.reason = "no pair of limbs that mirror each other reaches the ground";
    return found;
  }
  if (legs >= 3) {
    found.reason = std::to_string(legs) + " pairs of limbs reach the ground";
    found.legs.clear();
    return found;
  }
  if (legs == 2) {
    found.plan = BodyKind::quadruped;
    found.reason = "two pairs of limbs reach the ground";
  } else {
    found.arms = find_arms(tree, limbs, found.legs.front());
    name_biped(tree, limbs, in_pose, found);
  }
  if (in_pose && has_other_feet(tree, limbs, found)) {
    found.plan = BodyKind::other;
    found.reason = "more limbs reach the ground than legs";
    return found;
  }
  const bool fits = wanted == BodyKind::automatic || wanted == found.plan ||
                    (legs == 1 && wanted != BodyKind::quadruped && wanted != BodyKind::other &&
                     (wanted != BodyKind::humanoid || found.arms >= 0));
  if (!fits) {
    found.plan = BodyKind::other;
  } else if (wanted != BodyKind::automatic && wanted != found.plan) {
    found.reason = "as asked; " + found.reason;
    found.plan = wanted;
    found.is_forced = true;
  }
  return found;
}

}  // namespace curveskel
