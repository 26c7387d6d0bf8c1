#include "rig/measure/limb_poses.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <algorithm>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/measure/turned_joints.hpp"

namespace curveskel {
namespace {

using MovedShares = Eigen::SparseMatrix<double>;

/// t x j: the sum over the vertices of the smaller share.
Eigen::MatrixXd common_shares(const MovedShares& truth, const MovedShares& rig) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> theirs = truth;
  const Eigen::SparseMatrix<double, Eigen::RowMajor> ours = rig;
  using Row = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;
  Eigen::MatrixXd common = Eigen::MatrixXd::Zero(theirs.cols(), ours.cols());
  for (Eigen::Index vertex = 0; vertex < theirs.rows(); ++vertex) {
    for (Row their(theirs, vertex); their; ++their) {
      for (Row our(ours, vertex); our; ++our) {
        common(their.col(), our.col()) += std::min(their.value(), our.value());
      }
    }
  }
  return common;
}

/// From the joint to the middle of its children, or of what it moves.
Eigen::Vector3d bone_of(const RiggedSurface& truth, const MovedShares& shares, int joint) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  double count = 0;
  for (int child = joint + 1; child < static_cast<int>(truth.rig.parents.size()); ++child) {
    if (truth.rig.parents[child] != joint) continue;
    sum += truth.rig.joints.row(child);
    count += 1;
  }
  const Eigen::RowVector3d place = truth.rig.joints.row(joint);
  if (count > 0 && (sum / count - place).norm() > 0) return (sum / count - place).transpose();
  sum.setZero();
  count = 0;
  for (MovedShares::InnerIterator it(shares, joint); it; ++it) {
    sum += it.value() * truth.surface.positions.row(it.row());
    count += it.value();
  }
  return (sum / count - place).transpose();
}

class PosedLimbs {
 public:
  PosedLimbs(const Rig& rig, const RiggedSurface& truth)
      : rig_(rig),
        truth_(truth),
        ours_(turning_shares(rig)),
        theirs_(turning_shares(truth.rig)),
        common_(common_shares(theirs_, ours_)),
        our_sums_(ours_.transpose() * Eigen::VectorXd::Ones(ours_.rows())),
        their_sums_(theirs_.transpose() * Eigen::VectorXd::Ones(theirs_.rows())) {}

  /// A joint whose turn is a pose of a limb: neither of some single vertices nor of the body, nor
  /// of a little of each vertex, of which `distance` would count none.
  [[nodiscard]] bool is_limb(int joint) const {
    constexpr double least = 0.005;
    constexpr double most = 0.5;
    const double share = their_sums_[joint] / static_cast<double>(theirs_.rows());
    return share > least && share < most && turns_some(joint);
  }

  struct Partner {
    int joint = -1;
    double shared = -1;
  };
  [[nodiscard]] Partner partner(int joint) const {
    Partner best;
    for (int other = 0; other < static_cast<int>(ours_.cols()); ++other) {
      const double both = common_(joint, other);
      const double all = their_sums_[joint] + our_sums_[other] - both;
      const double shared = all > 0 ? both / all : 0;
      if (shared > best.shared) best = {other, shared};
    }
    return best;
  }

  /// Of the vertices that either turns, the mean over the turns, in the model's units.
  [[nodiscard]] double distance(int joint, int partner) const {
    const Eigen::VectorXd theirs = theirs_.col(joint);
    const Eigen::VectorXd ours = ours_.col(partner);
    double sum = 0;
    double moved = 0;
    for (const Eigen::Matrix3d& turn : turns_across(bone_of(truth_, theirs_, joint))) {
      const Eigen::Matrix3d shift = turn - Eigen::Matrix3d::Identity();
      for (Eigen::Index vertex = 0; vertex < theirs.size(); ++vertex) {
        if (!(std::max(theirs[vertex], ours[vertex]) > least_share)) continue;
        const Eigen::RowVector3d point = truth_.surface.positions.row(vertex);
        const Eigen::RowVector3d by_theirs = point - truth_.rig.joints.row(joint);
        const Eigen::RowVector3d by_ours = point - rig_.joints.row(partner);
        sum += (shift * (theirs[vertex] * by_theirs - ours[vertex] * by_ours).transpose()).norm();
        moved += 1;
      }
    }
    return sum / moved;
  }

 private:
  static constexpr double least_share = 0.01;

  [[nodiscard]] bool turns_some(int joint) const {
    for (MovedShares::InnerIterator it(theirs_, joint); it; ++it) {
      if (it.value() > least_share) return true;
    }
    return false;
  }

  const Rig& rig_;
  const RiggedSurface& truth_;
  MovedShares ours_;
  MovedShares theirs_;
  Eigen::MatrixXd common_;  // theirs by ours
  Eigen::VectorXd our_sums_;
  Eigen::VectorXd their_sums_;
};

}  // namespace

PoseDistance compare_poses(const Rig& rig, const RiggedSurface& truth, double size,
                           const Monitor& monitor) {
  const PosedLimbs limbs(rig, truth);
  PoseDistance result;
  const auto joints = static_cast<int>(truth.rig.parents.size());
  for (int joint = 0; joint < joints; ++joint) {
    monitor.report("compare", 0.5 + 0.5 * joint / joints);
    if (!limbs.is_limb(joint)) continue;
    const auto [partner, shared] = limbs.partner(joint);
    result.mean_distance += limbs.distance(joint, partner) / size;
    result.shared += shared;
    ++result.poses;
  }
  if (result.poses == 0) return result;
  result.mean_distance /= result.poses;
  result.shared /= result.poses;
  return result;
}

}  // namespace curveskel
