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

Eigen::Index nearest_joint(const Rig& rig, const Eigen::RowVector3d& point) {
  Eigen::Index nearest = 0;
  (rig.joints.rowwise() - point).rowwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

MirrorImages mirror_images(const Rig& rig, int axis, double tolerance) {
  const auto mirrored = [&rig, axis](Eigen::Index joint) {
    Eigen::RowVector3d point = rig.joints.row(joint);
    point[axis] = 2 * rig.joints(0, axis) - point[axis];
    return point;
  };
  MirrorImages images;
  images.of.assign(at(rig.parents.size()), -1);
  for (Eigen::Index joint = 0; joint < rig.parents.size(); ++joint) {
    const Eigen::Index other = nearest_joint(rig, mirrored(joint));
    const bool mutual = nearest_joint(rig, mirrored(other)) == joint;
    const bool near = (mirrored(joint) - rig.joints.row(other)).norm() <= tolerance;
    const int parent = rig.parents[joint];
    const bool same_parents =
        parent < 0 ? other == joint : images.of[at(parent)] == rig.parents[other];
    if (!mutual || !near || !same_parents) continue;
    images.of[at(joint)] = static_cast<int>(other);
    ++images.matched;
    if (other > joint) ++images.pairs;
  }
  return images;
}

}  // namespace

void name_sides(Rig& rig) {
  constexpr Eigen::Index most = 4000;
  constexpr double near = 0.03;        // of the diagonal
  constexpr double least_share = 0.4;  // of the joints
  if (rig.parents.size() > most) return;
  const double tolerance = near * bounding_box_diagonal(rig.joints);
  MirrorImages best;
  int axis = 0;
  for (int candidate = 0; candidate < 3; ++candidate) {
    MirrorImages images = mirror_images(rig, candidate, tolerance);
    const bool enough = images.matched >= least_share * static_cast<double>(images.of.size());
    if (!enough || images.pairs <= best.pairs) continue;
    best = std::move(images);
    axis = candidate;
  }
  for (std::size_t joint = 0; joint < best.of.size(); ++joint) {
    const int other = best.of[joint];
    if (other <= static_cast<int>(joint)) continue;
    const bool first_is_left =
        rig.joints(static_cast<Eigen::Index>(joint), axis) > rig.joints(other, axis);
    const std::string name = rig.names[joint];
    rig.names[joint] = name + (first_is_left ? ".L" : ".R");
    rig.names[at(other)] = name + (first_is_left ? ".R" : ".L");
  }
}

}  // namespace curveskel
