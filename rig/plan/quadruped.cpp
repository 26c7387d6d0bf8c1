#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/plan/roles.hpp"
#include "rig/plan/trunk.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// The joints of a leg from above, and how far each lies below the trunk's curve, of its height
/// above the ground there: means over artists' rigs.
struct LegRule {
  std::array<const char*, 4> roles;
  std::array<double, 4> shares;
  bool has_hock;  ///< the third joint is where the leg reaches farthest back, if it clearly does
  double ahead;   ///< of the first joint from the curve, of that height
  double knee_ahead;  ///< of the second one, which bends forward
};
constexpr LegRule hind_leg{
    {"thigh.L", "shin.L", "foot.L", "toe.L"}, {0, 0.32, 0.65, 0.89}, true, 0, 0.07};
constexpr LegRule front_leg{{"front_thigh.L", "front_shin.L", "front_foot.L", "front_toe.L"},
                            {0.14, 0.53, 0.87, 0.96},
                            false,
                            0.1,
                            0};

/// The sample between two that lies farthest behind the line from one to the other; `otherwise`
/// where none is clearly behind it.
std::size_t rearmost(const Course& course, std::size_t from, std::size_t to, double clearly,
                     std::size_t otherwise) {
  const Vector3d& upper = course.points[from];
  const Vector3d& lower = course.points[to];
  std::size_t best = otherwise;
  double most = clearly;
  for (std::size_t k = from + 1; k < to; ++k) {
    const double height = upper.y() - lower.y();
    const double share = height > 0 ? (upper.y() - course.points[k].y()) / height : 0;
    const double behind = upper.z() + share * (lower.z() - upper.z()) - course.points[k].z();
    if (behind <= most) continue;
    most = behind;
    best = k;
  }
  return best;
}

constexpr double least_bone = 0.02;  // of the size, as elsewhere in a rig

/// Below the first joint a leg hangs beside the body: the first one lies as far from the mirror
/// plane as the second.
void place_leg(const CurveTree& tree, const LimbPair& pair, int number, const LegRule& rule,
               const std::string& parent, std::vector<Place>& places) {
  const Course course = mean_course(tree, pair.ways.front());
  const double top = course.points.front().y();
  const std::size_t first = places.size();
  std::string above = parent;
  std::array<std::size_t, 4> samples{};
  std::size_t k = 0;
  for (std::size_t joint = 0; joint < samples.size(); ++joint) {
    const double y = top - rule.shares[joint] * (top - tree.ground);
    while (k + 1 < course.points.size() && course.points[k].y() > y) ++k;
    samples[joint] = k;
  }
  if (rule.has_hock) {
    samples[2] = rearmost(course, samples[1], samples[3], 0.01 * tree.size, samples[2]);
  }
  const Vector3d foot_bone = course.points[samples[3]] - course.points[samples[2]];
  const bool has_toe = foot_bone.norm() > least_bone * tree.size;  // else the foot is a hoof
  for (std::size_t joint = 0; joint < samples.size() - (has_toe ? 0 : 1); ++joint) {
    const bool is_hock = rule.has_hock && joint == 2;
    places.push_back({rule.roles[joint], above, course.points[samples[joint]], true, number,
                      is_hock ? "where the leg reaches farthest back"
                              : "at its share of the height of the trunk above the ground"});
    above = rule.roles[joint];
  }
  Vector3d& thigh = places[first].at;
  thigh.x() = std::max(thigh.x(), places[first + 1].at.x());
  thigh.z() += rule.ahead * (top - tree.ground);
  places[first + 1].at.z() += rule.knee_ahead * (top - tree.ground);
}

/// The thighs of hind legs, which the curve leaves for the belly too early, lie half-way between
/// the crossing and the ankles, and the root a little behind the thighs.
int hips_of(const CurveTree& tree, const Limbs& limbs, const LimbPair& hind, double ankle) {
  const double crossing = tree.nodes[idx(hind.root)].z();
  const double height = tree.nodes[idx(hind.root)].y() - tree.ground;
  const double wanted = 0.5 * (crossing + ankle) - 0.1 * height;
  // A tail that is held upright goes on and on at the same place.
  constexpr double on_the_way = 0.2;
  const Ways ways = ways_from(tree, hind.root);
  const auto off = [&](int node) {
    return std::abs(tree.nodes[idx(node)].z() - wanted) + on_the_way * ways.distance[idx(node)];
  };
  int best = hind.root;
  for (const int node : limbs.trunk) {
    if (off(node) < off(best)) best = node;
  }
  return best;
}

/// The upper end of a hip bone or a shoulder blade, which hangs in the flesh beside the trunk:
/// artists' means, in the height of the limb's first joint above the ground.
struct GirdleRule {
  const char* role;
  const char* parent;
  double above;    ///< the limb's first joint
  double ahead;    ///< of it
  double outside;  ///< of its distance from the mirror plane
};
constexpr GirdleRule pelvis{"pelvis.L", "spine", 0.1, 0.34, 0.42};
constexpr GirdleRule shoulder_blade{"shoulder.L", "chest", 0.32, -0.45, 0.56};

void place_girdle(const CurveTree& tree, const GirdleRule& rule, Place& limb,
                  std::vector<Place>& places) {
  const double height = limb.at.y() - tree.ground;
  const Vector3d at(tree.middle + rule.outside * (limb.at.x() - tree.middle),
                    limb.at.y() + rule.above * height, limb.at.z() + rule.ahead * height);
  limb.parent = rule.role;
  places.push_back({rule.role, rule.parent, at, false, -1, "where the bone meets the trunk"});
}

/// Sets the thigh over the root.
void place_hind_leg(const CurveTree& tree, const Limbs& limbs, const LimbPair& hind, int number,
                    std::vector<Place>& places) {
  const std::size_t first = places.size();
  place_leg(tree, hind, number, hind_leg, "spine", places);
  Vector3d& thigh = places[first].at;
  thigh.z() = 0.5 * (tree.nodes[idx(hind.root)].z() + places[first + 2].at.z());
  Vector3d root = tree.nodes[idx(hips_of(tree, limbs, hind, places[first + 2].at.z()))];
  root.x() = tree.middle;
  place_girdle(tree, pelvis, places[first], places);
  places.push_back(
      {"spine", "", root, true, -1, "on the trunk's curve, a little behind the thighs"});
}

/// Returns the root's node.
int place_standing_hips(const CurveTree& tree, const Limbs& limbs, int legs,
                        std::vector<Place>& places) {
  const LimbPair& pair = limbs.pairs[idx(legs)];
  place_hind_leg(tree, limbs, pair, legs, places);
  return hips_of(tree, limbs, pair, places[2].at.z());
}

/// Of a bird in the air whose legs no curve sees. Returns the root's node.
int place_gliding_hips(const CurveTree& tree, const Limbs& limbs, int wings,
                       std::vector<Place>& places) {
  constexpr double share = 0.4;  // of the way from the wings to the tail's tip
  const int chest = limbs.pairs[idx(wings)].root;
  const Ways ways = ways_from(tree, chest);
  const std::vector<int> path = ways.path(tail_of(tree, chest, ways));
  const double wanted = share * ways.distance[idx(path.back())];
  const int hips = *std::find_if(path.begin(), path.end(),
                                 [&](int node) { return ways.distance[idx(node)] >= wanted; });
  Vector3d root = tree.nodes[idx(hips)];
  root.x() = tree.middle;
  places.push_back(
      {"spine", "", root, true, -1, "at its share of the way from the wings to the tail's tip"});
  return hips;
}

/// Four bones of one length, after a gap: means over artists' rigs.
void place_tail(const CurveTree& tree, int hips, std::vector<Place>& places) {
  constexpr double gap = 0.12;
  const Ways ways = ways_from(tree, hips);
  const int end = tail_of(tree, hips, ways);
  const Along tail = along(tree, ways.path(end));
  if (tail.whole() < std::max(0.08 * tree.size, 1.5 * tree.radii[idx(hips)])) return;
  std::string above = "spine";
  for (int k = 0; k < 4; ++k) {
    const std::string role = k == 0 ? "tail" : "tail.00" + std::to_string(k);
    const double share = gap + (1 - gap) * k / 4;
    places.push_back({role, above, tail.at(share * tail.whole()), true, -1,
                      "at its share of the way from the root to the tail's tip"});
    places.back().is_last = k == 3;
    above = role;
  }
}

/// To where ears or jaws branch off, if that is in the upper half of the neck as artists make it,
/// of .6 of the way to the nose; else to the end of that.
double way_to_skull(const CurveTree& tree, const std::vector<int>& path, const Along& neck) {
  constexpr double longest = 0.6;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const double share = neck.way[k] / neck.whole();
    if (share > longest) break;
    if (share > longest / 2 && tree.neighbours[idx(path[k])].size() > 2) return neck.way[k];
  }
  return longest * neck.whole();
}

/// From the hips to the front legs, and on to the head.
void place_trunk(const CurveTree& tree, int hips, int front, std::vector<Place>& places) {
  const std::string share = "at its share of the way along the trunk";
  const Along back = along(tree, ways_from(tree, hips).path(front));
  places.push_back({"spine.001", "spine", back.at(0.3 * back.whole()), true, -1, share});
  places.push_back({"spine.002", "spine.001", back.at(0.65 * back.whole()), true, -1, share});
  places.push_back({"chest", "spine.002", back.at(back.whole()), true, -1,
                    "where the front legs meet the trunk"});
  const Ways ways = ways_from(tree, front);
  const int nose = nose_of(tree, front, ways);
  if (nose == front) return;
  const std::vector<int> path = ways.path(nose);
  const Along neck = along(tree, path);
  const double skull = way_to_skull(tree, path, neck);
  places.push_back({"neck", "chest", neck.at(skull / 3), true, -1, share});
  places.push_back({"neck.001", "neck", neck.at(0.62 * skull), true, -1, share});
  places.push_back({"head", "neck.001", neck.at(skull), true, -1, share});
}

/// Where arms leave the trunk, but no nearer to the hips than .4 of the way to the nose: wings
/// leave it all along.
int chest_of(const CurveTree& tree, int hips, const LimbPair* arms) {
  const Ways ways = ways_from(tree, hips);
  const std::vector<int> path = ways.path(nose_of(tree, hips, ways));
  const double least = 0.4 * ways.distance[idx(path.back())];
  if (arms != nullptr && ways.distance[idx(arms->root)] > least) return arms->root;
  std::size_t k = 0;
  while (k + 1 < path.size() && ways.distance[idx(path[k])] < least) ++k;
  return path[k];
}

}  // namespace

std::vector<Place> quadruped_places(const CurveTree& tree, const Limbs& limbs,
                                    const PlanFound& found) {
  const LimbPair& hind = limbs.pairs[idx(found.legs[0])];
  const LimbPair& front = limbs.pairs[idx(found.legs[1])];
  std::vector<Place> places;
  place_hind_leg(tree, limbs, hind, found.legs[0], places);
  const int hips = hips_of(tree, limbs, hind, places[2].at.z());
  place_trunk(tree, hips, front.root, places);
  place_tail(tree, hips, places);
  const std::size_t first = places.size();
  place_leg(tree, front, found.legs[1], front_leg, "chest", places);
  place_girdle(tree, shoulder_blade, places[first], places);
  return places;
}

std::vector<Place> biped_places(const CurveTree& tree, const Limbs& limbs, const PlanFound& found) {
  std::vector<Place> places;
  const int hips = found.legs.empty() ? place_gliding_hips(tree, limbs, found.arms, places)
                                      : place_standing_hips(tree, limbs, found.legs[0], places);
  place_tail(tree, hips, places);
  const LimbPair* arms = found.arms < 0 ? nullptr : &limbs.pairs[idx(found.arms)];
  place_trunk(tree, hips, chest_of(tree, hips, arms), places);
  if (arms == nullptr) return places;
  const ArmJoints arm = arm_joints(tree, *arms);
  places.push_back({"upper_arm.L", "chest", arm.shoulder, true, found.arms, shoulder_reason});
  if (found.plan == BodyKind::bird) return places;  // a wing bends where its curve does
  places.push_back({"forearm.L", "upper_arm.L", arm.elbow, true, found.arms, elbow_reason});
  places.push_back({"hand.L", "forearm.L", arm.wrist, true, found.arms, wrist_reason});
  return places;
}

}  // namespace curveskel
