#include "rig/joints/bone_axes.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/joints/limb_name.hpp"

namespace curveskel {
namespace {

class BoneWays {
 public:
  explicit BoneWays(const Rig& rig)
      : rig_(rig),
        names_(readable_names(rig)),
        children_(idx(rig.parents.size())),
        lengths_(children_.size(), 0) {
    const auto count = static_cast<int>(children_.size());
    for (int joint = 0; joint < count; ++joint) {
      if (rig.parents[joint] >= 0) children_[idx(rig.parents[joint])].push_back(joint);
    }
    for (int joint = count; joint-- > 0;) {
      const int parent = rig.parents[joint];
      if (parent < 0) continue;
      lengths_[idx(joint)] += way(parent, joint).norm();
      lengths_[idx(parent)] += lengths_[idx(joint)];
    }
  }

  /// From a joint to where its bone leads; zero where it goes straight on.
  [[nodiscard]] Eigen::Vector3d of(int joint) const {
    const std::vector<Target> targets = targets_of(joint);
    if (targets.empty()) return Eigen::Vector3d::Zero();
    const int parent = rig_.parents[joint];
    const Eigen::Vector3d before =
        parent < 0 ? Eigen::Vector3d::Zero() : way(parent, joint).normalized();
    double longest = std::numeric_limits<double>::min();
    for (const Target& target : targets) longest = std::max(longest, target.length);
    const auto worth = [&](const Target& target) {
      constexpr double weight = 0.65;  // a stub straight on is no match for a limb aside
      return target.way.normalized().dot(before) + weight * target.length / longest;
    };
    const auto less = [&](const Target& a, const Target& b) {
      constexpr double rounding = 1e-9;
      return worth(a) < worth(b) - rounding;
    };
    return std::max_element(targets.begin(), targets.end(), less)->way;
  }

 private:
  struct Target {
    Eigen::Vector3d way;
    double length;  ///< of all bones from there on
  };

  [[nodiscard]] Eigen::Vector3d way(int from, int to) const {
    return (rig_.joints.row(to) - rig_.joints.row(from)).transpose();
  }

  /// A bone in the mirror plane stays there: limbs that have a side count only where there is
  /// nothing else, and as pairs.
  [[nodiscard]] std::vector<Target> targets_of(int joint) const {
    std::vector<Target> all;
    std::vector<Target> middle;
    for (const int child : children_[idx(joint)]) {
      all.push_back({way(joint, child), lengths_[idx(child)]});
      if (side_in(names_[idx(child)]) == 0) middle.push_back(all.back());
    }
    if (all.size() < 2 || side_in(names_[idx(joint)]) != 0) return all;
    if (middle.empty()) middle = pairs_of(joint);
    return middle.empty() ? all : middle;
  }

  /// Their middle; straight on where they lead apart.
  [[nodiscard]] std::vector<Target> pairs_of(int joint) const {
    constexpr double apart = 0.1;
    std::vector<Target> pairs;
    for (const int left : children_[idx(joint)]) {
      if (side_in(names_[idx(left)]) != 'L') continue;
      for (const int right : children_[idx(joint)]) {
        if (!are_pair(names_[idx(left)], names_[idx(right)])) continue;
        const Eigen::Vector3d a = way(joint, left);
        const Eigen::Vector3d b = way(joint, right);
        const bool is_far = (a + b).norm() > apart * (a.norm() + b.norm());
        pairs.push_back({is_far ? (0.5 * (a + b)).eval() : Eigen::Vector3d::Zero().eval(),
                         lengths_[idx(left)] + lengths_[idx(right)]});
      }
    }
    return pairs;
  }

  [[nodiscard]] static bool are_pair(std::string_view left, std::string_view right) {
    return side_in(right) == 'R' && without_side(left) == without_side(right);
  }

  const Rig& rig_;
  const std::vector<std::string>& names_;
  std::vector<std::vector<int>> children_;
  std::vector<double> lengths_;  // by joint: of all bones below it and its own from its parent
};

}  // namespace

std::vector<Eigen::Quaterniond> bone_axes(const Rig& rig) {
  const BoneWays ways(rig);
  std::vector<Eigen::Quaterniond> axes;
  axes.reserve(idx(rig.parents.size()));
  for (int joint = 0; joint < rig.parents.size(); ++joint) {
    const int parent = rig.parents[joint];
    Eigen::Quaterniond turned =
        parent < 0 ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond(axes[idx(parent)]);
    const Eigen::Vector3d before = turned * Eigen::Vector3d::UnitY();
    const Eigen::Vector3d bone = ways.of(joint);
    if (bone.norm() > 0) {
      turned = Eigen::Quaterniond::FromTwoVectors(before, bone) * turned;
      turned.normalize();
    }
    axes.push_back(turned);
  }
  return axes;
}

}  // namespace curveskel
