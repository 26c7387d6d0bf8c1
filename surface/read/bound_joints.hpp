// Joints as a scene shows them, and as they stood when meshes were bound to them. Internal to
// surface/ and rig/.
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace curveskel {

/// Frames in the world.
struct BoundJoint {
  Eigen::Affine3d shown;
  Eigen::Affine3d bound;

  /// From where things were bound to where they are shown.
  [[nodiscard]] Eigen::Affine3d move() const { return shown * bound.inverse(); }
};

/// True if the joints do not all move alike, to 1e-4 of the size of all, which is more than what
/// exporters round away: then they bend what they move.
[[nodiscard]] bool are_posed(const std::vector<BoundJoint>& joints);

/// True if all are one, to 1e-3 of their linear part, and in their places to 1e-3 of `size`. Of
/// frames that a file gives several times for one thing.
[[nodiscard]] bool are_alike(const std::vector<Eigen::Affine3d>& frames, double size);

}  // namespace curveskel
