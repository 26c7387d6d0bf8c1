// A curve skeleton as a hierarchy: every node but the roots hangs from another.
#pragma once

#include <vector>

#include "skeleton/curve_skeleton.hpp"

namespace curveskel {

struct RootedTree {
  std::vector<int> parent;                 ///< by node; -1 = a root
  std::vector<std::vector<int>> children;  ///< by node, ascending
  std::vector<int> roots;  ///< one for each component: that of `wanted`, then the heaviest
};

/// The shortest ways from a root of each component, `wanted` (-1 = none) in its own. How roots are
/// chosen and cycles cut: see `place_joints`.
[[nodiscard]] RootedTree rooted_tree(const CurveSkeleton& skeleton, int wanted);

}  // namespace curveskel
