#include "rig/plan/human_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/plan/body_sections.hpp"
#include "rig/plan/human_proportions.hpp"
#include "rig/plan/roles.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

double share_of_human(const CurveTree& tree, double y) {
  return tree.height > 0 ? (y - tree.ground) / tree.height : 0;
}

bool is_human_leg(const CurveTree& tree, const LimbPair& pair) {
  constexpr double aside = 0.8;  // of its length, as of sprawling legs
  constexpr double knee = knee_of_hips * hips_of_shoulders * shoulders_of_height;
  const Vector3d& root = tree.nodes[idx(pair.root)];
  const Vector3d& tip = tree.nodes[idx(pair.ways.front().path.back())];
  return pair.lowest < tree.ground + near_ground * tree.height &&
         share_of_human(tree, root.y()) > knee &&
         share_of_human(tree, root.y()) < waist_of_height && tip.y() < root.y() &&
         std::abs(tip.x() - root.x()) < aside * pair.length;
}

/// An arm that hangs down to the hip and touches it is a cycle, which is cut: its tip is none.
bool ends_at_a_cut(const CurveTree& tree, const LimbPair& pair) {
  constexpr double whole = 0.75 * (shoulder_aside + arm_reach) * shoulders_of_height;
  const LimbWay& way = pair.ways.front();
  const auto is_cut = [&](int node) {
    return std::binary_search(tree.cuts.begin(), tree.cuts.end(), node);
  };
  return pair.length < whole * tree.height &&
         (is_cut(way.path.back()) || is_cut(way.mirror.back()));
}

/// Arms that begin nearer to the mirror plane than half a shoulder are crossed ahead of the body.
bool is_human_arm(const CurveTree& tree, const LimbPair& pair, double neck, double leg) {
  constexpr double shortest_arm = 1.0 / 3;  // of the leg
  constexpr double narrowest = 0.5 * shoulder_aside * shoulders_of_height;
  constexpr double hips = hips_of_shoulders * shoulders_of_height;
  const double root = tree.nodes[idx(pair.root)].y();
  return share_of_human(tree, root) > hips && root < neck && pair.length > shortest_arm * leg &&
         pair.lowest > tree.ground + near_ground * tree.height && !ends_at_a_cut(tree, pair) &&
         arm_joints(tree, pair).shoulder.x() - tree.middle > narrowest * tree.height;
}

/// Most of either side lies within the other one's image.
bool are_images(const CurveTree& tree, const LimbPair& pair) {
  constexpr double most = 0.5;
  return share_within_both(tree, pair.ways.front()) > most;
}

/// Of those who sit, and of dolls: the two longest pairs, the lower of which reaches the ground;
/// neither is as short as no human's arm.
HumanPairs longest_pairs(const CurveTree& tree, const Limbs& limbs) {
  constexpr double shortest = 0.12;    // of the size
  constexpr double most_unlike = 3.0;  // an arm is a third of its leg at least
  std::vector<int> pairs(limbs.pairs.size());
  std::iota(pairs.begin(), pairs.end(), 0);
  const auto length = [&](int k) { return limbs.pairs[idx(k)].length; };
  std::stable_sort(pairs.begin(), pairs.end(), [&](int a, int b) { return length(a) > length(b); });
  if (pairs.size() < 2 || length(pairs[1]) < shortest * tree.size) return {};
  if (length(pairs[0]) > most_unlike * length(pairs[1])) return {};
  // Both may begin in the ball of a short trunk.
  const auto height = [&](int k) {
    const LimbPair& pair = limbs.pairs[idx(k)];
    return tree.nodes[idx(pair.root)].y() + tree.nodes[idx(pair.ways.front().path.back())].y();
  };
  const bool is_first_lower = height(pairs[0]) < height(pairs[1]);
  const HumanPairs seen{pairs[is_first_lower ? 0 : 1], pairs[is_first_lower ? 1 : 0]};
  const double ground = tree.ground + near_ground * tree.height;
  const bool sits = limbs.pairs[idx(seen.legs)].lowest < ground &&
                    limbs.pairs[idx(seen.arms)].lowest > ground;  // no toes
  const bool are_alike =
      are_images(tree, limbs.pairs[idx(pairs[0])]) && are_images(tree, limbs.pairs[idx(pairs[1])]);
  return sits && are_alike ? seen : HumanPairs{};
}

}  // namespace

HumanPairs human_pairs(const CurveTree& tree, const Limbs& limbs) {
  HumanPairs seen;
  double farthest = 0;
  for (int k = 0; k < static_cast<int>(limbs.pairs.size()); ++k) {
    if (seen.legs < 0 && is_human_leg(tree, limbs.pairs[idx(k)])) seen.legs = k;
  }
  const double leg = seen.legs < 0 ? hips_of_shoulders * shoulders_of_height * tree.height
                                   : limbs.pairs[idx(seen.legs)].length;
  const double chin = tree.ground + chin_of_height * tree.height;
  const double neck = BodySections(tree, {}).neck().value_or(chin);
  for (int k = 0; k < static_cast<int>(limbs.pairs.size()); ++k) {
    const LimbPair& pair = limbs.pairs[idx(k)];
    if (k == seen.legs || !is_human_arm(tree, pair, neck, leg)) continue;
    const double aside = std::abs(tree.aside(pair.ways.front().path.back()));
    if (aside <= farthest) continue;
    farthest = aside;
    seen.arms = k;
  }
  return seen.legs < 0 && seen.arms < 0 ? longest_pairs(tree, limbs) : seen;
}

}  // namespace curveskel
