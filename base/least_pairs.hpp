// Pairs of least sum.
#pragma once

#include <Eigen/Core>
#include <stop_token>
#include <vector>

namespace curveskel {

/// For each row of `costs` (finite) the column that it is paired with, each column once, such that
/// the sum of costs is least; -1 for rows that are left over, where there are more rows than
/// columns. Throws Stopped. O(n^2 m) with n the smaller number (Hungarian method, with shortest
/// augmenting paths).
[[nodiscard]] std::vector<int> least_pairs(const Eigen::MatrixXd& costs,
                                           const std::stop_token& stop = {});

}  // namespace curveskel
