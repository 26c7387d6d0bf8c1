#include "rig/measure/turned_joints.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

TurningShares::TurningShares(const Rig& rig)
    : weights_(rig.weights), children_(idx(rig.parents.size())), sums_(idx(rig.weights.rows()), 0) {
  for (int joint = 0; joint < static_cast<int>(rig.parents.size()); ++joint) {
    if (rig.parents[joint] >= 0) children_[idx(rig.parents[joint])].push_back(joint);
  }
}

const std::vector<TurningShares::Turned>& TurningShares::of(int joint) {
  joints_.assign(1, joint);
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const std::vector<int>& below = children_[idx(joints_[k])];
    joints_.insert(joints_.end(), below.begin(), below.end());
  }
  std::sort(joints_.begin(), joints_.end());  // one order of the sums, however joints hang
  turned_.clear();
  for (const int one : joints_) {
    for (Eigen::SparseMatrix<float>::InnerIterator it(weights_, one); it; ++it) {
      if (!(it.value() > 0)) continue;
      double& sum = sums_[idx(it.row())];
      if (sum == 0) turned_.push_back({static_cast<int>(it.row())});
      sum += static_cast<double>(it.value());
    }
  }
  std::sort(turned_.begin(), turned_.end(),
            [](const Turned& a, const Turned& b) { return a.vertex < b.vertex; });
  for (Turned& one : turned_) one.share = std::exchange(sums_[idx(one.vertex)], 0);
  return turned_;
}

Eigen::SparseMatrix<double> turning_shares(const Rig& rig) {
  TurningShares turning(rig);
  Eigen::SparseMatrix<double> shares(rig.weights.rows(), rig.weights.cols());
  for (int joint = 0; joint < static_cast<int>(rig.weights.cols()); ++joint) {
    shares.startVec(joint);
    for (const auto& [vertex, share] : turning.of(joint)) shares.insertBack(vertex, joint) = share;
  }
  shares.finalize();
  return shares;
}

std::array<Eigen::Matrix3d, 4> turns_across(const Eigen::Vector3d& bone) {
  const Eigen::Vector3d along =
      bone.norm() > 0 ? Eigen::Vector3d(bone.normalized()) : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d one = along.unitOrthogonal();
  const Eigen::Vector3d two = along.cross(one);
  const auto turn = [](const Eigen::Vector3d& axis, double sign) {
    return Eigen::AngleAxisd(sign * std::numbers::pi / 4, axis).toRotationMatrix();
  };
  return {turn(one, 1), turn(one, -1), turn(two, 1), turn(two, -1)};
}

}  // namespace curveskel
