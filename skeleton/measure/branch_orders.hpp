// How far from the root of its tree each branch is, and how much hangs from it.
#pragma once

#include <vector>

#include <curveskel/curve_skeleton.hpp>

namespace curveskel {

struct BranchOrders {
  std::vector<int> centrifugal;
  std::vector<int> strahler;
};
/// As defined at BranchMeasures. `all` are `branches(skeleton)`. O(#N + #E).
[[nodiscard]] BranchOrders branch_orders(const CurveSkeleton& skeleton,
                                         const std::vector<Branch>& all, int root);

}  // namespace curveskel
