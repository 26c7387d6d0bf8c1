// The weights by which joints move vertices.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct SkinOptions {
  /// Width of the passage from one joint to the next, in units of the distance from the skin to
  /// the bone; 0.001..1000.
  double softness = 0.5;
  int most_joints = 4;         ///< that move one vertex; 1..8
  double least_weight = 0.01;  ///< smaller shares in a vertex are left out; 0..0.1
  int threads = 0;             ///< 0 = one per core; the result does not depend on it
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const SkinOptions& options);

/// A straight piece that a joint turns.
struct Bone {
  int joint;
  Eigen::RowVector3d from;
  Eigen::RowVector3d to;
  int part = -1;  ///< a component of the skeleton, in the order of their lowest nodes: only
                  ///< vertices with nodes there are held; -1 = all
};

/// n x `joints`, rows of sum 1 (up to rounding in single precision).
///
/// Heat on the surface (after Baran and Popovic 2007, eq. 3): (-L + A H) w_j = A H p_j, with L the
/// intrinsic Delaunay Laplacian, A the vertices' areas, H = 1 / (softness d)^2, and p_j the share
/// of joint j in what holds the vertex. As L has no negative weights, 0 <= w_j <= 1 and the w_j of
/// a vertex sum to 1.
///
/// A vertex is held by the bone nearest to it, if no face of the surface lies between, with
/// 2 d / (1 + cos a) in place of d, a the angle between the way from the bone and the normal; else
/// by none (H = 0). In a component with less than a tenth of its vertices held by bones (a sleeve
/// about an arm, a sword), and where there are no bones, each vertex is held by the joint of its
/// node, d away: the node is known from how the surface collapsed. So limbs that touch do not move
/// each other, and no vertex is without a joint.
///
/// Precondition: a clean surface, each of whose vertices has a node in `skeleton`, and each node
/// and bone a joint. Throws Cancelled on a stop. One look along each bone for each vertex, one
/// Cholesky factorisation a component, one solve a joint.
[[nodiscard]] SkinWeights skin_weights(const Surface& surface, const CurveSkeleton& skeleton,
                                       const Eigen::VectorXi& joint_of_node,
                                       const std::vector<Bone>& bones, int joints,
                                       const SkinOptions& options = {},
                                       const Monitor& monitor = {});

}  // namespace curveskel
