// The first face that a ray hits, where one ray at a time is asked for.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include <curveskel/surface.hpp>

namespace curveskel::viewer {

/// Boxes round runs of faces in the order of the file, which keeps neighbours together in most
/// files. Against a tree: a hundredth of the memory and none of the time to grow one. A ray costs
/// a test per box and one per face of the boxes that it meets; at worst one per face.
class FaceBlocks {
 public:
  FaceBlocks() = default;
  explicit FaceBlocks(const Surface& surface);

  struct Hit {
    int face = -1;        ///< -1 = none
    double distance = 0;  ///< along the direction, in its lengths
  };
  /// The nearest face ahead of `origin`, seen from either side; of those that are as near, the
  /// first. `surface` is the one that it was made of.
  [[nodiscard]] Hit first(const Surface& surface, const Eigen::Vector3d& origin,
                          const Eigen::Vector3d& direction) const;

 private:
  std::vector<Eigen::AlignedBox3f> boxes_;
};

}  // namespace curveskel::viewer
