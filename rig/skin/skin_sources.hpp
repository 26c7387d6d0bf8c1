// Sources of the heat of skin weights: of each vertex the joints that hold it, and how far from it
// they are.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <stop_token>
#include <vector>

#include <curveskel/advanced/skin_weights.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>
#include <curveskel/topology.hpp>

namespace curveskel {

struct SkinSources {
  using Shares = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  /// n x j: rows of sum 1, or empty ones, where heat only passes.
  Shares shares;
  Eigen::VectorXd distances;  ///< n, from the vertex to what holds it, in model units; > 0
};

/// Each vertex is held by the joint of its node.
[[nodiscard]] SkinSources sources_of_curve(const Surface& surface, const CurveSkeleton& skeleton,
                                           const Eigen::VectorXi& joint_of_node, int joints);

/// Each vertex is held by the bone that is nearest to it, if no face lies between; by several that
/// are as near in equal shares, else by none. Near is counted as 2 d / (1 + cos a), with a the
/// angle between the way to the vertex and the normal: a bone below the vertex is nearer than one
/// beside it, and far nearer than one above. A component with less than a tenth of its vertices
/// held keeps its rows of `otherwise`. O(#V * bones + #F log #F).
[[nodiscard]] SkinSources sources_of_bones(const Surface& surface, const CurveSkeleton& skeleton,
                                           const std::vector<Component>& parts,
                                           const std::vector<Bone>& bones,
                                           const SkinSources& otherwise, int threads,
                                           const std::stop_token& stop);

}  // namespace curveskel
