#include "rig/sides.hpp"

#include <string>
#include <utility>
#include <vector>

#include "surface/element_index.hpp"
#include "surface/measures.hpp"

namespace curveskel {
namespace {

/// By joint: its mirror image, itself for one in the plane, -1 for neither.
struct MirrorImages {
  std::vector<int> of;
  int pairs = 0;
  int matched = 0;
};

Eigen::Index nearest_joint(const Joints& joints, const Eigen::RowVector3d& point) {
  Eigen::Index nearest = 0;
  (joints.positions.rowwise() - point).rowwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

MirrorImages mirror_images(const Joints& joints, int axis, double tolerance) {
  const auto mirrored = [&joints, axis](Eigen::Index joint) {
    Eigen::RowVector3d point = joints.positions.row(joint);
    point[axis] = 2 * joints.positions(0, axis) - point[axis];
    return point;
  };
  MirrorImages images;
  images.of.assign(at(joints.parents.size()), -1);
  for (Eigen::Index joint = 0; joint < joints.parents.size(); ++joint) {
    const Eigen::Index other = nearest_joint(joints, mirrored(joint));
    const bool mutual = nearest_joint(joints, mirrored(other)) == joint;
    const bool near = (mirrored(joint) - joints.positions.row(other)).norm() <= tolerance;
    const int parent = joints.parents[joint];
    const bool same_parents =
        parent < 0 ? other == joint : images.of[at(parent)] == joints.parents[other];
    if (!mutual || !near || !same_parents) continue;
    images.of[at(joint)] = static_cast<int>(other);
    ++images.matched;
    if (other > joint) ++images.pairs;
  }
  return images;
}

}  // namespace

void name_sides(Joints& joints) {
  constexpr Eigen::Index most = 4000;
  constexpr double near = 0.02;        // of the diagonal
  constexpr double least_share = 0.6;  // of the joints
  if (joints.parents.size() > most) return;
  const double tolerance = near * bounding_box_diagonal(joints.positions);
  MirrorImages best;
  int axis = 0;
  for (int candidate = 0; candidate < 3; ++candidate) {
    MirrorImages images = mirror_images(joints, candidate, tolerance);
    const bool enough = images.matched >= least_share * static_cast<double>(images.of.size());
    if (!enough || images.pairs <= best.pairs) continue;
    best = std::move(images);
    axis = candidate;
  }
  for (std::size_t joint = 0; joint < best.of.size(); ++joint) {
    const int other = best.of[joint];
    if (other <= static_cast<int>(joint)) continue;
    const bool first_is_left =
        joints.positions(static_cast<Eigen::Index>(joint), axis) > joints.positions(other, axis);
    const std::string name = joints.names[joint];
    joints.names[joint] = name + (first_is_left ? ".L" : ".R");
    joints.names[at(other)] = name + (first_is_left ? ".R" : ".L");
  }
}

}  // namespace curveskel
