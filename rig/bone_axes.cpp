#include "rig/bone_axes.hpp"

#include "surface/element_index.hpp"

namespace curveskel {
namespace {

/// By joint: the child that the bone leads to, or -1.
std::vector<int> main_children(const Rig& rig) {
  const auto count = at(rig.parents.size());
  std::vector<int> below(count, 1);
  for (std::size_t joint = count; joint-- > 0;) {
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    if (parent >= 0) below[at(parent)] += below[joint];
  }
  std::vector<int> main(count, -1);
  for (std::size_t joint = 0; joint < count; ++joint) {
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    if (parent < 0) continue;
    int& best = main[at(parent)];
    if (best < 0 || below[joint] > below[at(best)]) best = static_cast<int>(joint);
  }
  return main;
}

}  // namespace

std::vector<Eigen::Quaterniond> bone_axes(const Rig& rig) {
  const std::vector<int> main = main_children(rig);
  std::vector<Eigen::Quaterniond> axes;
  axes.reserve(main.size());
  for (std::size_t joint = 0; joint < main.size(); ++joint) {
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    Eigen::Quaterniond turned =
        parent < 0 ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond(axes[at(parent)]);
    const Eigen::Vector3d before = turned * Eigen::Vector3d::UnitY();
    Eigen::Vector3d bone = before;
    if (main[joint] >= 0) {
      bone = (rig.joints.row(main[joint]) - rig.joints.row(static_cast<Eigen::Index>(joint)))
                 .transpose();
    }
    if (bone.norm() > 0) {
      turned = Eigen::Quaterniond::FromTwoVectors(before, bone) * turned;
      turned.normalize();
    }
    axes.push_back(turned);
  }
  return axes;
}

}  // namespace curveskel
