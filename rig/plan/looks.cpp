#include "rig/plan/looks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/plan/completed.hpp"
#include "rig/plan/mirror_plane.hpp"
#include "rig/plan/unposed.hpp"
#include "rig/plan/wings.hpp"

namespace curveskel {

bool is_clear(BodyKind plan) { return plan == BodyKind::humanoid || plan == BodyKind::quadruped; }

bool has_foot(const CurveTree& tree, const LimbPair& leg) {
  constexpr double highest = 0.2;
  const auto sole = [&](int tip) { return tree.nodes[idx(tip)].y() - tree.radii[idx(tip)]; };
  const LimbWay& way = leg.ways.front();  // one side may be a peg
  return std::min(sole(way.path.back()), sole(way.mirror.back())) <
         tree.ground + highest * tree.height;
}

Explained explained_by(const Outlook& outlook) {
  if (outlook.limbs.is_trunk.empty()) return {};  // too many tips to look at
  std::vector<char> is_explained = outlook.limbs.is_trunk;
  for (const LimbPair& pair : outlook.limbs.pairs) {
    for (const LimbWay& way : pair.ways) {
      for (const int node : way.path) is_explained[idx(node)] = 1;
      for (const int node : way.mirror) is_explained[idx(node)] = 1;
    }
  }
  const CurveTree& tree = outlook.sides == Sides::posed ? outlook.posed : outlook.tree;
  double explained = 0;
  double whole = 0;
  for (int node = 0; node < static_cast<int>(tree.nodes.size()); ++node) {
    for (const int next : tree.neighbours[idx(node)]) {
      if (next < node) continue;
      const double length = (tree.nodes[idx(node)] - tree.nodes[idx(next)]).norm();
      whole += length;
      if (is_explained[idx(node)] != 0 && is_explained[idx(next)] != 0) explained += length;
    }
  }
  return {explained, whole > 0 ? explained / whole : 1};
}

bool is_sure_bird(const Outlook& outlook) {
  return outlook.found.spreads_wings &&
         has_a_flat_end(outlook.tree, outlook.limbs, outlook.found.arms);
}

namespace {

/// Of some pair of legs next to nothing of the mean course lies within both.
bool legs_are_apart(const Outlook& outlook) {
  constexpr double least = 0.1;
  const auto& legs = outlook.found.legs;
  return std::any_of(legs.begin(), legs.end(), [&](int pair) {
    return share_within_both(outlook.tree, outlook.limbs.pairs[idx(pair)].ways.front()) < least;
  });
}

/// Joints are planned on the mean of both sides: of each limb most of it lies within both.
bool sides_are_alike(const Outlook& outlook) {
  constexpr double most = 0.5;
  std::vector<int> limbs = outlook.found.legs;
  if (outlook.found.arms >= 0) limbs.push_back(outlook.found.arms);
  return std::all_of(limbs.begin(), limbs.end(), [&](int pair) {
    return share_within_both(outlook.tree, outlook.limbs.pairs[idx(pair)].ways.front()) > most;
  });
}

/// True for an arm that would not reach below the hips if it hung: one with a hand does, so what is
/// on the other side alone is no weapon but forearm and hand.
bool is_stump(const CurveTree& tree, const LimbPair& arm, const LimbPair& leg) {
  constexpr double with_shoulder = 1.25;  // an arm's length counts from the middle of the chest
  const double trunk = (tree.nodes[idx(arm.root)] - tree.nodes[idx(leg.root)]).norm();
  return arm.length < with_shoulder * trunk;
}

constexpr double head_height = 0.125;  // of a human's

/// The node at which a limb leaves the mirror plane: what is made for one that is missing may begin
/// with a trunk of its own.
int fork_of(const CurveTree& tree, const LimbPair& pair) {
  const std::vector<int>& path = pair.ways.front().path;
  constexpr double near = 0.5;  // radii
  const auto is_apart = [&](int node) {
    return std::abs(tree.aside(node)) > near * tree.radii[idx(node)];
  };
  const auto first = std::find_if(path.begin(), path.end(), is_apart);
  return first == path.begin() ? pair.root : *std::prev(first);
}

/// True if the trunk goes on above the arms by a head.
bool has_head(const Outlook& outlook) {
  const CurveTree& tree = outlook.tree;
  const int chest = outlook.limbs.pairs[idx(outlook.found.arms)].root;
  const double above = tree.nodes[idx(chest)].y() + head_height * tree.height;
  return std::any_of(outlook.limbs.trunk.begin(), outlook.limbs.trunk.end(),
                     [&](int node) { return tree.nodes[idx(node)].y() > above; });
}

}  // namespace

bool has_trunk(const Outlook& outlook) {
  if (outlook.found.arms < 0 || outlook.found.legs.empty()) return false;
  const CurveTree& tree = outlook.tree;
  const auto height_of_fork = [&](int pair) {
    return tree.nodes[idx(fork_of(tree, outlook.limbs.pairs[idx(pair)]))].y();
  };
  const double trunk =
      height_of_fork(outlook.found.arms) - height_of_fork(outlook.found.legs.front());
  return trunk > head_height * tree.height;
}

bool is_whole_but_for_a_limb(const Outlook& outlook) {
  const PlanFound& found = outlook.found;
  if (found.plan != BodyKind::humanoid || found.arms < 0 || outlook.tree.cycles > 0) return false;
  const auto& pairs = outlook.limbs.pairs;
  return explained_by(outlook).share >= most_of_it && has_trunk(outlook) && has_head(outlook) &&
         !is_stump(outlook.tree, pairs[idx(found.arms)], pairs[idx(found.legs.front())]);
}

namespace {

/// By the middle of the box.
Outlook look_at_images(LookedAt& body, const Eigen::Matrix3d& axes, BodyKind wanted) {
  Outlook outlook{axes, body.tree(axes), {}, {}, Sides::images, {}};
  outlook.limbs = find_limbs(outlook.tree, pairs_by_place(outlook.tree));
  outlook.found = classify(outlook.tree, outlook.limbs, wanted);
  const bool is_seen = wanted == BodyKind::automatic && outlook.found.plan != BodyKind::other;
  if (is_seen && legs_are_apart(outlook)) {
    outlook.found.plan = BodyKind::other;
    outlook.found.reason += "; but left and right legs are apart";
  }
  for (const int leg : outlook.found.legs) {
    if (!is_seen || has_foot(outlook.tree, outlook.limbs.pairs[idx(leg)])) continue;
    outlook.found.plan = BodyKind::other;
    outlook.found.reason += "; but a leg ends above the shins";
    break;
  }
  return outlook;
}

/// True for a leg of which one side ends above the ground, on which the other one stands.
bool is_peg(const LimbPair& leg, const Completed& body) {
  const CurveTree& tree = body.tree;
  const LimbWay& way = leg.ways.front();
  const double ground = tree.ground + near_ground * tree.height;
  const auto lowest = [&](int node) { return tree.nodes[idx(node)].y() - tree.radii[idx(node)]; };
  const int left = way.path.back();
  if (tree.nodes[idx(tree.is_tip(left) ? left : way.mirror.back())].y() < ground) return false;
  bool stands = false;
  for (int node = tree.own_nodes; node < static_cast<int>(tree.nodes.size()); ++node) {
    stands = stands || lowest(node) < ground;
  }
  return stands;
}

bool may_be_human(BodyKind wanted) {
  return wanted == BodyKind::automatic || wanted == BodyKind::humanoid;
}

/// Whatever is asked for: what is made up is a human's or nothing.
void look_again(Outlook& outlook, Completed&& body) {
  outlook.tree = std::move(body.tree);
  outlook.limbs = find_limbs(outlook.tree, body.pairs);
  outlook.found = classify(outlook.tree, outlook.limbs, BodyKind::automatic);
  outlook.found.reason.insert(0, "one limb is not whole: ");
}

/// An arm or a leg whose one side is a stump is made like the other one.
void complete(Outlook& outlook, const TipPairs& pairs) {
  const PlanFound& found = outlook.found;
  const bool is_human = found.plan == BodyKind::humanoid && found.arms >= 0;
  for (int k = 0; k < static_cast<int>(outlook.limbs.pairs.size()); ++k) {
    const LimbPair& pair = outlook.limbs.pairs[idx(k)];
    std::optional<Completed> body = with_whole_limb(outlook.tree, pairs, pair.ways.front());
    if (!body) continue;
    const bool is_arm = is_human && k == found.arms;
    const bool is_short =
        is_arm ? is_stump(outlook.tree, pair, outlook.limbs.pairs[idx(found.legs.front())])
               : is_peg(pair, *body);
    if (!is_short) continue;
    Outlook whole = outlook;
    look_again(whole, std::move(*body));
    if (whole.found.plan != BodyKind::humanoid) continue;
    if (!is_human && !is_whole_but_for_a_limb(whole)) continue;
    outlook = std::move(whole);
    return;
  }
}

/// For bodies in which nothing is seen by the middle of the box: a weapon in one hand moves it, and
/// the hand's tip; half an arm does, too.
Outlook look_at_own_sides(LookedAt& body, const Eigen::Matrix3d& axes, BodyKind wanted) {
  Outlook moved{axes, body.tree(axes), {}, {}, Sides::own, {}};
  const std::vector<int> tips = tips_of(moved.tree);
  if (tips.size() > most_tips) return moved;
  moved.tree.middle = middle_of_tips(moved.tree, tips);
  const TipPairs pairs = pairs_by_place(moved.tree, Images::within_limbs);
  moved.limbs = find_limbs(moved.tree, pairs);
  moved.found = classify(moved.tree, moved.limbs, wanted);
  if (is_clear(moved.found.plan) && !sides_are_alike(moved)) {
    moved.found.plan = BodyKind::other;
    moved.found.reason += "; but left and right are not alike";
  }
  if (may_be_human(wanted)) complete(moved, pairs);
  return moved;
}

/// For humans without an arm or a leg: the longest limb that has no image has one now.
Outlook look_at_completed(LookedAt& body, const Eigen::Matrix3d& axes, BodyKind wanted) {
  Outlook outlook{axes, body.tree(axes), {}, {}, Sides::completed, {}};
  const std::vector<int> tips = tips_of(outlook.tree);
  if (tips.size() > most_tips || !may_be_human(wanted)) return outlook;
  outlook.tree.middle = middle_of_tips(outlook.tree, tips);
  const TipPairs pairs = pairs_by_place(outlook.tree);
  outlook.limbs = find_limbs(outlook.tree, pairs);
  std::optional<Completed> whole = with_missing_limb(outlook.tree, pairs, outlook.limbs);
  if (!whole) return outlook;
  look_again(outlook, std::move(*whole));
  if (outlook.found.plan != BodyKind::humanoid) outlook.found.plan = BodyKind::other;
  return outlook;
}

/// For bodies in a pose.
Outlook look_at_posed(LookedAt& body, const Eigen::Matrix3d& axes, BodyKind wanted) {
  Outlook outlook{axes, {}, {}, {}, Sides::posed, body.tree(axes)};
  outlook.limbs = find_limbs(outlook.posed, pairs_by_shape(outlook.posed));
  Unposed unposed = unpose(outlook.posed, outlook.limbs);
  outlook.tree = std::move(unposed.tree);
  outlook.limbs = std::move(unposed.limbs);
  outlook.found = classify(outlook.tree, outlook.limbs, wanted, Standing::in_pose);
  outlook.found.reason.insert(0, "in a pose, limbs by their shape: ");
  return outlook;
}

}  // namespace

Outlook look(Sides sides, LookedAt& body, const Eigen::Matrix3d& axes, BodyKind wanted) {
  switch (sides) {
    case Sides::images:
      break;
    case Sides::own:
      return look_at_own_sides(body, axes, wanted);
    case Sides::completed:
      return look_at_completed(body, axes, wanted);
    case Sides::posed:
      return look_at_posed(body, axes, wanted);
  }
  return look_at_images(body, axes, wanted);
}

}  // namespace curveskel
