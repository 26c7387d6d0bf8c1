// A skeleton without embedding: nodes where contraction and surgery leave them.
#pragma once

#include <curveskel/advanced/surgery.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/contract.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct SkeletonAsContracted {
  CurveSkeleton skeleton;   ///< `node_of_vertex` by the vertices of `surface`; no radii
  bool level_sets = false;  ///< the surgery gave up, see level_set_graph
};

/// Nothing is centred, pruned or kept inside. SurgeryMethod::cgal gives CGAL's graph as it is, with
/// the cycles that it has; `own` the graph of `surgery`, each node in the mean of its group or
/// cut curve, or, where the surgery gives up, the level-set graph of the surface that is not
/// contracted. Precondition: `contraction` is of `surface`, one closed component.
[[nodiscard]] SkeletonAsContracted skeleton_as_contracted(const Surface& surface,
                                                          const Contraction& contraction,
                                                          const SurgeryOptions& options,
                                                          const Monitor& monitor);

/// #N distances to the tree's surface, 0 outside.
[[nodiscard]] Eigen::VectorXd inscribed_radii(const Positions& nodes, const SurfaceTree& tree);

}  // namespace curveskel
