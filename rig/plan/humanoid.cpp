#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "base/median.hpp"
#include "rig/plan/human_proportions.hpp"
#include "rig/plan/posed_legs.hpp"
#include "rig/plan/roles.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

class Humanoid {
 public:
  Humanoid(const CurveTree& tree, const Limbs& limbs, const PlanFound& found,
           const CurveTree* posed)
      : tree_(tree),
        limbs_(limbs),
        found_(found),
        posed_(posed),
        leg_(found.legs.empty() ? nullptr : &limbs.pairs[idx(found.legs.front())]),
        arm_(found.arms < 0 ? nullptr : &limbs.pairs[idx(found.arms)]),
        arm_joints_(arm_ == nullptr ? found.hidden->arm->joints : arm_joints(tree, *arm_)),
        trunk_(found.hidden ? found.hidden->trunk : trunk_of_curve(limbs)) {}

  std::vector<Place> places() {
    if (leg_ == nullptr) {
      place_leg_by_proportion(*found_.hidden->leg);
    } else {
      place_leg(*leg_);
    }
    place_arm();
    place_trunk();
    return std::move(places_);
  }

 private:
  /// From below, without what hangs from it in the mirror plane: a rucksack, a lace.
  [[nodiscard]] std::vector<Vector3d> trunk_of_curve(const Limbs& limbs) const {
    const auto is_lower = [&](int a, int b) {
      return tree_.nodes[idx(a)].y() < tree_.nodes[idx(b)].y();
    };
    const int top = *std::max_element(limbs.trunk.begin(), limbs.trunk.end(), is_lower);
    std::vector<Vector3d> trunk;
    for (const int node : ways_from(tree_, leg_->root).path(top)) {
      trunk.push_back(tree_.nodes[idx(node)]);
    }
    std::sort(trunk.begin(), trunk.end(),
              [](const Vector3d& a, const Vector3d& b) { return a.y() < b.y(); });
    return trunk;
  }

  [[nodiscard]] int leg_pair() const { return found_.legs.empty() ? -1 : found_.legs.front(); }

  void add(const std::string& role, const std::string& parent, const Vector3d& at, int pair,
           const std::string& reason, bool on_curve = true) {
    places_.push_back({role, parent, at, on_curve, pair, reason});
    places_.back().is_by_proportion = found_.hidden && pair < 0;
    if (places_.back().is_by_proportion) places_.back().on_curve = false;
  }

  void place_leg_by_proportion(const HiddenLimbs::Leg& leg) {
    hip_ = leg.hip;
    hip_height_ = leg.hip.y();
    add("leftUpperLeg", "hips", leg.hip, -1, "by proportion: .648 of the shoulders' height");
    add("leftLowerLeg", "leftUpperLeg", leg.knee, -1, "by proportion: .56 of the hips' height");
    add("leftFoot", "leftLowerLeg", leg.ankle, -1, "by proportion: .115 of the hips' height");
    add("leftToes", "leftFoot", leg.toes, -1,
        "by proportion: .55 of the way from the ankle to the tip of the foot");
    places_.back().end = leg.tip;
  }

  /// True for a gown, at whose hem legs seem to part: they would be shorter than half of the trunk,
  /// and this longer than twice the way from shoulder to shoulder. A bear's is long, but thick.
  [[nodiscard]] bool hides_legs(double parts) const {
    const double trunk = arm_joints_.shoulder.y() - parts;
    const double shoulders = 2 * std::abs(arm_joints_.shoulder.x() - tree_.middle);
    return 2 * (parts - tree_.ground) < trunk && trunk > 2 * shoulders;
  }

  /// `ankle` is the one that is seen. The trunk's curve has no leg beside it.
  void place_hidden_leg(const Vector3d& ankle) {
    hip_height_ = tree_.ground + hips_of_shoulders * (arm_joints_.shoulder.y() - tree_.ground);
    hip_ = {hip_.x(), hip_height_, depth_at(hip_height_)};
    const double knee = tree_.ground + knee_of_hips * (hip_height_ - tree_.ground);
    const double share = (hip_height_ - knee) / (hip_height_ - ankle.y());
    add("leftUpperLeg", "hips", hip_, leg_pair(),
        "at a human's share of the shoulders' height, in a gown", false);
    add("leftLowerLeg", "leftUpperLeg", hip_ + share * (ankle - hip_), leg_pair(),
        "on the line from the hip to the ankle, in a gown", false);
  }

  /// True for a leg from the hip on that does not stand: more across than down as far as the ankle.
  [[nodiscard]] static bool is_bent(const std::vector<Vector3d>& leg, double ankle) {
    double length = 0;
    std::size_t k = 1;
    for (; k < leg.size() && leg[k - 1].y() > ankle; ++k) length += (leg[k] - leg[k - 1]).norm();
    return (leg.front().y() - leg[k - 1].y()) < std::numbers::sqrt2 / 2 * length;
  }

  void place_leg(const LimbPair& leg) {
    const Course course = mean_course(tree_, leg.ways.front());
    const std::size_t count = course.points.size();
    // Where legs part: the curve's ball is clear of the mirror plane.
    std::size_t parts = 0;
    while (parts + 1 < count &&
           std::abs(course.points[parts].x() - tree_.middle) <= course.radii[parts]) {
      ++parts;
    }
    if (parts + 1 == count) parts = 0;
    const double crotch = course.points[parts].y();
    const double above = 0.5 * course.radii[std::min(parts + 8, count - 1)];
    hip_height_ = std::min(crotch + above, std::max(tree_.nodes[idx(leg.root)].y(), crotch));
    std::vector<double> aside;
    for (std::size_t k = parts; k < std::min(parts + 60, count); ++k) {
      aside.push_back(std::abs(course.points[k].x() - tree_.middle));
    }
    const auto index_at = [&](double y) {
      std::size_t k = parts;
      while (k + 1 < count && course.points[k].y() > y) ++k;
      return k;
    };
    const auto down_to = [&](double y) { return course.points[index_at(y)]; };
    hip_ = {tree_.middle + median_of(aside), hip_height_, down_to(hip_height_).z()};
    const auto at_share = [&](double share) {
      return down_to(tree_.ground + share * (hip_height_ - tree_.ground));
    };
    const bool is_hidden = hides_legs(hip_height_);
    Vector3d ankle = at_share(is_hidden ? 0.5 : ankle_of_hips);
    Vector3d knee = at_share(knee_of_hips);
    const std::size_t hip_index = index_at(hip_height_);
    const auto hip_place = course.points.begin() + static_cast<std::ptrdiff_t>(hip_index);
    const bool is_in_pose =
        posed_ != nullptr || is_bent({hip_place, course.points.end()}, ankle.y());
    std::optional<double> share;
    std::optional<double> way_to_knee;
    if (is_in_pose && !is_hidden) {  // a lifted foot is not as high as its leg is long
      constexpr double of_way = (1 - knee_of_hips) / (1 - ankle_of_hips);
      const auto last = static_cast<double>(count - 1);
      const double hip = static_cast<double>(hip_index) / last;
      share = ankle_in_pose(posed_ != nullptr ? *posed_ : tree_, limbs_, leg.ways.front(), hip);
      way_to_knee = hip + of_way * (*share - hip);
      ankle = course.points[idx(std::lround(*share * last))];
      knee = course.points[idx(std::lround(*way_to_knee * last))];
    }
    double toes = -std::numeric_limits<double>::infinity();
    for (const int v : leg.vertices) {
      const Vector3d& p = tree_.vertices[idx(v)];
      if (p.y() <= ankle.y()) toes = std::max(toes, p.z());  // a belly may reach farther
    }
    if (!std::isfinite(toes)) toes = course.points.back().z();
    if (is_hidden) {
      place_hidden_leg(ankle);
    } else {
      add("leftUpperLeg", "hips", hip_, leg_pair(), "above the place where the legs part");
      add("leftLowerLeg", "leftUpperLeg", knee, leg_pair(),
          way_to_knee ? "half-way from the hip to the ankle, along the leg"
                      : ".56 of the hips' height above the ground");
      if (posed_ != nullptr) places_.back().share = way_to_knee;
    }
    add("leftFoot", "leftLowerLeg", ankle, leg_pair(),
        is_hidden ? "half-way from the hem to the ground"
        : share   ? ".115 of the leg's length above its sole, along the shin"
                  : ".115 of the hips' height above the ground");
    if (posed_ != nullptr) places_.back().share = share;
    add("leftToes", "leftFoot",
        {ankle.x(), tree_.ground + 0.02 * tree_.height, ankle.z() + 0.55 * (toes - ankle.z())},
        leg_pair(), ".55 of the way from the ankle to the tip of the foot");
  }

  void place_arm() {
    const ArmJoints& arm = arm_joints_;
    shoulder_ = arm.shoulder;
    const bool is_hidden = arm_ == nullptr;
    add("leftUpperArm", "leftShoulder", arm.shoulder, found_.arms,
        is_hidden ? "by proportion: beside the trunk, below the neck" : shoulder_reason);
    add("leftLowerArm", "leftUpperArm", arm.elbow, found_.arms,
        is_hidden ? "by proportion: .34 of the arm's reach from the shoulder" : elbow_reason);
    add("leftHand", "leftLowerArm", arm.wrist, found_.arms,
        is_hidden ? "by proportion: as far from the elbow as that from the shoulder"
                  : wrist_reason);
    if (is_hidden) {
      places_.back().end = found_.hidden->arm->fingertips;
      return;
    }
    for (Place& place : finger_places(tree_, *arm_, found_.arms, arm.wrist)) {
      places_.push_back(std::move(place));
    }
  }

  /// z of the trunk's curve at a height.
  [[nodiscard]] double depth_at(double y) const {
    const double lowest = hip_height_ - 0.02 * tree_.height;
    const Vector3d* below = nullptr;
    for (const Vector3d& p : trunk_) {
      if (p.y() <= lowest) continue;
      if (p.y() >= y) {
        if (below == nullptr || p.y() - below->y() < 1e-12 * tree_.size) return p.z();
        const double share = (y - below->y()) / (p.y() - below->y());
        return below->z() + share * (p.z() - below->z());
      }
      below = &p;
    }
    return below == nullptr ? hip_.z() : below->z();
  }

  /// By more than a third of a right angle: the curve may then leave the trunk below the shoulders.
  [[nodiscard]] bool are_arms_raised() const {
    const Vector3d upper = arm_joints_.elbow - arm_joints_.shoulder;
    return arm_ != nullptr && 2 * upper.y() > upper.norm();
  }

  /// The height at which the body is narrowest between the arms and the head.
  [[nodiscard]] double neck_height() const {
    constexpr int slices = 60;
    const bool raised = are_arms_raised();
    const double from =
        arm_ == nullptr || raised ? arm_joints_.shoulder.y() : tree_.nodes[idx(arm_->root)].y();
    double top = from;
    for (const Vector3d& p : tree_.vertices) {
      if (std::abs(p.x() - tree_.middle) < 0.05 * tree_.height) top = std::max(top, p.y());
    }
    const double step = 0.75 * (top - from) / (slices - 1);
    std::vector<std::vector<double>> asides(slices);
    const double thickness = 0.012 * tree_.height;
    const double elbow = std::abs(arm_joints_.elbow.x() - tree_.middle);
    const double widest = std::min(0.16 * tree_.height, raised ? 0.5 * elbow : tree_.size);
    for (const Vector3d& p : tree_.spread) {
      const double aside = std::abs(p.x() - tree_.middle);
      if (aside >= widest) continue;
      for (int k = 0; k < slices; ++k) {
        if (std::abs(p.y() - from - step * k) < thickness) asides[idx(k)].push_back(aside);
      }
    }
    std::vector<double> widths(slices, std::numeric_limits<double>::infinity());
    for (int k = 0; k < slices; ++k) {
      std::vector<double>& slice = asides[idx(k)];
      if (slice.size() < 4) continue;
      const auto most = slice.begin() + std::ptrdiff_t(double(slice.size() - 1) * 0.95);
      std::nth_element(slice.begin(), most, slice.end());
      widths[idx(k)] = *most;
    }
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < slices; ++k) {
      double width = 0;
      for (int j = k - 2; j <= k + 2; ++j) width += widths[idx(std::clamp(j, 0, slices - 1))] / 5;
      if (width >= least) continue;
      least = width;
      best = k;
    }
    return from + step * best;
  }

  void place_trunk() {
    const double ground = tree_.ground;
    const double head = neck_height() + 0.004 * tree_.height;
    const double hips = ground + 0.984 * (hip_height_ - ground);
    // A spine bends no more than from joint to joint: the mean of the curve as far as the next
    // ones.
    const auto at = [&](double share) -> Vector3d {
      constexpr double next = 0.2;
      constexpr int steps = 4;
      double depth = 0;
      for (int k = -steps; k <= steps; ++k) {
        depth += depth_at(hips + (share + k * next / steps) * (head - hips)) / (2 * steps + 1);
      }
      return {tree_.middle, hips + share * (head - hips), depth};
    };
    add("hips", "", {tree_.middle, hips, hip_.z()}, -1, "between the upper legs");
    const std::vector<std::pair<const char*, double>> spine{
        {"spine", 0.16}, {"chest", 0.36}, {"upperChest", 0.58}, {"neck", 0.83}};
    std::string parent = "hips";
    for (const auto& [role, share] : spine) {
      add(role, parent, at(share), -1, "at its share of the way from the hips to the head");
      parent = role;
    }
    add("head", "neck", {tree_.middle, head, depth_at(head)}, -1,
        "above the narrowest place of the neck");
    if (found_.hidden) places_.back().end = trunk_.back();
    Vector3d collar = at(0.78);
    double chest = -std::numeric_limits<double>::infinity();
    for (const Vector3d& p : tree_.spread) {
      const bool is_near = std::abs(p.y() - collar.y()) < 0.02 * tree_.height &&
                           std::abs(p.x() - tree_.middle) < 0.06 * tree_.height;
      if (is_near) chest = std::max(chest, p.z());
    }
    if (std::isfinite(chest)) collar.z() += 0.55 * (chest - collar.z());
    collar.x() += 0.22 * (shoulder_.x() - tree_.middle);
    collar.y() -= 0.012 * tree_.height;
    add("leftShoulder", "upperChest", collar, found_.arms,
        std::string(arm_ == nullptr ? "by proportion: " : "") +
            ".22 of the upper arm's distance from the middle, ahead of the spine",
        false);
  }

  const CurveTree& tree_;
  const Limbs& limbs_;
  const PlanFound& found_;
  const CurveTree* posed_;  // nullptr = as it is
  const LimbPair* leg_;     // nullptr = by proportion
  const LimbPair* arm_;     // the same
  ArmJoints arm_joints_;
  std::vector<Vector3d> trunk_;  // from below
  double hip_height_ = 0;
  Vector3d hip_ = Vector3d::Zero();
  Vector3d shoulder_ = Vector3d::Zero();
  std::vector<Place> places_;
};

}  // namespace

std::vector<Place> humanoid_places(const CurveTree& tree, const Limbs& limbs,
                                   const PlanFound& found, const CurveTree* posed) {
  return Humanoid(tree, limbs, found, posed).places();
}

}  // namespace curveskel
