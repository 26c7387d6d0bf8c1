// Numbers that say how near a rig is to the rig that somebody has made of the same surface.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include <curveskel/monitor.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct RiggedSurface {
  Surface surface;  ///< at rest, as polygons in triangles; it need not be closed
  Rig rig;          ///< weights have a row for each of its vertices, or none if nothing is known
};

/// Pairs of joints, one of each rig, the sum of whose distances is least; those are hits that are
/// nearer than a tolerance.
struct JointHits {
  int hits = 0;
  double overlap = 0;    ///< 2 hits over all joints of both, called IoU by those who measure it
  double precision = 0;  ///< hits over the rig's joints
  double recall = 0;     ///< hits over the truth's joints
};

/// Poses in which one joint of the truth is turned, and the joint of the rig that moves most of
/// what this one moves.
struct PoseDistance {
  int poses = 0;
  double mean_distance = 0;  ///< of the vertices that either moves / L, the mean over the poses
  double shared = 0;         ///< of what either joint moves, what both do; the mean over the poses
};

/// A joint is in a row if its weight is more than 1e-4.
struct WeightDifference {
  double precision = 0;  ///< of the joints in the rig's rows, those in the truth's
  double recall = 0;     ///< of the joints in the truth's rows, those in the rig's
  double l1 = 0;         ///< sum of absolute differences of a row, 0..2, the mean over vertices
};

/// Lengths are over L, the longest side of the truth's bounding box. docs/numbers.md has the
/// definitions.
struct RigComparison {
  int joints = 0;        ///< that are compared
  int truth_joints = 0;  ///< the same of the truth
  double joints_to_joints = 0;
  double joints_to_bones = 0;
  double bones_to_bones = 0;
  double root_distance = 0;  ///< from the truth's topmost joint to the rig's
  JointHits by_thickness;    ///< nearer than the surface is thick there
  JointHits by_size;         ///< nearer than 0.05 L
  std::string not_posed;     ///< why `poses` are missing; else empty
  std::optional<PoseDistance> poses;
  std::string not_weighed;  ///< why `weights` are missing; else empty
  std::optional<WeightDifference> weights;
};

/// Places need the truth's surface and no weights. Poses are compared where the surfaces have the
/// same vertices, to 1e-4 L and in one order; weights where, moreover, the joints that move
/// something are in the same places, to 1e-3 L. Precondition: both rigs have joints. Throws
/// Error(Fault::input) where the truth has no extent, Cancelled on a stop. O(#F log #F + #V d^2 +
/// J^3), d the depth of the hierarchies, J joints.
[[nodiscard]] RigComparison compare_rigs(const RiggedSurface& rig, const RiggedSurface& truth,
                                         const Monitor& monitor = {});

}  // namespace curveskel
