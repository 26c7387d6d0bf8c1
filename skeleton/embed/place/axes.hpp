// The directions of the limbs at a junction.
#pragma once

#include <curveskel/advanced/tree.hpp>
#include "skeleton/embed/skeleton_graph.hpp"
#include "skeleton/embed/tuning.hpp"

namespace curveskel {

/// The point nearest to the axes of all arcs at a node of the given inscribed `radius`, each
/// taken outside of its ball: within it an arc goes to wherever the node is. Held back a little,
/// as axes that are nearly parallel meet anywhere.
[[nodiscard]] Point meeting_of_axes(const SkeletonGraph& graph, int node, double radius,
                                    const RelaxTuning& tuning = {});

/// True if a leaf arc would come nearer to being a spur, and hardly be longer than the inscribed
/// radius at its junction, if the junction moved to the point `to`.
[[nodiscard]] bool makes_spur(const SkeletonGraph& graph, int node, const CurvePoint& to,
                              const SurfaceTree& tree, const RelaxTuning& tuning = {});

}  // namespace curveskel
