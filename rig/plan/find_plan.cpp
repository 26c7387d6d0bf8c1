#include <curveskel/body_plan.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "rig/plan/roles.hpp"

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

Eigen::Matrix3d axes_of(const PlanOptions& options) {
  Vector3d up = vector_of(options.up);
  if (options.up == Direction::automatic) up = Vector3d::UnitY();
  Vector3d front = vector_of(options.front);
  if (options.front == Direction::automatic) {
    const bool lies_along_z = up.cross(Vector3d::UnitZ()).norm() == 0;
    front = lies_along_z ? Vector3d(-Vector3d::UnitY()) : Vector3d(Vector3d::UnitZ());
    if (options.faces_minus_z) front = -front;
  }
  if (up.cross(front).norm() == 0) {
    throw Error(Fault::usage,
                "up and front are one direction, needed two that are normal to each "
                "other; give another --up or --front");
  }
  Eigen::Matrix3d axes;
  axes << up.cross(front).transpose(), up.transpose(), front.transpose();
  return axes;
}

/// "left.." and "..L" of the right.
std::string mirrored(const std::string& role) {
  if (role.starts_with("left")) return "right" + role.substr(4);
  if (role.ends_with(".L")) return role.substr(0, role.size() - 1) + "R";
  return role;
}

class Planner {
 public:
  Planner(const CurveTree& tree, const Limbs& limbs) : tree_(tree), limbs_(limbs) {}

  /// Parents before their children.
  std::vector<PlannedJoint> joints(const std::vector<Place>& places, const Eigen::Matrix3d& axes) {
    std::vector<char> done(places.size(), 0);
    for (bool grew = true; grew;) {
      grew = false;
      for (std::size_t k = 0; k < places.size(); ++k) {
        const bool may = places[k].parent.empty() || number_.count(places[k].parent) > 0;
        if (done[k] != 0 || !may) continue;
        done[k] = 1;
        grew = true;
        add(places[k], places[k].role, false, axes);
        if (mirrored(places[k].role) != places[k].role) {
          add(places[k], mirrored(places[k].role), true, axes);
        }
      }
    }
    return std::move(joints_);
  }

 private:
  void add(const Place& place, const std::string& role, bool is_right,
           const Eigen::Matrix3d& axes) {
    PlannedJoint joint;
    joint.role = role;
    joint.reason = place.reason;
    joint.is_last = place.is_last;
    if (!place.parent.empty()) {
      joint.parent =
          number_.at(is_right && number_.count(mirrored(place.parent)) > 0 ? mirrored(place.parent)
                                                                           : place.parent);
    }
    Vector3d at = place.at;
    if (is_right) at.x() = 2 * tree_.middle - at.x();
    joint.position = (axes.transpose() * at).transpose();
    if (place.on_curve) {
      Vector3d beside = place.beside.value_or(place.at);
      if (is_right) beside.x() = 2 * tree_.middle - beside.x();
      joint.node = nearest(place, is_right, beside);
    }
    number_[role] = static_cast<int>(joints_.size());
    joints_.push_back(std::move(joint));
  }

  [[nodiscard]] int nearest(const Place& place, bool is_right, const Vector3d& at) const {
    const LimbWay* way = place.pair < 0 ? nullptr : &limbs_.pairs[idx(place.pair)].ways[place.way];
    const std::vector<int>& nodes =
        way == nullptr ? limbs_.trunk : (is_right ? way->mirror : way->path);
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const int node : nodes) {
      const double distance = (tree_.nodes[idx(node)] - at).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      best = node;
    }
    return best;
  }

  const CurveTree& tree_;
  const Limbs& limbs_;
  std::map<std::string, int> number_;  // by role
  std::vector<PlannedJoint> joints_;
};

std::vector<Place> places_of(const CurveTree& tree, const Limbs& limbs, PlanFound& found) {
  switch (found.plan) {
    case BodyKind::humanoid:
      return humanoid_places(tree, limbs, found);
    case BodyKind::quadruped: {
      const auto depth = [&](int pair) { return tree.nodes[idx(limbs.pairs[idx(pair)].root)].z(); };
      std::sort(found.legs.begin(), found.legs.end(),
                [&](int a, int b) { return depth(a) < depth(b); });
      return quadruped_places(tree, limbs, found);
    }
    case BodyKind::bird:
    case BodyKind::tailed_biped:
      return biped_places(tree, limbs, found);
    case BodyKind::fish:
      return fish_places(tree, limbs);
    default:
      return {};
  }
}

bool is_turned(const CurveTree& tree, const Limbs& limbs, const PlanFound& found) {
  if (found.plan == BodyKind::quadruped) return looks_back(tree, limbs, found);
  return found.plan == BodyKind::fish && swims_back(tree, limbs);
}

}  // namespace

BodyPlan find_plan(const Surface& surface, const CurveSkeleton& skeleton,
                   const PlanOptions& options) {
  BodyPlan result;
  if (options.plan == BodyKind::none || skeleton.nodes.rows() < 2) return result;
  result.axes = axes_of(options);
  CurveTree tree = curve_tree(surface, skeleton, result.axes);
  Limbs limbs = find_limbs(tree);
  PlanFound found = classify(tree, limbs, options.plan);
  const bool turns = options.front == Direction::automatic && is_turned(tree, limbs, found);
  if (turns) {
    result.axes.row(0) *= -1;
    result.axes.row(2) *= -1;
    tree = curve_tree(surface, skeleton, result.axes);
    limbs = find_limbs(tree);
    found = classify(tree, limbs, options.plan);
  }
  const std::vector<Place> places = places_of(tree, limbs, found);
  result.plan = found.plan;
  result.reason = found.reason;
  result.joints = Planner(tree, limbs).joints(places, result.axes);
  if (result.plan == BodyKind::humanoid) {
    for (const char* role : required_human_roles) {
      if (std::none_of(result.joints.begin(), result.joints.end(),
                       [&](const PlannedJoint& joint) { return joint.role == role; })) {
        result.missing.emplace_back(role);
      }
    }
  }
  return result;
}

}  // namespace curveskel
