// A curve skeleton as a hierarchy: every node but the roots hangs from another.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include <curveskel/curve_skeleton.hpp>

namespace curveskel {

struct RootedTree {
  std::vector<int> parent;                 ///< by node; -1 = a root
  std::vector<std::vector<int>> children;  ///< by node, ascending
  std::vector<int> roots;  ///< one for each component: that of `wanted` (else the heaviest), then
                           ///< each after the one that it hangs from
  std::vector<int> above;  ///< by root: the node that it hangs from; -1 for the first, and
                           ///< for those that stand apart
};

/// Lengths are measured in these: nodes outside have none, a bone needs some.
[[nodiscard]] Eigen::VectorXd usable_radii(const CurveSkeleton& skeleton);

/// The shortest ways from a root of each component, `wanted` (-1 = none) in its own. The choice of
/// roots and the cutting of cycles: see `place_joints`; the links of components, the ground and up:
/// `hang_components`.
[[nodiscard]] RootedTree rooted_tree(const CurveSkeleton& skeleton, int wanted,
                                     const std::vector<int>& ground = {},
                                     const Eigen::Vector3d& up = Eigen::Vector3d::UnitY());

/// The same in several directions up, for which the links are found once. Refers to the skeleton.
class RootedTrees {
 public:
  RootedTrees(const CurveSkeleton& skeleton, int wanted, const std::vector<int>& ground);
  RootedTrees(const RootedTrees&) = delete;
  RootedTrees& operator=(const RootedTrees&) = delete;
  RootedTrees(RootedTrees&&) = delete;
  RootedTrees& operator=(RootedTrees&&) = delete;
  ~RootedTrees();

  [[nodiscard]] RootedTree with_up(const Eigen::Vector3d& up) const;

 private:
  class Rooting;
  std::unique_ptr<Rooting> rooting_;
};

}  // namespace curveskel
