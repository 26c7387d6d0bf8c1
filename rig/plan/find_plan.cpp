#include <curveskel/body_plan.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/topology.hpp>
#include "rig/plan/roles.hpp"
#include "surface/mesh/component_areas.hpp"

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

/// The usual ones first: y up and z ahead, as in glTF, or z up and -y ahead, as in Blender; then
/// those of a body that looks aside.
std::vector<Eigen::Matrix3d> frames_of(const PlanOptions& options) {
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

/// "left.." and "..L" of the right.
std::string mirrored(const std::string& role) {
  if (role.starts_with("left")) return "right" + role.substr(4);
  if (role.ends_with(".L")) return role.substr(0, role.size() - 1) + "R";
  return role;
}

/// Of bodies whose sides are not quite images of each other joints lie on their own side's curve.
enum class Sides { images, own };

class Planner {
 public:
  Planner(const CurveTree& tree, const Limbs& limbs, Sides sides)
      : tree_(tree), limbs_(limbs), sides_(sides) {}

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
    if (sides_ == Sides::own) at += way_to_own_side(place, is_right);
    if (is_right) at.x() = 2 * tree_.middle - at.x();
    joint.position = (axes.transpose() * at).transpose();
    if (place.on_curve) {
      Vector3d beside = place.beside.value_or(place.at);
      if (is_right) beside.x() = 2 * tree_.middle - beside.x();
      joint.node = place.node >= 0 ? place.node : nearest(place, is_right, beside);
    }
    number_[role] = static_cast<int>(joints_.size());
    joints_.push_back(std::move(joint));
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
  Sides sides_;
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

/// A frame, and the body as one sees it there.
struct Outlook {
  Eigen::Matrix3d axes;
  CurveTree tree;
  Limbs limbs;
  PlanFound found;
  Sides sides = Sides::images;
};

/// The mean distance of the curve's mirror image from the curve, of the size.
double asymmetry(const CurveTree& tree, double middle) {
  constexpr std::size_t samples = 300;
  const std::size_t stride = 1 + tree.nodes.size() / samples;
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < tree.nodes.size(); k += stride) {
    Vector3d image = tree.nodes[k];
    image.x() = 2 * middle - image.x();
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3d& other : tree.nodes) least = std::min(least, (other - image).squaredNorm());
    sum += std::sqrt(least);
    ++count;
  }
  return sum / (std::max(count, 1) * tree.size);
}

constexpr double symmetric = 0.02;  // of the size, that a curve is off its mirror image

std::vector<int> tips_of(const CurveTree& tree) {
  std::vector<int> tips;
  for (int node = 0; node < static_cast<int>(tree.nodes.size()); ++node) {
    if (tree.is_tip(node)) tips.push_back(node);
  }
  return tips;
}

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
  double least = asymmetry(tree, best);
  for (const double middle : middles_of(tree, tips)) {
    const double off = asymmetry(tree, middle);
    if (off >= least) continue;
    least = off;
    best = middle;
  }
  return best;
}

/// Two pairs of limbs that are where they should be are no accident.
bool is_clear(BodyKind plan) { return plan == BodyKind::humanoid || plan == BodyKind::quadruped; }

Outlook look(const Surface& surface, const CurveSkeleton& skeleton, const Eigen::Matrix3d& axes,
             BodyKind wanted) {
  Outlook outlook{axes, curve_tree(surface, skeleton, axes), {}, {}};
  outlook.limbs = find_limbs(outlook.tree);
  outlook.found = classify(outlook.tree, outlook.limbs, wanted);
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

/// For bodies in which nothing is seen by the middle of the box: a weapon in one hand moves it, and
/// the hand's tip.
Outlook second_look(const Surface& surface, const CurveSkeleton& skeleton,
                    const Eigen::Matrix3d& axes, BodyKind wanted) {
  constexpr std::size_t most_tips = 1000;  // of a body, with all of its hair
  Outlook moved{axes, curve_tree(surface, skeleton, axes), {}, {}, Sides::own};
  const std::vector<int> tips = tips_of(moved.tree);
  if (tips.size() > most_tips) return moved;
  moved.tree.middle = middle_of_tips(moved.tree, tips);
  moved.limbs = find_limbs(moved.tree, Images::within_limbs);
  moved.found = classify(moved.tree, moved.limbs, wanted);
  if (is_clear(moved.found.plan) && !sides_are_alike(moved)) moved.found.plan = BodyKind::other;
  return moved;
}

/// In frames that are not the usual one: a tailed biped whose head is no lower than its hips.
/// No fish and no bird, as any long thing and any cross is one from somewhere.
bool is_seen_from_aside(const Outlook& outlook, double off) {
  constexpr double level = 90;  // degrees from upright
  return outlook.found.plan == BodyKind::tailed_biped && outlook.found.lean < level &&
         off < symmetric;
}

/// In the usual frame what is seen there; in others what is clear, of that the most symmetric, or
/// a tailed biped.
Outlook best_outlook(const Surface& surface, const CurveSkeleton& skeleton,
                     const PlanOptions& options) {
  const std::vector<Eigen::Matrix3d> frames = frames_of(options);
  Outlook best = look(surface, skeleton, frames.front(), options.plan);
  double off = asymmetry(best.tree, best.tree.middle);
  if (is_clear(best.found.plan) && off < symmetric) return best;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    Outlook other = look(surface, skeleton, frames[k], options.plan);
    const double other_off = asymmetry(other.tree, other.tree.middle);
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
    if (is_clear(other.found.plan)) best = std::move(other);
  }
  return best;
}

bool is_turned(const Outlook& outlook, const PlanOptions& options) {
  if (options.front != Direction::automatic) return false;
  const auto& [axes, tree, limbs, found, sides] = outlook;
  if (found.plan == BodyKind::quadruped) return looks_back(tree, limbs, found);
  if (found.plan == BodyKind::fish) return swims_back(tree, limbs);
  const bool has_toes = found.plan == BodyKind::humanoid || found.plan == BodyKind::bird ||
                        found.plan == BodyKind::tailed_biped;
  return has_toes && !options.faces_minus_z && toes_point_back(tree, limbs, found);
}

/// Of the area that is no sheet's.
double share_of_largest_component(const Surface& surface, const std::vector<std::int32_t>& sheets) {
  const Topology counted = topology(surface);
  std::vector<double> areas = component_areas(surface, counted);
  for (const std::int32_t v : sheets) areas[idx(counted.component_of_vertex[v])] = 0;
  const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
  return all > 0 ? *std::max_element(areas.begin(), areas.end()) / all : 1;
}

/// A table has four legs, too, but is put together; dolls and robots are, as well, so this says
/// nothing about humans.
bool is_put_together(const Surface& surface, BodyKind plan, const PlanOptions& options) {
  constexpr double most_of_it = 0.5;
  const bool is_animal = plan != BodyKind::humanoid && plan != BodyKind::other;
  return is_animal && share_of_largest_component(surface, options.sheets) < most_of_it;
}

}  // namespace

void require_valid(const PlanOptions& options) { (void)frames_of(options); }

BodyPlan find_plan(const Surface& surface, const CurveSkeleton& skeleton,
                   const PlanOptions& options) {
  BodyPlan result;
  if (options.plan == BodyKind::none || skeleton.nodes.rows() < 2) return result;
  if (options.plan == BodyKind::automatic && !options.made_of_tubes) {
    result.plan = BodyKind::other;
    result.axes = frames_of(options).front().array() + 0.0;  // no -0
    result.reason = "the surface is not made of tubes, as bodies are; --plan asks for one";
    return result;
  }
  Outlook outlook = best_outlook(surface, skeleton, options);
  if (is_turned(outlook, options)) {
    Eigen::Matrix3d axes = outlook.axes;
    axes.row(0) *= -1;
    axes.row(2) *= -1;
    outlook = outlook.sides == Sides::own ? second_look(surface, skeleton, axes, options.plan)
                                          : look(surface, skeleton, axes, options.plan);
  }
  if (options.plan == BodyKind::automatic &&
      is_put_together(surface, outlook.found.plan, options)) {
    outlook.found.plan = BodyKind::other;
    outlook.found.reason =
        "most of an animal is one component, which here is less than half; " + outlook.found.reason;
  }
  const std::vector<Place> places = places_of(outlook.tree, outlook.limbs, outlook.found);
  result.axes = outlook.axes.array() + 0.0;  // no -0
  result.plan = outlook.found.plan;
  result.reason = outlook.found.reason;
  if (result.plan == BodyKind::other && options.plan != BodyKind::automatic &&
      options.plan != BodyKind::other) {
    result.reason.insert(
        0, "no " + std::string(name_of(body_kinds, options.plan)) + ", which was asked for: ");
  }
  result.joints = Planner(outlook.tree, outlook.limbs, outlook.sides).joints(places, result.axes);
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
