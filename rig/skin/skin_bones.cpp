#include "rig/skin/skin_bones.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/tree.hpp>
#include "rig/joints/end_names.hpp"
#include "surface/spatial/segment.hpp"

namespace curveskel {
namespace {

class GivenBones {
 public:
  GivenBones(const Surface& surface, const Rig& given, int threads)
      : given_(given), tree_(surface, threads), is_leaf_(idx(given.parents.size()), true) {
    for (const int parent : given.parents) {
      if (parent >= 0) is_leaf_[idx(parent)] = false;
    }
  }

  [[nodiscard]] std::vector<Bone> that_hold() const {
    std::vector<Bone> bones;
    std::vector<bool> holds(is_leaf_.size(), false);  // the bone that leads to a joint
    for (int joint = 0; joint < static_cast<int>(is_leaf_.size()); ++joint) {
      const int parent = given_.parents[joint];
      if (parent >= 0) {
        const Bone bone{parent, place(parent), place(joint)};
        holds[idx(joint)] = holds[idx(parent)] || is_inside(bone);
        if (holds[idx(joint)]) bones.push_back(bone);
      }
      const bool is_end =
          parent >= 0 && idx(joint) < given_.names.size() && is_end_name(given_.names[idx(joint)]);
      if (is_leaf_[idx(joint)] && !is_end && tree_.inside(place(joint).transpose())) {
        bones.push_back(straight_on(joint));
      }
    }
    return bones;
  }

  /// At least one.
  [[nodiscard]] std::vector<Bone> everywhere() const {
    std::vector<Bone> bones;
    bones.reserve(is_leaf_.size());
    for (int joint = 0; joint < static_cast<int>(is_leaf_.size()); ++joint) {
      const int parent = std::max(given_.parents[joint], 0);
      bones.push_back({parent, place(parent), place(joint)});
    }
    return bones;
  }

 private:
  [[nodiscard]] Eigen::RowVector3d place(int joint) const { return given_.joints.row(joint); }

  [[nodiscard]] bool is_inside(const Bone& bone) const {
    constexpr int samples = 16;
    int inside = 0;
    for (int k = 0; k < samples; ++k) {
      const double share = (k + 0.5) / samples;
      inside += tree_.inside(((1 - share) * bone.from + share * bone.to).transpose()) ? 1 : 0;
    }
    return 2 * inside >= samples;
  }

  [[nodiscard]] Bone straight_on(int joint) const {
    const int parent = given_.parents[joint];
    const Eigen::RowVector3d at = place(joint);
    if (parent < 0) return {joint, at, at};
    const Eigen::RowVector3d way = at - place(parent);
    if (!(way.norm() > 0)) return {joint, at, at};
    const Eigen::RowVector3d ahead = way.normalized();
    const SurfaceTree::Hit exit = tree_.ray(at.transpose(), ahead.transpose());
    if (exit.triangle < 0) return {joint, at, at};
    return {joint, at, at + exit.distance * ahead};
  }

  const Rig& given_;
  SurfaceTree tree_;
  std::vector<bool> is_leaf_;
};

/// A joint without a part is of those of its parent, and where none above has any, as a root beside
/// the curve, of those of its children.
void spread(const Eigen::VectorXi& parents, std::vector<std::set<int>>& parts) {
  for (Eigen::Index joint = 0; joint < parents.size(); ++joint) {
    const int parent = parents[joint];
    if (parent >= 0 && parts[idx(joint)].empty()) parts[idx(joint)] = parts[idx(parent)];
  }
  std::vector<char> takes(parts.size());
  for (std::size_t joint = 0; joint < parts.size(); ++joint) takes[joint] = parts[joint].empty();
  for (Eigen::Index joint = parents.size(); joint-- > 0;) {
    const int parent = parents[joint];
    if (parent >= 0 && takes[idx(parent)] != 0)
      parts[idx(parent)].merge(std::set(parts[idx(joint)]));
  }
}

}  // namespace

Eigen::RowVector3d nearest_on(const Bone& bone, const Eigen::RowVector3d& point) {
  return nearest_on_segment(point.transpose(), bone.from.transpose(), bone.to.transpose())
      .transpose();
}

std::vector<Bone> bones_of_own(const CurveSkeleton& skeleton, const Joints& joints) {
  std::vector<std::set<int>> parts_of_joint(idx(joints.parents.size()));
  const std::vector<int> parts = connected_components(skeleton.nodes.rows(), skeleton.edges);
  for (std::size_t node = 0; node < parts.size(); ++node) {
    parts_of_joint[idx(joints.joint_of_node[static_cast<Eigen::Index>(node)])].insert(parts[node]);
  }
  spread(joints.parents, parts_of_joint);
  std::vector<Bone> bones;
  bones.reserve(parts_of_joint.size());
  for (int joint = 0; joint < joints.parents.size(); ++joint) {
    const int parent = joints.parents[joint];
    if (parent < 0) continue;
    for (const int part : parts_of_joint[idx(parent)]) {
      bones.push_back({parent, joints.positions.row(parent), joints.positions.row(joint), part});
    }
  }
  return bones;
}

std::vector<Bone> bones_for_all(const Positions& joints, const Eigen::VectorXi& parents) {
  std::vector<Bone> bones;
  bones.reserve(idx(parents.size()));
  for (int joint = 0; joint < parents.size(); ++joint) {
    const int parent = parents[joint];
    if (parent >= 0) bones.push_back({parent, joints.row(parent), joints.row(joint)});
  }
  return bones;
}

std::vector<Bone> bones_of_given(const Surface& surface, const Rig& given, int threads) {
  const GivenBones all(surface, given, threads);
  std::vector<Bone> bones = all.that_hold();
  if (bones.empty()) bones = all.everywhere();
  return bones;
}

Eigen::VectorXi joints_of_nodes(const CurveSkeleton& skeleton, const std::vector<Bone>& bones) {
  Eigen::VectorXi joints(skeleton.nodes.rows());
  for (Eigen::Index node = 0; node < joints.size(); ++node) {
    const Eigen::RowVector3d place = skeleton.nodes.row(node);
    double least = std::numeric_limits<double>::infinity();
    for (const Bone& bone : bones) {
      const double distance = (place - nearest_on(bone, place)).squaredNorm();
      if (distance > least) continue;
      least = distance;
      joints[node] = bone.joint;
    }
  }
  return joints;
}

}  // namespace curveskel
