// Limbs of a rig that are each other's mirror images.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/rig.hpp>

namespace curveskel {

/// A chain of joints, each but the first the only child of the one before.
struct Chain {
  std::vector<int> joints;
  int above = -1;         ///< the chain whose last joint it hangs from; -1 = none
  Eigen::MatrixX3d path;  ///< places at even shares of its length
  double length = 0;      ///< with the bone from the joint above
};

/// Each after the one that it hangs from.
[[nodiscard]] std::vector<Chain> chains_of(const Rig& rig);

/// By chain: its mirror image, itself for one in the plane, -1 for neither.
struct MirrorImages {
  std::vector<int> of;
  double paired = 0;    ///< length of those with another as their image, each by how exact it is
  double in_plane = 0;  ///< the same of those that are their own

  /// Pairs tell more: a flat figure is its own image in its plane.
  [[nodiscard]] double worth() const { return paired + 0.5 * in_plane; }
};

/// Through the plane normal to `axis` for which most chains are images of others, whatever they
/// hang from; to within `tolerance` (> 0) in the mean. Precondition: there is a chain.
/// O(chains^2 depth).
[[nodiscard]] MirrorImages mirror_images(const std::vector<Chain>& chains, int axis,
                                         double tolerance);

}  // namespace curveskel
