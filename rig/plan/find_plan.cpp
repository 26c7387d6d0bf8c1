#include <curveskel/body_plan.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include "base/option_ranges.hpp"
#include "rig/plan/frames.hpp"
#include "rig/plan/looks.hpp"
#include "rig/plan/outlook.hpp"
#include "rig/plan/role_words.hpp"
#include "rig/plan/things.hpp"
#include "skeleton/graph/sound_skeleton.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

class Planner {
 public:
  explicit Planner(const Outlook& outlook)
      : tree_(outlook.tree), limbs_(outlook.limbs), outlook_(outlook) {}

  /// Parents before their children.
  std::vector<PlannedJoint> joints(const std::vector<Place>& places) {
    std::vector<char> done(places.size(), 0);
    for (bool grew = true; grew;) {
      grew = false;
      for (std::size_t k = 0; k < places.size(); ++k) {
        const bool may = places[k].parent.empty() || number_.count(places[k].parent) > 0;
        if (done[k] != 0 || !may) continue;
        done[k] = 1;
        grew = true;
        add(places[k], places[k].role, false);
        if (right_role(places[k].role) != places[k].role) {
          add(places[k], right_role(places[k].role), true);
        }
      }
    }
    return own_joints();
  }

 private:
  /// Without those of a limb that the body lacks, and without a shoulder that then holds none.
  std::vector<PlannedJoint> own_joints() {
    const std::size_t count = joints_.size();
    std::vector<char> is_own(count, 1);
    std::vector<int> below(count, 0);
    for (std::size_t k = 0; k < count; ++k) {
      const int parent = joints_[k].parent;
      const bool hangs_from_own = parent < 0 || is_own[idx(parent)] != 0;
      is_own[k] = hangs_from_own && joints_[k].node < tree_.own_nodes ? 1 : 0;
      if (parent >= 0) below[idx(parent)] += 1;
    }
    for (std::size_t k = count; k-- > 0;) {
      const int parent = joints_[k].parent;
      if (is_own[k] == 0 && parent >= 0) below[idx(parent)] -= 1;
      if (is_own[k] == 0 && parent >= 0 && below[idx(parent)] == 0 &&
          joints_[idx(parent)].node < 0) {
        is_own[idx(parent)] = 0;
      }
    }
    std::vector<int> number(count, -1);
    std::vector<PlannedJoint> own;
    own.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
      if (is_own[k] == 0) continue;
      number[k] = static_cast<int>(own.size());
      own.push_back(std::move(joints_[k]));
      if (own.back().parent >= 0) own.back().parent = number[idx(own.back().parent)];
    }
    return own;
  }

  void add(const Place& place, const std::string& role, bool is_right) {
    PlannedJoint joint;
    joint.role = role;
    joint.reason = place.reason;
    joint.is_last = place.is_last;
    if (!place.parent.empty()) {
      joint.parent = number_.at(is_right && number_.count(right_role(place.parent)) > 0
                                    ? right_role(place.parent)
                                    : place.parent);
    }
    Vector3d at = place.at;
    const bool is_by_sides = outlook_.sides == Sides::own || outlook_.sides == Sides::completed;
    if (is_by_sides && !place.is_by_proportion) {
      at += way_to_own_side(place, is_right);
    }
    if (is_right) at.x() = 2 * tree_.middle - at.x();
    if (outlook_.sides == Sides::posed) at += way_into_pose(place, is_right, at);
    joint.position = (outlook_.axes.transpose() * at).transpose();
    if (place.end) joint.end = end_of(*place.end, is_right);
    if (place.on_curve) {
      Vector3d beside = place.beside.value_or(place.at);
      if (is_right) beside.x() = 2 * tree_.middle - beside.x();
      joint.node = place.node >= 0 ? place.node : nearest(place, is_right, beside);
    }
    number_[role] = static_cast<int>(joints_.size());
    joints_.push_back(std::move(joint));
  }

  [[nodiscard]] Eigen::RowVector3d end_of(Vector3d end, bool is_right) const {
    if (is_right) end.x() = 2 * tree_.middle - end.x();
    return (outlook_.axes.transpose() * end).transpose();
  }

  /// From the mean of both sides, of a right one mirrored; in the trunk from the mirror plane.
  [[nodiscard]] Vector3d way_to_own_side(const Place& place, bool is_right) const {
    if (place.pair < 0) {
      const int node = nearest(place, false, place.at);
      return {node < 0 ? 0 : tree_.nodes[idx(node)].x() - place.at.x(), 0, 0};
    }
    const LimbWay& way = limbs_.pairs[idx(place.pair)].ways[place.way];
    const Course mean = mean_course(tree_, way);
    const Course own = side_course(tree_, way, !is_right);
    std::size_t best = 0;
    for (std::size_t k = 1; k < mean.points.size(); ++k) {
      const double off = (mean.points[k] - place.at).squaredNorm();
      if (off < (mean.points[best] - place.at).squaredNorm()) best = k;
    }
    return own.points[best] - mean.points[best];
  }

  /// As the nearest node of the unposed limb moves.
  [[nodiscard]] Vector3d way_into_pose(const Place& place, bool is_right,
                                       const Vector3d& at) const {
    const int node = place.node >= 0 ? place.node : nearest(place, is_right, at);
    if (node < 0) return Vector3d::Zero();
    return outlook_.posed.nodes[idx(node)] - tree_.nodes[idx(node)];
  }

  [[nodiscard]] int nearest(const Place& place, bool is_right, const Vector3d& at) const {
    const LimbWay* way = place.pair < 0 ? nullptr : &limbs_.pairs[idx(place.pair)].ways[place.way];
    const std::vector<int>& nodes =
        way == nullptr ? limbs_.trunk : (is_right ? way->mirror : way->path);
    if (place.share) return node_in_pose(nodes, *place.share);
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

  /// Of a way the node at this share; legs whose mean folds have others as near.
  [[nodiscard]] int node_in_pose(const std::vector<int>& way, double share) const {
    const std::vector<Vector3d>& nodes = outlook_.posed.nodes;
    std::vector<double> lengths{0};
    for (std::size_t k = 1; k < way.size(); ++k) {
      lengths.push_back(lengths.back() + (nodes[idx(way[k])] - nodes[idx(way[k - 1])]).norm());
    }
    const double wanted = share * lengths.back();
    const auto is_nearer = [&](double a, double b) {
      return std::abs(a - wanted) < std::abs(b - wanted);
    };
    return way[idx(std::min_element(lengths.begin(), lengths.end(), is_nearer) - lengths.begin())];
  }

  const CurveTree& tree_;
  const Limbs& limbs_;
  const Outlook& outlook_;
  std::map<std::string, int> number_;  // by role
  std::vector<PlannedJoint> joints_;
};

std::vector<Place> places_of(Outlook& outlook) {
  const CurveTree& tree = outlook.tree;
  const Limbs& limbs = outlook.limbs;
  PlanFound& found = outlook.found;
  switch (found.plan) {
    case BodyKind::humanoid:
      return humanoid_places(tree, limbs, found,
                             outlook.sides == Sides::posed ? &outlook.posed : nullptr);
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

int ends_of(const CurveSkeleton& skeleton) {
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  return static_cast<int>(std::count(degree.begin(), degree.end(), 1));
}

void require_sheets_of(const Surface& surface, const PlanOptions& options) {
  for (const std::int32_t vertex : options.sheets) {
    if (vertex >= 0 && vertex < surface.positions.rows()) continue;
    throw Error(Fault::usage, "PlanOptions::sheets has vertex " + std::to_string(vertex) +
                                  ", needed 0.." + std::to_string(surface.positions.rows() - 1));
  }
}

/// Who lies on his back stands on arms and legs as an animal does, but may be put together, of
/// clothes. A table is alike from both ends.
std::optional<Outlook> human_instead(const Outlook& animal, const Surface& surface,
                                     const CurveSkeleton& skeleton, const PlanOptions& options) {
  if (animal.found.plan != BodyKind::quadruped || is_alike_from_both_ends(animal)) return {};
  PlanOptions asked = options;
  asked.plan = BodyKind::humanoid;
  asked.by_proportion = false;
  Outlook human = best_outlook(surface, skeleton, asked);
  const bool is_one = human.found.plan == BodyKind::humanoid && !human.found.is_forced &&
                      !human.found.is_astride && human.tree.cycles == 0 && has_trunk(human) &&
                      explained_by(human).share >= most_of_it &&
                      why_a_thing(human, surface, asked).empty();
  return is_one ? std::optional<Outlook>(std::move(human)) : std::nullopt;
}

constexpr const char* not_made_of_tubes =
    "the surface is not made of tubes, as bodies are; a plan can be asked for";

}  // namespace

void require_valid(const PlanOptions& options) {
  const OptionCheck check("PlanOptions");
  check.choice("plan", options.plan, body_kinds);
  check.choice("up", options.up, directions);
  check.choice("front", options.front, directions);
  (void)frames_of(options);
}

BodyPlan find_plan(const Surface& surface, const CurveSkeleton& skeleton,
                   const PlanOptions& options) {
  require_valid(options);
  require_corners(surface, "find_plan");
  require_sheets_of(surface, options);
  require_sound_places(skeleton, "find_plan");
  require_vertices_of(skeleton, surface, "find_plan");
  BodyPlan result;
  if (options.plan == BodyKind::none || skeleton.nodes.rows() < 2) return result;
  const int ends = ends_of(skeleton);
  if (options.plan == BodyKind::automatic && ends > most_ends) {
    result.plan = BodyKind::other;
    result.axes = frames_of(options).front().array() + 0.0;
    result.reason = std::to_string(ends) + " ends of curves, more than a body has with its hair (" +
                    std::to_string(most_ends) + "); a plan can be asked for";
    return result;
  }
  Outlook outlook = best_outlook(surface, skeleton, options);
  const bool is_found = options.plan == BodyKind::automatic;
  if (is_found && !options.made_of_tubes && !has_body_of_tubes(outlook)) {
    outlook.found = {};
    outlook.found.reason = not_made_of_tubes;
  } else if (is_found) {
    const std::string why = why_a_thing(outlook, surface, options);
    std::optional<Outlook> human;
    if (!why.empty()) human = human_instead(outlook, surface, skeleton, options);
    if (human) {
      outlook = std::move(*human);
    } else {
      if (!why.empty()) outlook.found.plan = BodyKind::other;
      outlook.found.reason.insert(0, why);
    }
  }
  const std::vector<Place> places = places_of(outlook);
  result.axes = outlook.axes.array() + 0.0;  // no -0
  result.plan = outlook.found.plan;
  result.reason = outlook.found.reason;
  if (result.plan == BodyKind::other && options.plan != BodyKind::automatic &&
      options.plan != BodyKind::other) {
    result.reason.insert(
        0, "no " + std::string(name_of(body_kinds, options.plan)) + ", which was asked for: ");
  }
  result.joints = Planner(outlook).joints(places);
  result.is_forced = outlook.found.is_forced;
  result.is_in_pose = outlook.sides == Sides::posed;
  result.by_proportion = outlook.found.hidden.has_value();
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
