#include <Eigen/Geometry>

#include <algorithm>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/rig_character.hpp>
#include "base/option_ranges.hpp"
#include "rig/joints/sides.hpp"
#include "rig/pipeline/kept_joints.hpp"

namespace curveskel {
namespace {

/// How much would be missed, and which joint it is.
struct Worth {
  bool has_role;
  double moved_area;   ///< by the joint and by those below it that went
  double bone_length;  ///< to the parent
  int joint;

  [[nodiscard]] auto rank() const { return std::tuple(has_role, moved_area, bone_length, -joint); }
};

/// By joint; a corner of a triangle is a third of it.
Eigen::VectorXd areas_moved(const Rig& rig, const Surface& given) {
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(rig.parents.size());
  for (const auto& triangle : given.triangles.rowwise()) {
    const Eigen::Vector3d corner = given.positions.row(triangle[0]).transpose();
    const Eigen::Vector3d second = given.positions.row(triangle[1]).transpose() - corner;
    const Eigen::Vector3d third = given.positions.row(triangle[2]).transpose() - corner;
    const double share = second.cross(third).norm() / 6;
    for (const int vertex : triangle) {
      for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
        moved[it.col()] += static_cast<double>(it.value()) * share;
      }
    }
  }
  return moved;
}

/// Takes joints from the tips of a rig.
class TipTaker {
 public:
  TipTaker(const CharacterRig& character, const Surface& given)
      : character_(character),
        rig_(character.rig),
        moved_(areas_moved(rig_, given)),
        children_(rig_.names.size(), 0),
        twin_(twins_of(rig_)),
        stays_(rig_.names.size(), 1) {
    for (const int parent : rig_.parents) {
      if (parent >= 0) ++children_[idx(parent)];
    }
    for (int joint = 0; joint < static_cast<int>(stays_.size()); ++joint) offer(joint);
  }

  /// A joint and its mirror image go together.
  std::vector<char> leave(std::size_t most) {
    std::size_t left = stays_.size();
    while (left > most && !tips_.empty()) {
      const int joint = tips_.top().joint;
      tips_.pop();
      const int twin = twin_[idx(joint)];
      for (const int one : {joint, twin}) {
        if (one < 0 || stays_[idx(one)] == 0) continue;
        take(one);
        --left;
      }
    }
    return std::move(stays_);
  }

 private:
  [[nodiscard]] bool is_tip(int joint) const {
    return children_[idx(joint)] == 0 && rig_.parents[joint] >= 0 &&
           !is_required(character_, idx(joint));
  }

  [[nodiscard]] Worth worth_of(int joint) const {
    const bool has_role = idx(joint) < rig_.roles.size() && !rig_.roles[idx(joint)].empty();
    const double length = (rig_.joints.row(joint) - rig_.joints.row(rig_.parents[joint])).norm();
    return {has_role, moved_[joint], length, joint};
  }

  void offer(int joint) {
    if (stays_[idx(joint)] == 0 || !is_tip(joint)) return;
    const int twin = twin_[idx(joint)];
    if (twin >= 0 && !is_tip(twin)) return;
    Worth worth = worth_of(joint);
    if (twin >= 0) worth.moved_area = std::max(worth.moved_area, moved_[twin]);
    tips_.push(worth);
  }

  void take(int joint) {
    stays_[idx(joint)] = 0;
    const int parent = rig_.parents[joint];
    moved_[parent] += moved_[joint];
    if (--children_[idx(parent)] > 0) return;
    offer(parent);
  }

  struct IsWorthMore {
    bool operator()(const Worth& a, const Worth& b) const { return a.rank() > b.rank(); }
  };

  const CharacterRig& character_;
  const Rig& rig_;
  Eigen::VectorXd moved_;
  std::vector<int> children_;  // that stay
  std::vector<int> twin_;
  std::vector<char> stays_;
  std::priority_queue<Worth, std::vector<Worth>, IsWorthMore> tips_;
};

}  // namespace

CharacterRig within_budget(CharacterRig character, const Surface& given, int joints) {
  OptionCheck("CharacterOptions").number("joint_budget", joints, {0});
  const std::size_t figures = 1 + character.other_plans.size();
  const std::size_t most = figures * static_cast<std::size_t>(joints);
  const std::size_t count = character.rig.names.size();
  if (joints == 0 || count <= most) return character;
  std::vector<char> stays = TipTaker(character, given).leave(most);
  CharacterRig result = with_joints(std::move(character), std::move(stays));
  result.joints_left_out = static_cast<int>(count - result.rig.names.size());
  return result;
}

}  // namespace curveskel
