#include "rig/measure/turned_joints.hpp"

#include <Eigen/Geometry>
#include <numbers>
#include <vector>

namespace curveskel {

Eigen::SparseMatrix<double> turning_shares(const Rig& rig) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      if (!(it.value() > 0)) continue;
      for (auto joint = static_cast<int>(it.col()); joint >= 0; joint = rig.parents[joint]) {
        entries.emplace_back(static_cast<int>(vertex), joint, it.value());
      }
    }
  }
  Eigen::SparseMatrix<double> shares(rig.weights.rows(), rig.weights.cols());
  shares.setFromTriplets(entries.begin(), entries.end());  // adds up
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
