#include "rig/plan/standing.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/plan/body_sections.hpp"
#include "rig/plan/frames.hpp"
#include "rig/plan/human_pairs.hpp"
#include "rig/plan/human_proportions.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

bool is_upright(const CurveTree& tree) {
  constexpr double least = 0.75;      // of the size: arms may be held out
  constexpr double most_aslant = 35;  // degrees, as of any humanoid
  return tree.height > least * tree.size && BodySections(tree, {}).lean() < most_aslant;
}

/// All nodes of the pairs' limbs, of both sides.
std::vector<char> nodes_of(const CurveTree& tree, const Limbs& limbs, const HumanPairs& pairs) {
  std::vector<char> is_limb(tree.nodes.size(), 0);
  for (const int pair : {pairs.legs, pairs.arms}) {
    if (pair < 0) continue;
    std::vector<char> seen = limbs.is_trunk;
    for (const LimbWay& way : limbs.pairs[idx(pair)].ways) {
      for (const std::vector<int>* path : {&way.path, &way.mirror}) {
        for (const int first : *path) {
          if (seen[idx(first)] != 0) continue;
          for (const int node : part_of(tree, first, seen)) is_limb[idx(node)] = 1;
        }
      }
    }
  }
  return is_limb;
}

/// Places of the limbs that are hidden, and of the trunk.
class ByProportion {
 public:
  ByProportion(const CurveTree& tree, const BodySections& sections, double shoulders)
      : tree_(tree), sections_(sections), shoulders_(shoulders - tree.ground) {}

  /// Straight down from the hip, a quarter of the width from the middle where a body is slim.
  [[nodiscard]] HiddenLimbs::Leg leg() const {
    const double hips = hips_of_shoulders * shoulders_;
    const double depth = sections_.at(tree_.ground + hips).middle().y();
    const auto place = [&](double height, double ahead) -> Vector3d {
      const double y = tree_.ground + height;
      const BodySection section = sections_.at(y);
      const double aside = std::min(hip_aside * shoulders_, 0.25 * section.width());
      return {tree_.middle + aside, y, section.depth_within(depth + ahead * shoulders_)};
    };
    HiddenLimbs::Leg leg;
    leg.hip = place(hips, 0);
    leg.knee = place(knee_of_hips * hips, knee_ahead);
    leg.ankle = place(ankle_of_hips * hips, -ankle_behind);
    const double sole = tree_.ground + 0.02 * tree_.height;
    const double ahead = std::clamp(sections_.at(sole).front - leg.ankle.z(), 1e-3 * shoulders_,
                                    foot_reach * shoulders_);
    leg.toes = {leg.ankle.x(), sole, leg.ankle.z() + 0.55 * ahead};
    leg.tip = {leg.ankle.x(), sole, leg.ankle.z() + ahead};
    return leg;
  }

  /// Straight out to what reaches farther aside than any robe; else down along the side; where
  /// there is no room for hands beside the hips, the forearms are folded ahead of the body. `whole`
  /// has the limbs, too: hands may touch the thighs.
  [[nodiscard]] HiddenLimbs::Arm arm(const BodySections& whole) const {
    const auto place = [&](double share) -> Vector3d {
      const double y = tree_.ground + shoulders_ - share * arm_reach * shoulders_;
      const BodySection section = whole.at(y);
      const double outwards = shoulder_aside + hanging_slope * share * arm_reach;
      const double aside = std::min(outwards * shoulders_, aside_within(section));
      return {tree_.middle + aside, y, section.middle().y()};
    };
    const Vector3d out = whole.outermost();
    if (is_held_out(out)) {
      const Vector3d from = place(0);
      const Vector3d arm = out - from;
      return {{from, from + 0.5 * wrist_of_reach * arm, from + wrist_of_reach * arm}, out};
    }
    const ArmJoints arm{place(0), place(0.5 * wrist_of_reach), place(wrist_of_reach)};
    const bool hangs = arm.wrist.x() > arm.shoulder.x() - 1e-9 * tree_.size;
    return hangs ? HiddenLimbs::Arm{arm, place(1)} : folded(arm, whole.at(arm.elbow.y()));
  }

  /// The middles of sections, in the mirror plane.
  [[nodiscard]] std::vector<Vector3d> trunk() const {
    constexpr int steps = 40;
    std::vector<Vector3d> trunk;
    for (int k = 0; k <= steps; ++k) {
      const double y = tree_.ground + tree_.height * k / steps;
      trunk.emplace_back(tree_.middle, y, sections_.at(y).middle().y());
    }
    return trunk;
  }

 private:
  /// By two thirds of its reach: at 45 degrees or more from hanging.
  [[nodiscard]] bool is_held_out(const Vector3d& fingertips) const {
    const double least = (shoulder_aside + 2.0 / 3 * arm_reach) * shoulders_;
    const double hips = tree_.ground + hips_of_shoulders * shoulders_;
    return fingertips.x() - tree_.middle > least && fingertips.y() > hips;
  }

  /// Of an arm's middle: inside by its radius, or half-way.
  [[nodiscard]] double aside_within(const BodySection& section) const {
    return std::max(0.5 * section.width() - arm_radius * shoulders_, 0.25 * section.width());
  }

  /// The forearm reaches ahead as far as the body does, and up to the mirror plane.
  [[nodiscard]] HiddenLimbs::Arm folded(ArmJoints arm, const BodySection& section) const {
    const double length = 0.5 * wrist_of_reach * arm_reach * shoulders_;
    const double ahead =
        std::clamp(section.front - arm_radius * shoulders_ - arm.elbow.z(), 0.0, length);
    const double across =
        std::min(std::sqrt(length * length - ahead * ahead), arm.elbow.x() - tree_.middle);
    arm.wrist = arm.elbow + Vector3d(-across, 0, ahead);
    const double hand = (1 - wrist_of_reach) * arm_reach * shoulders_;
    const double side = tree_.middle - aside_within(section);
    const double fingertips = std::min(std::max(arm.wrist.x() - hand, side), arm.wrist.x());
    return {arm, {fingertips, arm.wrist.y(), arm.wrist.z()}};
  }

  const CurveTree& tree_;
  const BodySections& sections_;
  double shoulders_;  // height above the ground
};

/// Below the neck where one is seen.
double height_of_shoulders(const CurveTree& tree, const BodySections& sections) {
  const std::optional<double> neck = sections.neck();
  return neck ? tree.ground + shoulders_of_neck * (*neck - tree.ground)
              : tree.ground + shoulders_of_height * tree.height;
}

std::string reason_of(const HumanPairs& seen) {
  if (seen.legs >= 0 && seen.arms >= 0) return "as asked; a pair of legs and one of arms";
  const std::string limbs = seen.legs >= 0 ? "arms" : seen.arms >= 0 ? "legs" : "legs and arms";
  return "as asked; " + limbs + " are not seen and stand by a human's proportions";
}

}  // namespace

bool shows_side(const CurveTree& tree) {
  constexpr double deeper = 1.5;
  std::vector<Vector3d> upper;
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : tree.spread) {
    if (p.y() < tree.ground + 0.5 * tree.height) continue;
    upper.push_back(p);
    mean += p;
  }
  mean /= std::max<double>(1, static_cast<double>(upper.size()));
  double width = 0;
  double depth = 0;
  for (const Vector3d& p : upper) {
    width += (p.x() - mean.x()) * (p.x() - mean.x());
    depth += (p.z() - mean.z()) * (p.z() - mean.z());
  }
  return depth > deeper * deeper * width;
}

bool shows_all_limbs(const Outlook& outlook) {
  const std::vector<int>& legs = outlook.found.legs;
  if (outlook.sides == Sides::posed) return !legs.empty() && outlook.found.arms >= 0;
  if (!is_upright(outlook.tree)) return false;
  const HumanPairs seen = human_pairs(outlook.tree, outlook.limbs);
  return !legs.empty() && legs.front() == seen.legs && outlook.found.arms == seen.arms;
}

Outlook as_standing(Outlook outlook) {
  CurveTree& tree = outlook.tree;
  const HumanPairs seen = human_pairs(tree, outlook.limbs);
  const BodySections sections(tree, nodes_of(tree, outlook.limbs, seen));
  const double shoulders = seen.arms < 0
                               ? height_of_shoulders(tree, sections)
                               : arm_joints(tree, outlook.limbs.pairs[idx(seen.arms)]).shoulder.y();
  if (seen.legs < 0 && seen.arms < 0) tree.middle = sections.mirror_plane();
  PlanFound& found = outlook.found;
  found = {};
  found.plan = BodyKind::humanoid;
  found.reason = reason_of(seen);
  found.arms = seen.arms;
  if (seen.legs >= 0) found.legs = {seen.legs};
  const ByProportion standing(tree, sections, shoulders);
  HiddenLimbs hidden;
  if (seen.legs < 0) hidden.leg = standing.leg();
  if (seen.arms < 0) hidden.arm = standing.arm(BodySections(tree, {}));
  hidden.trunk = standing.trunk();
  found.hidden = std::move(hidden);
  return outlook;
}

std::optional<Outlook> best_standing(LookedAt& body, const PlanOptions& options) {
  const bool is_up_said = options.up != Direction::automatic;
  std::optional<Outlook> best;
  int most = -1;
  for (const Sides sides : {Sides::images, Sides::own}) {
    for (const Eigen::Matrix3d& axes : frames_of(options)) {
      Outlook outlook = look(sides, body, axes, BodyKind::other);
      const CurveTree& tree = outlook.tree;
      if (outlook.limbs.is_trunk.empty()) continue;  // too many tips to look at
      if (!is_up_said && !is_upright(tree)) continue;
      const HumanPairs seen = human_pairs(tree, outlook.limbs);
      const int count =
          (seen.legs >= 0 ? 2 : 0) + (seen.arms >= 0 ? 2 : 0) + (shows_side(tree) ? 0 : 1);
      if (count <= most) continue;
      most = count;
      best = std::move(outlook);
    }
  }
  if (best) best = as_standing(std::move(*best));
  return best;
}

}  // namespace curveskel
