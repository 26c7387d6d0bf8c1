#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/plan/posed_legs.hpp"
#include "rig/plan/roles.hpp"

namespace curveskel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double clearly_ahead = 0.05;  // of a leg's length
constexpr double foot_height = 0.1;     // the same, at most
constexpr double shin_height = 0.35;    // its upper end

// Of the way from the hip to the tip of the foot, by the heights of knees and ankles and by a foot
// of a fifth of it.
constexpr double knee_share = 0.4;
constexpr double ankle_share = 0.8;

/// By how much more the foot reaches ahead of the shin than behind it; 0 where either has no
/// vertices. `seen` says how far ahead a place lies, and how high, in lengths of the leg.
template <typename Places, typename Seen>
double reach_ahead(const Places& places, const Seen& seen) {
  double ahead = -std::numeric_limits<double>::infinity();
  double behind = -ahead;
  double shin = 0;
  int count = 0;
  for (const auto& place : places) {
    const Vector2d p = seen(place);
    if (p.y() < foot_height) {
      ahead = std::max(ahead, p.x());
      behind = std::min(behind, p.x());
    } else if (p.y() < shin_height) {
      shin += p.x();
      ++count;
    }
  }
  if (count == 0 || !(ahead > behind)) return 0;
  shin /= count;
  return (ahead - shin) - (shin - behind);
}

double foot_ahead(const CurveTree& tree, const LimbPair& leg) {
  const double length = tree.nodes[idx(leg.root)].y() - tree.ground;
  return reach_ahead(leg.vertices, [&](int v) {
    const Vector3d& p = tree.vertices[idx(v)];
    return Vector2d(p.z(), (p.y() - tree.ground) / length);
  });
}

/// Points evenly over the left foot and shin, those nearest to the leg's nodes: boots of boxes have
/// vertices at their toes alone.
std::vector<Vector3d> surface_of_shin(const CurveTree& tree, const Limbs& limbs,
                                      const LimbPair& leg) {
  const std::vector<char> is_own = nodes_of_side(tree, limbs, leg.ways.front().path);
  const double length = tree.nodes[idx(leg.root)].y() - tree.ground;
  std::vector<Vector3d> surface;
  for (const Vector3d& p : tree.spread) {
    if (p.y() > tree.ground + shin_height * length) continue;
    std::size_t nearest = 0;
    for (std::size_t n = 1; n < tree.nodes.size(); ++n) {
      if ((tree.nodes[n] - p).squaredNorm() < (tree.nodes[nearest] - p).squaredNorm()) nearest = n;
    }
    if (is_own[nearest] != 0) surface.push_back(p);
  }
  return surface;
}

/// A leg of a human in a pose, seen from its side: (z, y).
class SideOfLeg {
 public:
  SideOfLeg(const CurveTree& tree, const Limbs& limbs, const LimbWay& way, bool is_left)
      : course_(side_course(tree, way, is_left)), length_(way.length) {
    for (const Vector3d& p : surface_of_side(tree, limbs, way, is_left)) {
      vertices_.push_back(from_side(p));
    }
  }

  /// By how much the leg bends ahead of the straight way from the hip to the ankle, as knees alone
  /// do, however the thigh is turned.
  [[nodiscard]] double knee_ahead() const {
    const Vector2d way = at(ankle_share) - at(0);
    if (!(way.norm() > 0)) return 0;
    const Vector2d ahead = ahead_of(way.normalized());
    double farthest = 0;
    constexpr int samples = 24;
    for (int k = 1; k < samples; ++k) {
      const double off = (at(ankle_share * k / samples) - at(0)).dot(ahead);
      if (std::abs(off) > std::abs(farthest)) farthest = off;
    }
    return farthest;
  }

  /// As where a human stands, with the shin for what is upright.
  [[nodiscard]] double foot_ahead() const {
    const Vector2d shin = at(ankle_share) - at(knee_share);
    if (!(shin.norm() > 0)) return 0;
    const Vector2d down = shin.normalized();
    double sole = -std::numeric_limits<double>::infinity();
    for (const Vector2d& p : vertices_) sole = std::max(sole, p.dot(down));
    return reach_ahead(vertices_, [&](const Vector2d& p) {
      return Vector2d(p.dot(ahead_of(down)), (sole - p.dot(down)) / length_);
    });
  }

 private:
  static Vector2d from_side(const Vector3d& p) { return {p.z(), p.y()}; }
  static Vector2d ahead_of(const Vector2d& down) { return {-down.y(), down.x()}; }

  [[nodiscard]] Vector2d at(double share) const {
    const auto last = static_cast<double>(course_.points.size() - 1);
    return from_side(course_.points[static_cast<std::size_t>(std::lround(share * last))]);
  }

  Course course_;
  double length_;
  std::vector<Vector2d> vertices_;
};

/// The part of a quadruped beyond a pair of legs.
struct BeyondLegs {
  const CurveTree& tree;
  const Limbs& limbs;
  Vector3d root;  ///< of the legs
  double ahead;   ///< 1 in front of them, -1 behind them

  [[nodiscard]] bool has(const Vector3d& p) const { return ahead * (p.z() - root.z()) > 0; }

  /// The largest radius in the outer half of the trunk's way; 0 where the trunk ends at the legs.
  [[nodiscard]] double outer_radius() const {
    double farthest = 0;
    for (const int node : limbs.trunk) {
      const Vector3d& p = tree.nodes[idx(node)];
      if (has(p)) farthest = std::max(farthest, (p - root).norm());
    }
    double largest = 0;
    for (const int node : limbs.trunk) {
      const Vector3d& p = tree.nodes[idx(node)];
      if (!has(p) || 2 * (p - root).norm() < farthest) continue;
      largest = std::max(largest, tree.radii[idx(node)]);
    }
    return largest;
  }

  /// The height of the trunk and that of the surface in one sum, thinner parts left out. Where the
  /// trunk ends at the legs it is as high as there.
  [[nodiscard]] double height(double least_radius) const {
    double trunk = root.y();
    for (const int node : limbs.trunk) {
      const Vector3d& p = tree.nodes[idx(node)];
      if (has(p) && tree.radii[idx(node)] >= least_radius) trunk = std::max(trunk, p.y());
    }
    double surface = tree.ground;
    for (std::size_t v = 0; v < tree.vertices.size(); ++v) {
      const int node = tree.node_of_vertex[v];
      if (node >= 0 && tree.radii[idx(node)] < least_radius) continue;
      if (has(tree.vertices[v])) surface = std::max(surface, tree.vertices[v].y());
    }
    return trunk + surface;
  }
};

/// By how much a quadruped reaches higher beyond its front legs than beyond its hind legs. An end
/// of less than half of the other's thickness is a tail, whose height says nothing.
double front_above_rear(const CurveTree& tree, const Limbs& limbs, const PlanFound& found) {
  const Vector3d& a = tree.nodes[idx(limbs.pairs[idx(found.legs[0])].root)];
  const Vector3d& b = tree.nodes[idx(limbs.pairs[idx(found.legs[1])].root)];
  const bool first_is_rear = a.z() < b.z();
  const BeyondLegs rear{tree, limbs, first_is_rear ? a : b, -1};
  const BeyondLegs front{tree, limbs, first_is_rear ? b : a, 1};
  const double rear_radius = rear.outer_radius();
  const double front_radius = front.outer_radius();
  const auto least = [](double own, double other) { return 2 * own < other ? other / 2 : 0; };
  return front.height(least(front_radius, rear_radius)) -
         rear.height(least(rear_radius, front_radius));
}

/// The length of the ears, horns and jaws in the front half, less that of those in the rear half.
double ears_ahead(const CurveTree& tree, const Limbs& limbs, const PlanFound& found) {
  const auto root = [&](int pair) { return tree.nodes[idx(limbs.pairs[idx(pair)].root)].z(); };
  const double middle = 0.5 * (root(found.legs[0]) + root(found.legs[1]));
  double ears = 0;
  for (int k = 0; k < static_cast<int>(limbs.pairs.size()); ++k) {
    const LimbPair& pair = limbs.pairs[idx(k)];
    const bool is_leg = std::find(found.legs.begin(), found.legs.end(), k) != found.legs.end();
    if (is_leg || pair.length <= 0.05 * tree.size) continue;
    ears += (root(k) > middle ? 1 : -1) * pair.length;
  }
  return ears;
}

}  // namespace

bool toes_point_back(const CurveTree& tree, const Limbs& limbs, const PlanFound& found) {
  const LimbPair& leg = limbs.pairs[idx(found.legs.front())];
  const double length = tree.nodes[idx(leg.root)].y() - tree.ground;
  const double ahead = reach_ahead(surface_of_shin(tree, limbs, leg), [&](const Vector3d& p) {
    return Vector2d(p.z(), (p.y() - tree.ground) / length);
  });
  return -ahead > clearly_ahead * length;
}

bool legs_bend_back(const CurveTree& tree, const Limbs& limbs, const PlanFound& found) {
  const LimbWay& way = limbs.pairs[idx(found.legs.front())].ways.front();
  const double least = 2 * clearly_ahead * way.length;  // of both legs
  double feet = 0;
  double knees = 0;
  for (const bool is_left : {true, false}) {
    const SideOfLeg leg(tree, limbs, way, is_left);
    feet += leg.foot_ahead();
    knees += leg.knee_ahead();
  }
  return std::abs(feet) > least ? feet < 0 : feet + knees < -least;
}

bool looks_back(const CurveTree& tree, const Limbs& limbs, const PlanFound& found,
                Standing standing) {
  const double ears = ears_ahead(tree, limbs, found);
  if (standing == Standing::in_pose && ears != 0) return ears < 0;
  double ahead = ears + front_above_rear(tree, limbs, found);
  for (const int leg : found.legs) ahead += foot_ahead(tree, limbs.pairs[idx(leg)]);
  return ahead < 0;
}

}  // namespace curveskel
