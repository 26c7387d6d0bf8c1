// Joints as a scene shows them, and as they stood when meshes were bound to them. Internal to
// surface/ and rig/.
#pragma once

#include <Eigen/Geometry>
#include <unordered_map>
#include <utility>
#include <vector>

namespace curveskel {

/// Whatever the format has as a node of its scene.
using SceneNode = const void*;

/// Frames in the world.
struct BoundJoint {
  Eigen::Affine3d shown;
  Eigen::Affine3d bound;
  int nodes_above = 0;
  bool moves_vertices = false;

  /// From where things were bound to where they are shown.
  [[nodiscard]] Eigen::Affine3d move() const { return shown * bound.inverse(); }
};

/// A joint as it was bound, and the move of its figure: that of the topmost joint, the first with
/// the fewest nodes above it, which so stands where the scene shows it.
struct MovedJoint {
  Eigen::Affine3d bound;
  Eigen::Affine3d move;
};

/// The joints to which a scene's meshes are bound. Those that are bound to one mesh, or hang from
/// each other, are of one figure: a boot goes with the body, and two bodies stay apart.
class BoundJoints {
 public:
  /// Once for each mesh; of frames that differ the first counts.
  void add(SceneNode node, const BoundJoint& joint);

  [[nodiscard]] bool contains(SceneNode node) const { return number_of_.contains(node); }

  /// Joints that have a `kin`, anything, in common are of one figure. Precondition: `node` is
  /// there.
  void join(SceneNode node, SceneNode kin);

  /// The joints of figures that are bent: of which the joints that move vertices do not all move
  /// alike, to 1e-4 of their size, which is more than what exporters round away. None in a file
  /// that contradicts itself in where a joint was.
  [[nodiscard]] std::unordered_map<SceneNode, MovedJoint> bent_figures() const;

  /// The diagonal of the places in which they were bound.
  [[nodiscard]] double size() const { return box_.diagonal().norm(); }

 private:
  std::vector<BoundJoint> joints_;
  std::vector<std::vector<Eigen::Affine3d>> told_;  // where each was bound
  std::unordered_map<SceneNode, int> number_of_;
  std::vector<std::pair<int, int>> pairs_;         // of one figure
  std::unordered_map<SceneNode, int> first_with_;  // that kin
  Eigen::AlignedBox3d box_;
};

/// True if all are one, to 1e-3 of their linear part, and in their places to 1e-3 of `size`. Of
/// frames that a file gives several times for one thing.
[[nodiscard]] bool are_alike(const std::vector<Eigen::Affine3d>& frames, double size);

[[nodiscard]] bool is_invertible(const Eigen::Affine3d& frame);

}  // namespace curveskel
