#include "rig/plan/outlook.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "rig/plan/completed.hpp"
#include "rig/plan/unposed.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

Vector3d vector_of(Direction direction) {
  switch (direction) {
    case Direction::x:
      return Vector3d::UnitX();
    case Direction::y:
      return Vector3d::UnitY();
    case Direction::z:
      return Vector3d::UnitZ();
    case Direction::minus_x:
      return -Vector3d::UnitX();
    case Direction::minus_y:
      return -Vector3d::UnitY();
    case Direction::minus_z:
      return -Vector3d::UnitZ();
    case Direction::automatic:
      break;
  }
  return Vector3d::Zero();
}

Eigen::Matrix3d axes_of(const Vector3d& up, const Vector3d& front) {
  Eigen::Matrix3d axes;
  axes << up.cross(front).transpose(), up.transpose(), front.transpose();
  return axes;
}

}  // namespace

std::vector<Eigen::Matrix3d> frames_of(const PlanOptions& options) {
  // The usual ones first: y up and z ahead, as in glTF, or z up and -y ahead, as in Blender; then
  // those of a body that looks aside.
  std::vector<Vector3d> ups{vector_of(options.up)};
  if (options.up == Direction::automatic) ups = {Vector3d::UnitY(), Vector3d::UnitZ()};
  if (options.up == Direction::automatic && options.z_is_up) std::swap(ups[0], ups[1]);
  std::vector<Eigen::Matrix3d> frames;
  const auto add = [&](const Vector3d& up, const Vector3d& front) {
    if (up.cross(front).norm() > 0) frames.push_back(axes_of(up, front));
  };
  for (const Vector3d& up : ups) {
    if (options.front != Direction::automatic) {
      add(up, vector_of(options.front));
      continue;
    }
    const bool lies_along_z = up.cross(Vector3d::UnitZ()).norm() == 0;
    const Vector3d usual =
        lies_along_z ? Vector3d(-Vector3d::UnitY()) : Vector3d(Vector3d::UnitZ());
    add(up, options.faces_minus_z ? Vector3d(-usual) : usual);
    add(up, up.cross(usual));
  }
  if (frames.empty()) {
    throw Error(Fault::usage,
                "up and front are one direction, needed two that are normal to each "
                "other; give another --up or --front");
  }
  return frames;
}

namespace {

/// The mean distance of the curve's mirror image from the curve, of the size.
double asymmetry(const CurveTree& tree, int axis, double middle) {
  constexpr std::size_t samples = 300;
  const std::size_t stride = 1 + tree.nodes.size() / samples;
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < tree.nodes.size(); k += stride) {
    Vector3d image = tree.nodes[k];
    image[axis] = 2 * middle - image[axis];
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3d& other : tree.nodes) least = std::min(least, (other - image).squaredNorm());
    sum += std::sqrt(least);
    ++count;
  }
  return sum / (std::max(count, 1) * tree.size);
}

constexpr double symmetric = 0.02;  // of the size, that a curve is off its mirror image

/// Between tips that may be images of each other, as hands are and feet: where most pairs agree.
std::vector<double> middles_of(const CurveTree& tree, const std::vector<int>& tips) {
  constexpr double unlike = 0.06;  // of the size, that tips differ but for their sides
  constexpr double apart = 0.002;  // of the size: nearer ones are one
  constexpr std::size_t most = 20;
  std::vector<double> middles;
  for (std::size_t a = 0; a < tips.size(); ++a) {
    for (std::size_t b = a + 1; b < tips.size(); ++b) {
      const Vector3d& p = tree.nodes[idx(tips[a])];
      const Vector3d& q = tree.nodes[idx(tips[b])];
      if (std::hypot(p.y() - q.y(), p.z() - q.z()) > unlike * tree.size) continue;
      middles.push_back(0.5 * (p.x() + q.x()));
    }
  }
  std::sort(middles.begin(), middles.end());
  std::vector<std::pair<int, double>> groups;  // minus how many agree, the middle one of them
  for (std::size_t first = 0; first < middles.size();) {
    std::size_t end = first + 1;
    while (end < middles.size() && middles[end] - middles[first] < apart * tree.size) ++end;
    groups.emplace_back(-static_cast<int>(end - first), middles[(first + end) / 2]);
    first = end;
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> result;
  for (const auto& [count, middle] : groups) {
    if (result.size() < most) result.push_back(middle);
  }
  return result;
}

/// That of the least asymmetry; the box's where there is no better one.
double middle_of_tips(const CurveTree& tree, const std::vector<int>& tips) {
  double best = tree.middle;
  double least = asymmetry(tree, 0, best);
  for (const double middle : middles_of(tree, tips)) {
    const double off = asymmetry(tree, 0, middle);
    if (off >= least) continue;
    least = off;
    best = middle;
  }
  return best;
}

/// Two pairs of limbs that are where they should be are no accident.
bool is_clear(BodyKind plan) { return plan == BodyKind::humanoid || plan == BodyKind::quadruped; }

/// Of some pair of legs next to nothing of the mean course lies within both.
bool legs_are_apart(const Outlook& outlook) {
  constexpr double least = 0.1;
  const auto& legs = outlook.found.legs;
  return std::any_of(legs.begin(), legs.end(), [&](int pair) {
    return share_within_both(outlook.tree, outlook.limbs.pairs[idx(pair)].ways.front()) < least;
  });
}

/// The middle of a human's shin lies in the lowest fifth: a leg whose tip does not has no foot
/// there, whatever of the surface about it is on the ground.
bool has_foot(const CurveTree& tree, const LimbPair& leg) {
  constexpr double highest = 0.2;
  const auto sole = [&](int tip) { return tree.nodes[idx(tip)].y() - tree.radii[idx(tip)]; };
  const LimbWay& way = leg.ways.front();  // one side may be a peg
  return std::min(sole(way.path.back()), sole(way.mirror.back())) <
         tree.ground + highest * tree.height;
}

Outlook look(const Surface& surface, const CurveSkeleton& skeleton, const Eigen::Matrix3d& axes,
             BodyKind wanted) {
  Outlook outlook{axes, curve_tree(surface, skeleton, axes), {}, {}, Sides::images, {}};
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

/// Joints are planned on the mean of both sides: of each limb most of it lies within both.
bool sides_are_alike(const Outlook& outlook) {
  constexpr double most = 0.5;
  std::vector<int> limbs = outlook.found.legs;
  if (outlook.found.arms >= 0) limbs.push_back(outlook.found.arms);
  return std::all_of(limbs.begin(), limbs.end(), [&](int pair) {
    return share_within_both(outlook.tree, outlook.limbs.pairs[idx(pair)].ways.front()) > most;
  });
}

/// The length of the curve that is trunk or in a pair of limbs.
struct Explained {
  double length = 0;
  double share = 0;
};

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

constexpr double most_of_it = 0.8;  // of the curve

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

/// True if the arms leave the trunk above the legs by a head: what forks twice in one place has no
/// trunk.
bool has_trunk(const Outlook& outlook) {
  const CurveTree& tree = outlook.tree;
  const auto height_of_fork = [&](int pair) {
    return tree.nodes[idx(fork_of(tree, outlook.limbs.pairs[idx(pair)]))].y();
  };
  const double trunk =
      height_of_fork(outlook.found.arms) - height_of_fork(outlook.found.legs.front());
  return trunk > head_height * tree.height;
}

/// True if the trunk goes on above the arms by a head.
bool has_head(const Outlook& outlook) {
  const CurveTree& tree = outlook.tree;
  const int chest = outlook.limbs.pairs[idx(outlook.found.arms)].root;
  const double above = tree.nodes[idx(chest)].y() + head_height * tree.height;
  return std::any_of(outlook.limbs.trunk.begin(), outlook.limbs.trunk.end(),
                     [&](int node) { return tree.nodes[idx(node)].y() > above; });
}

/// Nothing with cycles, which are cut somewhere, and nothing without a head and with stubs for
/// arms: of three limbs and a trunk many things are made.
bool is_whole_but_for_a_limb(const Outlook& outlook) {
  const PlanFound& found = outlook.found;
  if (found.plan != BodyKind::humanoid || found.arms < 0 || outlook.tree.cycles > 0) return false;
  const auto& pairs = outlook.limbs.pairs;
  return explained_by(outlook).share >= most_of_it && has_trunk(outlook) && has_head(outlook) &&
         !is_stump(outlook.tree, pairs[idx(found.arms)], pairs[idx(found.legs.front())]);
}

constexpr std::size_t most_tips = 1000;  // of a body, with all of its hair

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
Outlook second_look(const Surface& surface, const CurveSkeleton& skeleton,
                    const Eigen::Matrix3d& axes, BodyKind wanted) {
  Outlook moved{axes, curve_tree(surface, skeleton, axes), {}, {}, Sides::own, {}};
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
Outlook third_look(const Surface& surface, const CurveSkeleton& skeleton,
                   const Eigen::Matrix3d& axes, BodyKind wanted) {
  Outlook outlook{axes, curve_tree(surface, skeleton, axes), {}, {}, Sides::completed, {}};
  const std::vector<int> tips = tips_of(outlook.tree);
  if (tips.size() > most_tips || !may_be_human(wanted)) return outlook;
  outlook.tree.middle = middle_of_tips(outlook.tree, tips);
  const TipPairs pairs = pairs_by_place(outlook.tree);
  outlook.limbs = find_limbs(outlook.tree, pairs);
  std::optional<Completed> body = with_missing_limb(outlook.tree, pairs, outlook.limbs);
  if (!body) return outlook;
  look_again(outlook, std::move(*body));
  if (outlook.found.plan != BodyKind::humanoid) outlook.found.plan = BodyKind::other;
  return outlook;
}

/// In frames that are not the usual one: a tailed biped whose head is no lower than its hips.
/// No fish and no bird, as any long thing and any cross is one from somewhere.
bool is_seen_from_aside(const Outlook& outlook, double off) {
  constexpr double level = 90;  // degrees from upright
  return outlook.found.plan == BodyKind::tailed_biped && outlook.found.lean < level &&
         off < symmetric;
}

/// For bodies in a pose.
Outlook look_at_shape(const Surface& surface, const CurveSkeleton& skeleton,
                      const Eigen::Matrix3d& axes, BodyKind wanted) {
  Outlook outlook{axes, {}, {}, {}, Sides::posed, curve_tree(surface, skeleton, axes)};
  outlook.limbs = find_limbs(outlook.posed, pairs_by_shape(outlook.posed));
  Unposed unposed = unpose(outlook.posed, outlook.limbs);
  outlook.tree = std::move(unposed.tree);
  outlook.limbs = std::move(unposed.limbs);
  outlook.found = classify(outlook.tree, outlook.limbs, wanted, Standing::in_pose);
  outlook.found.reason.insert(0, "in a pose, limbs by their shape: ");
  return outlook;
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

Outlook best_by_place(const Surface& surface, const CurveSkeleton& skeleton,
                      const std::vector<Eigen::Matrix3d>& frames, const PlanOptions& options,
                      Refusal& refusal) {
  Outlook best = look(surface, skeleton, frames.front(), options.plan);
  refusal.consider(best);
  double off = asymmetry(best.tree, 0, best.tree.middle);
  if (is_clear(best.found.plan) && off < symmetric) return best;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    Outlook other = look(surface, skeleton, frames[k], options.plan);
    refusal.consider(other);
    const double other_off = asymmetry(other.tree, 0, other.tree.middle);
    const bool is_better =
        is_clear(other.found.plan)
            ? !is_clear(best.found.plan) || other_off < off
            : best.found.plan == BodyKind::other && is_seen_from_aside(other, other_off);
    if (!is_better) continue;
    best = std::move(other);
    off = other_off;
  }
  for (std::size_t k = 0; k < frames.size() && best.found.plan == BodyKind::other; ++k) {
    Outlook other = second_look(surface, skeleton, frames[k], options.plan);
    refusal.consider(other);
    if (is_clear(other.found.plan)) best = std::move(other);
  }
  return best;
}

/// Up is none of a file's usual directions. Nor is it -y: few bodies lie so in files whose up is z,
/// and chairs upside down have arms and legs.
std::vector<Eigen::Matrix3d> frames_of_lying(const PlanOptions& options) {
  std::vector<Eigen::Matrix3d> frames;
  if (options.up != Direction::automatic) return frames;
  for (const Direction up : {Direction::x, Direction::minus_x, Direction::minus_z}) {
    PlanOptions turned = options;
    turned.up = up;
    if (options.front != Direction::automatic &&
        vector_of(up).cross(vector_of(options.front)).norm() == 0) {
      continue;
    }
    const std::vector<Eigen::Matrix3d> more = frames_of(turned);
    frames.insert(frames.end(), more.begin(), more.end());
  }
  return frames;
}

/// A human or a quadruped on its back, its front or a side. Nobody stands so, so nothing is left to
/// chance: its sides are images of each other, and it is all that there is.
std::optional<Outlook> best_lying(const Surface& surface, const CurveSkeleton& skeleton,
                                  const PlanOptions& options, const Outlook& usual) {
  std::optional<Outlook> best;
  double least = symmetric;
  for (const Eigen::Matrix3d& axes : frames_of_lying(options)) {
    const bool is_upside_down = axes.row(1).dot(usual.axes.row(1)) < 0;
    if (is_upside_down && usual.found.plan != BodyKind::other) continue;
    Outlook other = look(surface, skeleton, axes, options.plan);
    if (!is_clear(other.found.plan) || other.tree.cycles > 0) continue;
    const double off = asymmetry(other.tree, 0, other.tree.middle);
    if (off >= least || explained_by(other).share < most_of_it) continue;
    if (other.found.plan == BodyKind::humanoid && !has_trunk(other)) continue;
    least = off;
    best = std::move(other);
  }
  return best;
}

Outlook best_before_turning(const Surface& surface, const CurveSkeleton& skeleton,
                            const PlanOptions& options) {
  const std::vector<Eigen::Matrix3d> frames = frames_of(options);
  Refusal refusal;
  Outlook best = best_by_place(surface, skeleton, frames, options, refusal);
  if (!is_clear(best.found.plan)) {
    if (std::optional<Outlook> lying = best_lying(surface, skeleton, options, best)) return *lying;
  }
  Explained most = explained_by(best);
  for (std::size_t k = 0; k < frames.size() && !is_clear(best.found.plan); ++k) {
    Outlook other = look_at_shape(surface, skeleton, frames[k], options.plan);
    refusal.consider(other);
    const Explained explained = explained_by(other);
    if (!is_body_in_pose(other, explained, options.plan)) continue;
    if (best.found.plan != BodyKind::other && explained.length <= most.length) continue;
    most = explained;
    best = std::move(other);
  }
  for (std::size_t k = 0; k < frames.size() && best.found.plan == BodyKind::other; ++k) {
    Outlook other = third_look(surface, skeleton, frames[k], options.plan);
    if (is_whole_but_for_a_limb(other)) best = std::move(other);
  }
  if (best.found.plan == BodyKind::other && refusal.length >= 0) {
    best.found.reason = refusal.reason;
  }
  return best;
}

bool is_turned(const Outlook& outlook, const PlanOptions& options) {
  if (options.front != Direction::automatic) return false;
  const auto& [axes, tree, limbs, found, sides, posed] = outlook;
  if (found.plan == BodyKind::quadruped) {
    return looks_back(tree, limbs, found,
                      sides == Sides::posed ? Standing::in_pose : Standing::on_all_feet);
  }
  if (found.plan == BodyKind::fish) return swims_back(tree, limbs);
  const bool has_toes = found.plan == BodyKind::humanoid || found.plan == BodyKind::bird ||
                        found.plan == BodyKind::tailed_biped;
  return has_toes && !options.faces_minus_z && toes_point_back(tree, limbs, found);
}

}  // namespace

bool is_alike_from_both_ends(const Outlook& outlook) {
  if (outlook.sides != Sides::images && outlook.sides != Sides::posed) return false;
  const CurveTree& tree = outlook.sides == Sides::posed ? outlook.posed : outlook.tree;
  double rear = std::numeric_limits<double>::infinity();
  double front = -rear;
  for (const Vector3d& node : tree.nodes) {
    rear = std::min(rear, node.z());
    front = std::max(front, node.z());
  }
  const double off = asymmetry(tree, 2, 0.5 * (rear + front));
  const bool is_in_pose = outlook.sides == Sides::posed;
  return off < (is_in_pose ? symmetric : std::max(symmetric, asymmetry(tree, 0, tree.middle)));
}

Outlook best_outlook(const Surface& surface, const CurveSkeleton& skeleton,
                     const PlanOptions& options) {
  Outlook outlook = best_before_turning(surface, skeleton, options);
  if (is_turned(outlook, options)) {
    Eigen::Matrix3d axes = outlook.axes;
    axes.row(0) *= -1;
    axes.row(2) *= -1;
    switch (outlook.sides) {
      case Sides::images:
        outlook = look(surface, skeleton, axes, options.plan);
        break;
      case Sides::own:
        outlook = second_look(surface, skeleton, axes, options.plan);
        break;
      case Sides::completed:
        outlook = third_look(surface, skeleton, axes, options.plan);
        break;
      case Sides::posed:
        outlook = look_at_shape(surface, skeleton, axes, options.plan);
        break;
    }
  }
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
