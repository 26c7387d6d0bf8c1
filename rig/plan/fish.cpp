// The places of a fish's joints, and what makes a body a fish.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "base/median.hpp"
#include "rig/plan/roles.hpp"
#include "rig/plan/trunk.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

constexpr double near_plane = 0.03;  // of the size

/// From the nose to the tail, in the mirror plane.
struct Trunk {
  std::vector<int> path;
  std::vector<char> is_on;  // by node
  Along line;
};

/// The node of the trunk with the largest ball.
int thickest(const CurveTree& tree, const Limbs& limbs) {
  int best = limbs.trunk.front();
  for (const int node : limbs.trunk) {
    if (tree.radii[idx(node)] > tree.radii[idx(best)]) best = node;
  }
  return best;
}

Trunk trunk_of(const CurveTree& tree, const Limbs& limbs) {
  const int middle = thickest(tree, limbs);
  const int nose = nose_of(tree, middle, ways_from(tree, middle));
  const Ways ways = ways_from(tree, nose);
  Trunk trunk;
  trunk.path = ways.path(tail_of(tree, middle, ways));
  trunk.is_on.assign(tree.nodes.size(), 0);
  for (const int node : trunk.path) trunk.is_on[idx(node)] = 1;
  trunk.line = along(tree, trunk.path);
  return trunk;
}

/// "dorsal_fin", "dorsal_fin_2", ...
std::string numbered(const std::string& role, int number) {
  return number == 0 ? role : role + "_" + std::to_string(number + 1);
}

/// The role of the trunk's joint next to this place.
std::string joint_beside(const std::vector<Place>& trunk, const Vector3d& at) {
  const auto off = [&](const Place& place) { return std::abs(place.at.z() - at.z()); };
  return std::min_element(trunk.begin(), trunk.end(),
                          [&](const Place& a, const Place& b) { return off(a) < off(b); })
      ->role;
}

/// A place on the trunk and the node next to it.
struct OnTrunk {
  Vector3d at;
  int node;
};

/// The first that is no farther ahead than z, or the last. In the mirror plane, unless the trunk
/// bends out of it, as of a fish that swims.
OnTrunk first_behind(const CurveTree& tree, const Trunk& trunk, double z) {
  constexpr double bent = 0.01;  // of the size
  const std::vector<Vector3d>& points = trunk.line.points;
  std::size_t k = 0;
  while (k + 1 < points.size() && points[k].z() > z) ++k;
  const std::size_t before = k > 0 ? k - 1 : 0;
  const double step = points[before].z() - points[k].z();
  const double share = step > 0 ? std::clamp((points[before].z() - z) / step, 0.0, 1.0) : 1;
  Vector3d at = points[before] + share * (points[k] - points[before]);
  if (std::any_of(trunk.path.begin(), trunk.path.end(),
                  [&](int node) { return std::abs(tree.aside(node)) > bent * tree.size; })) {
    const double from = tree.nodes[idx(trunk.path[before])].x();
    at.x() = from + share * (tree.nodes[idx(trunk.path[k])].x() - from);
  }
  return {at, trunk.path[share < 0.5 ? before : k]};
}

/// Shares of the length that the surface has in the mirror plane, from the nose on: an artist's, of
/// a shark.
std::vector<Place> trunk_places(const CurveTree& tree, const Trunk& trunk) {
  constexpr double root = 0.24;
  constexpr double head = 0.19;
  constexpr double first_bone = 0.3;
  constexpr double last_bone = 0.92;
  constexpr int bones = 7;
  const std::string reason = "at its share of the length from the nose";
  double rear = std::numeric_limits<double>::infinity();
  double front = -rear;
  for (const Vector3d& p : tree.vertices) {
    if (std::abs(p.x() - tree.middle) > near_plane * tree.size) continue;
    rear = std::min(rear, p.z());
    front = std::max(front, p.z());
  }
  std::vector<Place> places;
  const auto add = [&](const std::string& role, const std::string& above, double share) {
    const OnTrunk place = first_behind(tree, trunk, front + share * (rear - front));
    places.push_back({role, above, place.at, true, -1, reason});
    places.back().node = place.node;
  };
  add("spine", "", root);
  add("head", "spine", head);
  std::string above = "spine";
  for (int k = 0; k < bones; ++k) {
    const std::string role = k == 0 ? "tail" : "tail.00" + std::to_string(k);
    const double share = first_bone + (last_bone - first_bone) * k / (bones - 1);
    add(role, above, share);
    above = role;
  }
  return places;
}

/// The first point of a fin that is out of the trunk.
std::size_t base_of(const CurveTree& tree, const Course& fin, int root) {
  const double thick = tree.radii[idx(root)];
  std::size_t k = 0;
  while (k + 1 < fin.points.size() && (fin.points[k] - fin.points[0]).norm() < thick) ++k;
  return k + 2 < fin.points.size() ? k : 0;
}

/// Two bones; of flukes, at the tail's end, one.
void place_pair(const CurveTree& tree, const LimbPair& pair, int number, const std::string& role,
                bool is_fluke, const std::vector<Place>& trunk, std::vector<Place>& places) {
  const Course course = mean_course(tree, pair.ways.front());
  const std::size_t base = base_of(tree, course, pair.root);
  const std::size_t middle = (base + course.points.size() - 1) / 2;
  const std::string above = joint_beside(trunk, tree.nodes[idx(pair.root)]);
  places.push_back({role + ".L", is_fluke ? trunk.back().role : above, course.points[base], true,
                    number, "where the fin leaves the trunk"});
  places.back().is_last = is_fluke;
  if (is_fluke) return;
  places.push_back({role + ".001.L", role + ".L", course.points[middle], true, number,
                    "half-way along the fin"});
  places.back().is_last = true;
}

void place_pairs(const CurveTree& tree, const Limbs& limbs, const Trunk& trunk,
                 const std::vector<Place>& joints, std::vector<Place>& places) {
  std::vector<int> order;
  for (int k = 0; k < static_cast<int>(limbs.pairs.size()); ++k) {
    if (limbs.pairs[idx(k)].length > 0.05 * tree.size) order.push_back(k);
  }
  const auto root = [&](int k) { return tree.nodes[idx(limbs.pairs[idx(k)].root)].z(); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return root(a) > root(b); });
  const double end = trunk.line.at(0.85 * trunk.line.whole()).z();
  int flukes = 0;
  int fins = 0;
  for (const int k : order) {
    const bool is_fluke = root(k) < end;
    const std::string role = is_fluke    ? numbered("fluke", flukes++)
                             : fins == 0 ? "pectoral_fin"
                                         : numbered("pelvic_fin", fins - 1);
    if (!is_fluke) ++fins;
    place_pair(tree, limbs.pairs[idx(k)], k, role, is_fluke, joints, places);
  }
}

/// Fins on the back and below the tail, and a jaw: tips in the mirror plane beside the trunk. Each
/// is one bone. `joints` are the trunk's.
void place_unpaired(const CurveTree& tree, const Trunk& trunk, const std::vector<Place>& joints,
                    std::vector<Place>& places) {
  const Ways ways = ways_from(tree, trunk.path.front());
  int backs = 0;
  int bellies = 0;
  bool has_jaw = false;
  for (int tip = 0; tip < static_cast<int>(tree.nodes.size()); ++tip) {
    const bool is_beside = tree.is_tip(tip) && trunk.is_on[idx(tip)] == 0 &&
                           std::abs(tree.aside(tip)) < near_plane * tree.size;
    if (!is_beside) continue;
    const std::vector<int> path = ways.path(tip);
    std::size_t first = path.size() - 1;
    while (first > 0 && trunk.is_on[idx(path[first])] == 0) --first;
    const int root = path[first];
    const double length = ways.distance[idx(tip)] - ways.distance[idx(root)];
    if (length < std::max(0.05 * tree.size, 1.2 * tree.radii[idx(root)])) continue;
    std::size_t base = first + 1;
    while (base + 2 < path.size() &&
           ways.distance[idx(path[base])] - ways.distance[idx(root)] < tree.radii[idx(root)]) {
      ++base;
    }
    Vector3d at = tree.nodes[idx(path[base])];
    at.x() = tree.middle;
    const bool is_below = tree.nodes[idx(tip)].y() < tree.nodes[idx(root)].y();
    std::string role;
    const std::string above = joint_beside(joints, at);
    if (above == "head" && is_below && !has_jaw) {
      has_jaw = true;
      role = "jaw";
    } else if (joint_beside(joints, tree.nodes[idx(tip)]) == joints.back().role) {
      continue;  // a lobe of the tail's fin
    } else {
      role = is_below ? numbered("anal_fin", bellies++) : numbered("dorsal_fin", backs++);
    }
    places.push_back({role, above, at, true, -1, "where it leaves the trunk"});
    places.back().is_last = true;
    places.back().beside = tree.nodes[idx(path[base])];
  }
}

/// Towards one of its ends, as a rod does not.
bool tapers(const CurveTree& tree, const Trunk& trunk, double thick) {
  constexpr double end = 0.2;  // of the length
  std::vector<double> radii[2];
  for (std::size_t k = 0; k < trunk.path.size(); ++k) {
    const double share = trunk.line.way[k] / trunk.line.whole();
    if (share < end) radii[0].push_back(tree.radii[idx(trunk.path[k])]);
    if (share > 1 - end) radii[1].push_back(tree.radii[idx(trunk.path[k])]);
  }
  return std::min(median_of(std::move(radii[0])), median_of(std::move(radii[1]))) < 0.5 * thick;
}

/// The trunk's extent within the component that is the thickest: a fish is of one piece.
double length_of_one_piece(const CurveTree& tree, const Trunk& trunk, int thickest) {
  const auto piece_of = [&](int node) {
    return idx(node) < tree.component.size() ? tree.component[idx(node)] : -1;
  };
  Eigen::AlignedBox1d extent;
  for (const int node : trunk.path) {
    const Eigen::Matrix<double, 1, 1> place(tree.nodes[idx(node)].z());
    if (piece_of(node) == piece_of(thickest)) extent.extend(place);
  }
  return extent.isEmpty() ? 0 : extent.sizes()[0];
}

}  // namespace

bool is_fish(const CurveTree& tree, const Limbs& limbs) {
  constexpr double least_fin = 0.05;  // of the size, as of those that get joints
  if (tree.cycles > 0 || limbs.pairs.empty() || limbs.trunk.empty()) return false;
  if (limbs.pairs.front().length < least_fin * tree.size) return false;
  double width = 0;
  for (const Vector3d& p : tree.vertices)
    width = std::max(width, 2 * std::abs(p.x() - tree.middle));
  const Trunk trunk = trunk_of(tree, limbs);
  const Vector3d along = trunk.line.points.front() - trunk.line.points.back();
  const double length = std::abs(along.z());
  const int middle = thickest(tree, limbs);
  const double thick = tree.radii[idx(middle)];
  return length_of_one_piece(tree, trunk, middle) > 0.5 * tree.size &&
         std::abs(along.y()) < 0.5 * length && trunk.line.whole() < 1.2 * length &&
         width < 0.8 * tree.size && thick > 0.04 * length && tapers(tree, trunk, thick);
}

bool swims_back(const CurveTree& tree, const Limbs& limbs) {
  const Trunk trunk = trunk_of(tree, limbs);
  double half[2] = {0, 0};  // radius times length, of the front and the rear
  for (std::size_t k = 1; k < trunk.path.size(); ++k) {
    const double step = trunk.line.way[k] - trunk.line.way[k - 1];
    const bool is_rear = trunk.line.way[k] > 0.5 * trunk.line.whole();
    half[is_rear ? 1 : 0] += step * tree.radii[idx(trunk.path[k])];
  }
  return half[1] > half[0];
}

std::vector<Place> fish_places(const CurveTree& tree, const Limbs& limbs) {
  const Trunk trunk = trunk_of(tree, limbs);
  const std::vector<Place> joints = trunk_places(tree, trunk);
  std::vector<Place> places = joints;
  place_pairs(tree, limbs, trunk, joints, places);
  place_unpaired(tree, trunk, joints, places);
  return places;
}

}  // namespace curveskel
