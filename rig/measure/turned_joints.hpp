// Joints that are turned to see how a surface takes it.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include <curveskel/rig.hpp>

namespace curveskel {

/// The shares of vertices that turn when a joint does, with all joints below it, of one joint after
/// another: of all at once they take the memory of weights times depth. This takes that of weights.
class TurningShares {
 public:
  /// Precondition: a parent for each joint, which comes before it.
  explicit TurningShares(const Rig& rig);

  struct Turned {
    int vertex = 0;
    double share = 0;
  };
  /// Vertices ascending, until the next call. O(n log n) for the n weights of these joints.
  [[nodiscard]] const std::vector<Turned>& of(int joint);

 private:
  Eigen::SparseMatrix<float> weights_;  // by columns
  std::vector<std::vector<int>> children_;
  std::vector<double> sums_;  // by vertex; zero between calls
  std::vector<int> joints_;
  std::vector<Turned> turned_;
};

/// The same of all joints, n x j, by columns.
[[nodiscard]] Eigen::SparseMatrix<double> turning_shares(const Rig& rig);

/// By 45 degrees, either way, about two axes that are normal to the bone; any two for a bone
/// without length.
[[nodiscard]] std::array<Eigen::Matrix3d, 4> turns_across(const Eigen::Vector3d& bone);

}  // namespace curveskel
