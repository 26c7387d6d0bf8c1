#include "rig/skin/given_joints.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/joints/rooted_tree.hpp"

namespace curveskel {
namespace {

struct Bone {
  int upper;
  int lower;  ///< the same as `upper` for a joint none of whose bones lies inside
};

class Bones {
 public:
  Bones(const CurveSkeleton& skeleton, const Rig& given)
      : skeleton_(skeleton), given_(given), radii_(usable_radii(skeleton)) {
    const auto count = static_cast<int>(given.parents.size());
    std::vector<Bone> outside;
    std::vector<bool> has_bone(idx(count), false);
    for (int joint = 0; joint < count; ++joint) {
      if (given.parents[joint] < 0) continue;
      const Bone bone{given.parents[joint], joint};
      if (is_inside(bone)) {
        all_.push_back(bone);
        has_bone[idx(bone.upper)] = has_bone[idx(bone.lower)] = true;
      } else {
        outside.push_back(bone);
      }
    }
    for (int joint = 0; joint < count; ++joint) {
      const Bone alone{joint, joint};
      if (!has_bone[idx(joint)] && is_inside(alone)) all_.push_back(alone);
    }
    if (all_.empty()) all_ = outside;
    if (all_.empty()) all_.push_back({0, 0});
  }

  /// The joint at the upper end of the nearest bone, or at its lower end where the point lies
  /// beyond.
  [[nodiscard]] int joint_at(const Eigen::RowVector3d& point) const {
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const Bone& bone : all_) {
      const Eigen::RowVector3d way = given_.joints.row(bone.lower) - given_.joints.row(bone.upper);
      const double squared = std::max(way.squaredNorm(), std::numeric_limits<double>::min());
      const double share = (point - given_.joints.row(bone.upper)).dot(way) / squared;
      const Eigen::RowVector3d nearest =
          given_.joints.row(bone.upper) + std::clamp(share, 0.0, 1.0) * way;
      const double distance = (point - nearest).squaredNorm();
      if (distance > least) continue;
      least = distance;
      best = share >= 1 ? bone.lower : bone.upper;
    }
    return best;
  }

 private:
  /// Most of it lies within balls of the curve.
  [[nodiscard]] bool is_inside(const Bone& bone) const {
    constexpr int samples = 8;
    constexpr double slack = 1.25;  // balls on the curve leave out the body's edges
    int inside = 0;
    for (int k = 0; k < samples; ++k) {
      const double share = (k + 0.5) / samples;
      const Eigen::RowVector3d point =
          (1 - share) * given_.joints.row(bone.upper) + share * given_.joints.row(bone.lower);
      const auto distances = (skeleton_.nodes.rowwise() - point).rowwise().norm().array();
      inside += (distances < slack * radii_.array()).any() ? 1 : 0;
    }
    return 2 * inside >= samples;
  }

  const CurveSkeleton& skeleton_;
  const Rig& given_;
  Eigen::VectorXd radii_;
  std::vector<Bone> all_;
};

}  // namespace

Eigen::VectorXi joints_of_nodes(const CurveSkeleton& skeleton, const Rig& given) {
  const Bones bones(skeleton, given);
  const Eigen::VectorXd radii = usable_radii(skeleton);
  const auto count = given.parents.size();
  Eigen::VectorXd reach = Eigen::VectorXd::Zero(count);  // of the curve beyond a joint, in radii
  Eigen::VectorXi joints(skeleton.nodes.rows());
  for (Eigen::Index node = 0; node < joints.size(); ++node) {
    const int joint = joints[node] = bones.joint_at(skeleton.nodes.row(node));
    const double distance = (skeleton.nodes.row(node) - given.joints.row(joint)).norm();
    reach[joint] = std::max(reach[joint], distance / radii[node]);
  }
  std::vector<bool> is_end(idx(count), true);
  for (int joint = 0; joint < static_cast<int>(count); ++joint) {
    const int parent = given.parents[joint];
    if (parent >= 0) is_end[idx(parent)] = false;
    if (parent < 0 || reach[joint] >= 1) is_end[idx(joint)] = false;
  }
  for (int& joint : joints) {
    if (is_end[idx(joint)]) joint = given.parents[joint];
  }
  return joints;
}

}  // namespace curveskel
