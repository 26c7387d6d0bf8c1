#include <algorithm>
#include <map>
#include <queue>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>
#include <curveskel/rig_character.hpp>
#include "base/option_ranges.hpp"
#include "rig/joints/figure_name.hpp"
#include "rig/joints/sides.hpp"
#include "rig/joints/sound_rig.hpp"
#include "rig/pipeline/kept_joints.hpp"
#include "surface/mesh/triangle_area.hpp"

namespace curveskel {
namespace {

/// How much would be missed, and which joint it is.
struct Worth {
  bool has_role;
  double moved_area;   ///< with that of joints that went; of joints that go together the most
  double bone_length;  ///< to the parent that stays
  int joint;

  [[nodiscard]] auto rank() const { return std::tuple(has_role, moved_area, bone_length, -joint); }
};

/// By joint; a corner of a triangle is a third of it.
Eigen::VectorXd areas_moved(const Rig& rig, const Surface& given) {
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(rig.parents.size());
  for (Eigen::Index face = 0; face < given.triangles.rows(); ++face) {
    const double share = twice_area(given, face) / 6;
    for (const int vertex : given.triangles.row(face)) {
      for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
        moved[it.col()] += static_cast<double>(it.value()) * share;
      }
    }
  }
  return moved;
}

/// The digits of a human's hands by their places: 1 for those next to the hand, 3 for the last; 0
/// for all else.
int place_in_digit(std::string_view role) {
  const auto is = [&](std::string_view place) { return role.ends_with(place); };
  const bool is_thumb = role.starts_with("leftThumb") || role.starts_with("rightThumb");
  if (is("Distal")) return 3;
  if (is("Intermediate") || (is_thumb && is("Proximal"))) return 2;
  return is("Proximal") || is("Metacarpal") ? 1 : 0;
}

/// Of a figure's joints those that go together: mirror images, and of the digits of both hands
/// those of one place, as a hand is not left with its little finger alone.
std::vector<std::vector<int>> joints_that_go_together(const Rig& rig) {
  const std::vector<int> twins = twins_of(rig);
  const auto count = static_cast<int>(rig.names.size());
  UnionFind joined(count);
  std::map<std::pair<std::size_t, int>, int> first_digits;  // by figure and place
  for (int joint = 0; joint < count; ++joint) {
    if (twins[idx(joint)] >= 0) joined.unite(joint, twins[idx(joint)]);
    if (idx(joint) >= rig.roles.size()) continue;
    const FigureName role = of_figure(rig.roles[idx(joint)]);
    const int place = place_in_digit(role.own);
    if (place == 0) continue;
    joined.unite(first_digits.try_emplace({role.figure, place}, joint).first->second, joint);
  }
  std::vector<std::vector<int>> together(idx(count));  // by root
  for (int joint = 0; joint < count; ++joint) together[idx(joined.root(joint))].push_back(joint);
  std::vector<std::vector<int>> by_joint(idx(count));
  for (int joint = 0; joint < count; ++joint) {
    by_joint[idx(joint)] = together[idx(joined.root(joint))];
  }
  return by_joint;
}

/// Takes joints from a rig: from its tips, and from within its limbs, where two bones become one. A
/// long limb of many joints so becomes one of few, and is not cut off.
class JointTaker {
 public:
  JointTaker(const CharacterRig& character, const Surface& given)
      : character_(character),
        rig_(character.rig),
        moved_(areas_moved(rig_, given)),
        children_(rig_.names.size(), 0),
        together_(joints_that_go_together(rig_)),
        stays_(rig_.names.size(), 1) {
    for (const int parent : rig_.parents) {
      if (parent >= 0) ++children_[idx(parent)];
    }
  }

  /// Of one figure; the number that stays.
  std::size_t leave(std::size_t figure, std::size_t most) {
    offered_ = {};
    std::size_t left = 0;
    for (int joint = 0; joint < static_cast<int>(stays_.size()); ++joint) {
      if (of_figure(rig_.names[idx(joint)]).figure != figure) continue;
      ++left;
      offer(joint);
    }
    while (left > most && !offered_.empty()) {
      const Worth then = offered_.top();
      const int joint = then.joint;
      offered_.pop();
      if (stays_[idx(joint)] == 0) continue;
      if (worth_of(joint).rank() > then.rank()) {  // it moves more by now
        offer(joint);
        continue;
      }
      for (const int one : together_[idx(joint)]) {
        if (stays_[idx(one)] == 0) continue;
        take(one);
        --left;
      }
    }
    return left;
  }

  [[nodiscard]] const std::vector<char>& stays() const { return stays_; }

 private:
  [[nodiscard]] bool has_role(int joint) const {
    return idx(joint) < rig_.roles.size() && !rig_.roles[idx(joint)].empty();
  }

  /// A knee without which thigh and foot are one bone would be missed, so joints with roles go from
  /// the tips alone.
  [[nodiscard]] bool may_go(int joint) const {
    const int most_children = has_role(joint) ? 0 : 1;
    return children_[idx(joint)] <= most_children && rig_.parents[joint] >= 0 &&
           !is_required(character_, idx(joint));
  }

  [[nodiscard]] int parent_that_stays(int joint) const {
    int parent = rig_.parents[joint];
    while (stays_[idx(parent)] == 0) parent = rig_.parents[parent];
    return parent;
  }

  [[nodiscard]] Worth worth_of(int joint) const {
    const double length =
        (rig_.joints.row(joint) - rig_.joints.row(parent_that_stays(joint))).norm();
    Worth worth{has_role(joint), 0, length, joint};
    for (const int one : together_[idx(joint)]) {
      worth.moved_area = std::max(worth.moved_area, moved_[one]);
    }
    return worth;
  }

  void offer(int joint) {
    if (stays_[idx(joint)] == 0) return;
    const std::vector<int>& all = together_[idx(joint)];
    if (!std::all_of(all.begin(), all.end(), [this](int one) { return may_go(one); })) return;
    offered_.push(worth_of(joint));
  }

  void take(int joint) {
    const int parent = parent_that_stays(joint);
    stays_[idx(joint)] = 0;
    moved_[parent] += moved_[joint];
    if (children_[idx(joint)] == 0) --children_[idx(parent)];
    offer(parent);
  }

  struct IsWorthMore {
    bool operator()(const Worth& a, const Worth& b) const { return a.rank() > b.rank(); }
  };

  const CharacterRig& character_;
  const Rig& rig_;
  Eigen::VectorXd moved_;
  std::vector<int> children_;               // that stay
  std::vector<std::vector<int>> together_;  // by joint, itself among them
  std::vector<char> stays_;
  std::priority_queue<Worth, std::vector<Worth>, IsWorthMore> offered_;
};

}  // namespace

CharacterRig within_budget(CharacterRig character, const Surface& given, int joints) {
  OptionCheck("CharacterOptions").number("joint_budget", joints, {0});
  require_sound(character.rig, "within_budget");
  require_planned_joints(character, "within_budget");
  require_corners(given, "within_budget");
  require_weights_of(character.rig, given.positions.rows(), "within_budget");
  const std::size_t count = character.rig.names.size();
  if (joints == 0 || count <= static_cast<std::size_t>(joints)) return character;
  const auto most = static_cast<std::size_t>(joints);
  std::size_t left = most;
  JointTaker taker(character, given);
  for (std::size_t figure = 0; figure <= character.other_plans.size(); ++figure) {
    left = std::max(left, taker.leave(figure, most));
  }
  CharacterRig result = with_joints(std::move(character), taker.stays());
  result.joints_over_budget = static_cast<int>(left - most);
  result.joints_left_out = static_cast<int>(count - result.rig.names.size());
  return result;
}

}  // namespace curveskel
