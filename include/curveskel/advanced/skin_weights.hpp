// The weights by which joints move vertices.
#pragma once

#include <Eigen/Core>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct SkinOptions {
  /// Width of the passage from one joint to the next, in units of the distance from the
  /// skin to the curve; 0.001..1000.
  double softness = 0.5;
  int most_joints = 4;         ///< that move one vertex; 1..8
  double least_weight = 0.01;  ///< smaller shares in a vertex are left out; 0..0.1
  int threads = 0;             ///< 0 = one per core; the result does not depend on it
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const SkinOptions& options);

/// n x `joints`, rows of sum 1 (up to rounding in single precision).
///
/// Heat on the surface (after Baran and Popovic 2007, eq. 3): (-L + A H) w_j = A H p_j, with L the
/// intrinsic Delaunay Laplacian, A the vertices' areas, H = 1 / (softness d)^2, d the distance of
/// the vertex to its node of the skeleton, and p_j = 1 where that node is moved by joint j, else 0.
/// As L has no negative weights, 0 <= w_j <= 1 and the w_j of a vertex sum to 1. The vertices that
/// a joint begins with are known from how the surface collapsed, not from what lies near: fingers
/// that touch do not move each other, and no vertex is without a joint.
/// Precondition: a clean surface, each of whose vertices has a node in `skeleton`, and each node a
/// joint. Throws Cancelled on a stop. One Cholesky factorisation a component, one solve a joint.
[[nodiscard]] SkinWeights skin_weights(const Surface& surface, const CurveSkeleton& skeleton,
                                       const Eigen::VectorXi& joint_of_node, int joints,
                                       const SkinOptions& options = {},
                                       const Monitor& monitor = {});

}  // namespace curveskel
