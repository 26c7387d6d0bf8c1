// Joints that are turned to see how a surface takes it.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>

#include <curveskel/rig.hpp>

namespace curveskel {

/// n x j, by columns: the share of each vertex that turns when the joint does, with all joints
/// below it. O(weights depth).
[[nodiscard]] Eigen::SparseMatrix<double> turning_shares(const Rig& rig);

/// By 45 degrees, either way, about two axes that are normal to the bone; any two for a bone
/// without length.
[[nodiscard]] std::array<Eigen::Matrix3d, 4> turns_across(const Eigen::Vector3d& bone);

}  // namespace curveskel
