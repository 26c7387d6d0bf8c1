#include "rig/plan/outlook.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/plan/frames.hpp"
#include "rig/plan/mirror_plane.hpp"
#include "rig/plan/standing.hpp"
#include "rig/plan/unposed.hpp"
#include "rig/plan/wings.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// In frames that are not the usual one: a tailed biped whose head is no lower than its hips, and
/// a bird with flat wings. No fish and no other bird, as any long thing and any cross is one from
/// somewhere.
bool is_seen_from_aside(const Outlook& outlook, double off) {
  constexpr double level = 90;  // degrees from upright
  const bool is_biped = outlook.found.plan == BodyKind::tailed_biped && outlook.found.lean < level;
  return off < symmetric && (is_biped || is_sure_bird(outlook));
}

double middle_along(const CurveTree& tree, int axis) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const Vector3d& node : tree.nodes) {
    least = std::min(least, node[axis]);
    most = std::max(most, node[axis]);
  }
  return 0.5 * (least + most);
}

/// A fish, or a bird on its legs, whose file has z up, which is as usual as y: nothing else was
/// seen by place. A column that stands is no fish: its belly is the image of its back.
std::optional<Outlook> animal_with_other_up(LookedAt& body,
                                            const std::vector<Eigen::Matrix3d>& frames,
                                            const PlanOptions& options) {
  for (const Eigen::Matrix3d& axes : frames) {
    if (axes.row(1) == frames.front().row(1)) continue;
    Outlook other = look(Sides::images, body, axes, options.plan);
    const bool is_standing_bird = other.found.plan == BodyKind::bird && !other.found.legs.empty();
    const bool is_seen = (other.found.plan == BodyKind::fish || is_standing_bird) &&
                         asymmetry(other.tree, 0, other.tree.middle) < symmetric &&
                         asymmetry(other.tree, 1, middle_along(other.tree, 1)) >= symmetric;
    if (is_seen) return other;
    break;  // no long thing from aside
  }
  return std::nullopt;
}

/// A trunk that lies across is one that is seen from its side.
bool lies_across(const CurveTree& tree, const Limbs& limbs) {
  Vector3d mean = Vector3d::Zero();
  for (const int node : limbs.trunk) mean += tree.nodes[idx(node)] / double(limbs.trunk.size());
  Vector3d spread = Vector3d::Zero();
  for (const int node : limbs.trunk) spread += (tree.nodes[idx(node)] - mean).cwiseAbs2();
  return std::sqrt(spread.x()) > 0.5 * std::hypot(std::sqrt(spread.y()), std::sqrt(spread.z()));
}

/// No fish and no bird, as any long thing and any cross is one in some pose; and nothing with
/// cycles, which are cut somewhere.
bool is_body_in_pose(const Outlook& outlook, const Explained& explained, BodyKind wanted) {
  const bool is_one = is_clear(outlook.found.plan) ||
                      outlook.found.plan == BodyKind::tailed_biped || outlook.found.plan == wanted;
  const std::vector<int>& legs = outlook.found.legs;
  const bool stands =  // another pair may be lifted
      legs.empty() || has_foot(outlook.tree, outlook.limbs.pairs[idx(legs.front())]);
  return is_one && stands && explained.share >= most_of_it && outlook.posed.cycles == 0 &&
         !lies_across(outlook.posed, outlook.limbs);
}

/// Why there is no plan: of the looks that show none the one that explains most of the curve.
struct Refusal {
  double length = -1;
  std::string reason;

  void consider(const Outlook& outlook) {
    const double explained = explained_by(outlook).length;
    if (outlook.found.plan != BodyKind::other || explained <= length) return;
    length = explained;
    reason = outlook.found.reason;
  }
};

/// Four feet on one ground are less of an accident than two: a stag that lies on its back stands on
/// its hind legs, with antlers for arms.
void prefer_four_feet(LookedAt& body, const std::vector<Eigen::Matrix3d>& frames,
                      const PlanOptions& options, Outlook& human) {
  for (const Eigen::Matrix3d& axes : frames) {
    if (axes.row(1) == human.axes.row(1)) continue;
    Outlook other = look(Sides::images, body, axes, options.plan);
    if (other.found.plan != BodyKind::quadruped) continue;
    if (asymmetry(other.tree, 0, other.tree.middle) >= symmetric) continue;
    human = std::move(other);
    return;
  }
}

Outlook best_by_place(LookedAt& body, const std::vector<Eigen::Matrix3d>& frames,
                      const PlanOptions& options, Refusal& refusal) {
  Outlook best = look(Sides::images, body, frames.front(), options.plan);
  refusal.consider(best);
  double off = asymmetry(best.tree, 0, best.tree.middle);
  if (is_clear(best.found.plan) && off < symmetric) {
    if (best.found.plan == BodyKind::humanoid) prefer_four_feet(body, frames, options, best);
    return best;
  }
  for (std::size_t k = 1; k < frames.size(); ++k) {
    Outlook other = look(Sides::images, body, frames[k], options.plan);
    refusal.consider(other);
    const double other_off = asymmetry(other.tree, 0, other.tree.middle);
    const bool is_bird = best.found.plan == BodyKind::bird && off < symmetric;
    if (is_bird && other.found.plan == BodyKind::humanoid) continue;  // that stands on its tail
    const bool is_better =
        is_clear(other.found.plan)
            ? !is_clear(best.found.plan) || other_off < off
            : best.found.plan == BodyKind::other && is_seen_from_aside(other, other_off);
    if (!is_better) continue;
    best = std::move(other);
    off = other_off;
  }
  for (std::size_t k = 0; k < frames.size() && best.found.plan == BodyKind::other; ++k) {
    Outlook other = look(Sides::own, body, frames[k], options.plan);
    refusal.consider(other);
    if (is_clear(other.found.plan)) best = std::move(other);
  }
  if (best.found.plan == BodyKind::other) {
    if (std::optional<Outlook> one = animal_with_other_up(body, frames, options)) return *one;
  }
  return best;
}

/// A human or a quadruped on its back, its front or a side. Nobody stands so, so nothing is left to
/// chance: its sides are images of each other, and it is all that there is. What stands on two legs
/// with a tail, as alike on both sides, does not lie.
std::optional<Outlook> best_lying(LookedAt& body, const PlanOptions& options,
                                  const Outlook& usual) {
  std::optional<Outlook> best;
  double least = symmetric;
  if (usual.found.plan == BodyKind::tailed_biped) {
    least = std::min(least, asymmetry(usual.tree, 0, usual.tree.middle));
  }
  for (const Eigen::Matrix3d& axes : frames_of_lying(options)) {
    const bool is_upside_down = axes.row(1).dot(usual.axes.row(1)) < 0;
    if (is_upside_down && usual.found.plan != BodyKind::other) continue;
    Outlook other = look(Sides::images, body, axes, options.plan);
    if (!is_clear(other.found.plan) || other.tree.cycles > 0) continue;
    const double off = asymmetry(other.tree, 0, other.tree.middle);
    if (off >= least || explained_by(other).share < most_of_it) continue;
    if (other.found.plan == BodyKind::humanoid && !has_trunk(other)) continue;
    least = off;
    best = std::move(other);
  }
  return best;
}

/// Of what is not made of tubes: in the usual frame anything, in others a bird, whose wings need
/// not be.
Outlook best_of_flat_parts(LookedAt& body, const PlanOptions& options) {
  const std::vector<Eigen::Matrix3d> frames = frames_of(options);
  Outlook best = look(Sides::images, body, frames.front(), options.plan);
  for (std::size_t k = 1;
       k < frames.size() && !is_clear(best.found.plan) && !best.found.spreads_wings; ++k) {
    Outlook other = look(Sides::images, body, frames[k], options.plan);
    const double off = asymmetry(other.tree, 0, other.tree.middle);
    if (is_sure_bird(other) && off < symmetric) best = std::move(other);
  }
  return best;
}

/// With legs wide apart, as in a star jump; in the usual frame alone, as from above any disc on
/// four legs is one, and if that is all there is.
std::optional<Outlook> human_astride(LookedAt& body, const Eigen::Matrix3d& axes) {
  Outlook other = look(Sides::images, body, axes, BodyKind::humanoid);
  const bool is_human = other.found.plan == BodyKind::humanoid && !other.found.is_forced &&
                        asymmetry(other.tree, 0, other.tree.middle) < symmetric &&
                        explained_by(other).share >= most_of_it && has_trunk(other);
  if (!is_human) return std::nullopt;
  return other;
}

Outlook best_of_tubes(LookedAt& body, const PlanOptions& options) {
  const std::vector<Eigen::Matrix3d> frames = frames_of(options);
  Refusal refusal;
  Outlook best = best_by_place(body, frames, options, refusal);
  if (!is_clear(best.found.plan)) {
    if (std::optional<Outlook> lying = best_lying(body, options, best)) return *lying;
  }
  Explained most = explained_by(best);
  for (std::size_t k = 0; k < frames.size() && !is_clear(best.found.plan); ++k) {
    Outlook other = look(Sides::posed, body, frames[k], options.plan);
    refusal.consider(other);
    const Explained explained = explained_by(other);
    if (!is_body_in_pose(other, explained, options.plan)) continue;
    if (best.found.plan != BodyKind::other && explained.length <= most.length) continue;
    most = explained;
    best = std::move(other);
  }
  for (std::size_t k = 0; k < frames.size() && best.found.plan == BodyKind::other; ++k) {
    Outlook other = look(Sides::completed, body, frames[k], options.plan);
    // From the side one arm hides the other, or seems to be missing.
    if (is_whole_but_for_a_limb(other) && !shows_side(other.tree)) best = std::move(other);
  }
  if (best.found.plan == BodyKind::other && options.plan == BodyKind::automatic) {
    if (std::optional<Outlook> human = human_astride(body, frames.front())) return *human;
  }
  if (best.found.plan == BodyKind::other && refusal.length >= 0) {
    best.found.reason = refusal.reason;
  }
  return best;
}

Outlook best_before_turning(LookedAt& body, const PlanOptions& options) {
  const bool may_be_any = options.made_of_tubes || options.plan != BodyKind::automatic;
  return may_be_any ? best_of_tubes(body, options) : best_of_flat_parts(body, options);
}

bool is_turned(const Outlook& outlook, const PlanOptions& options) {
  if (options.front != Direction::automatic) return false;
  const auto& [axes, tree, limbs, found, sides, posed] = outlook;
  if (found.plan == BodyKind::quadruped) {
    return looks_back(tree, limbs, found,
                      sides == Sides::posed ? Standing::in_pose : Standing::on_all_feet);
  }
  if (found.plan == BodyKind::fish) return swims_back(tree, limbs);
  if (found.plan == BodyKind::bird && found.legs.empty()) {
    return flies_back(tree, limbs, found.arms);
  }
  const bool is_human = found.plan == BodyKind::humanoid && !found.legs.empty();
  const bool has_toes =
      is_human || found.plan == BodyKind::bird || found.plan == BodyKind::tailed_biped;
  if (!has_toes || options.faces_minus_z) return false;
  if (is_human && sides != Sides::images) {
    return legs_bend_back(sides == Sides::posed ? posed : tree, limbs, found);
  }
  return toes_point_back(tree, limbs, found);
}

/// Of a human who is asked for.
bool hides_limbs(const Outlook& outlook) {
  return outlook.found.plan == BodyKind::other ||
         (outlook.found.is_forced && !shows_all_limbs(outlook));
}

/// The same body from its other side, where other limbs may be what is seen first.
Outlook turned_round(LookedAt& body, const Outlook& outlook, const PlanOptions& options) {
  const Eigen::Matrix3d axes =
      Eigen::Vector3d(-1, 1, -1).asDiagonal() * outlook.axes;  // left, up, front
  if (outlook.found.hidden) return as_standing(look(outlook.sides, body, axes, BodyKind::other));
  Outlook same = look(outlook.sides, body, axes, options.plan);
  if (same.found.plan == outlook.found.plan) return same;
  PlanOptions turned = options;
  turned.up = direction_of(axes.row(1));
  turned.front = direction_of(axes.row(2));
  return best_before_turning(body, turned);
}

}  // namespace

bool is_alike_from_both_ends(const Outlook& outlook) {
  if (outlook.sides != Sides::images && outlook.sides != Sides::posed) return false;
  const CurveTree& tree = outlook.sides == Sides::posed ? outlook.posed : outlook.tree;
  const double off = asymmetry(tree, 2, middle_along(tree, 2));
  const bool is_in_pose = outlook.sides == Sides::posed;
  return off < (is_in_pose ? symmetric : std::max(symmetric, asymmetry(tree, 0, tree.middle)));
}

Outlook best_outlook(const Surface& surface, const CurveSkeleton& skeleton,
                     const PlanOptions& options) {
  LookedAt body(surface, skeleton);
  Outlook outlook = best_before_turning(body, options);
  if (options.plan == BodyKind::humanoid && options.by_proportion && hides_limbs(outlook)) {
    std::optional<Outlook> standing = best_standing(body, options);
    if (standing) {
      outlook = std::move(*standing);
    } else if (outlook.found.plan == BodyKind::other) {
      outlook.found.reason.insert(0, "it is not upright, and ");
    }
  }
  if (is_turned(outlook, options)) outlook = turned_round(body, outlook, options);
  if (outlook.sides == Sides::posed) move_spread(outlook.posed, outlook.tree);
  const std::vector<Eigen::Matrix3d> usual = frames_of(options);
  if (std::none_of(usual.begin(), usual.end(), [&](const Eigen::Matrix3d& axes) {
        return axes.row(1) == outlook.axes.row(1);
      })) {
    outlook.found.reason.insert(0, "lying: ");
  }
  return outlook;
}

}  // namespace curveskel
