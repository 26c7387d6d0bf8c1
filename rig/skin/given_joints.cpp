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
  int lower;  ///< the same as `upper` for a joint that has neither parent nor children
};

class Bones {
 public:
  Bones(const CurveSkeleton& skeleton, const Rig& given)
      : skeleton_(skeleton), given_(given), radii_(usable_radii(skeleton)) {
    std::vector<bool> has_bone(idx(given.parents.size()), false);
    for (int joint = 0; joint < static_cast<int>(given.parents.size()); ++joint) {
      const int parent = given.parents[joint];
      if (parent < 0) continue;
      all_.push_back({parent, joint});
      has_bone[idx(parent)] = has_bone[idx(joint)] = true;
    }
    for (std::size_t joint = 0; joint < has_bone.size(); ++joint) {
      if (!has_bone[joint]) all_.push_back({static_cast<int>(joint), static_cast<int>(joint)});
    }
    std::vector<Bone> inside;
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(inside),
                 [this](const Bone& bone) { return is_inside(bone); });
    if (!inside.empty()) all_ = std::move(inside);
  }

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
  Eigen::VectorXi joints(skeleton.nodes.rows());
  for (Eigen::Index node = 0; node < joints.size(); ++node) {
    joints[node] = bones.joint_at(skeleton.nodes.row(node));
  }
  return joints;
}

}  // namespace curveskel
