// The last resort of the surgery: a partition whose graph is right without any contraction.
#pragma once

#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// A surface with its level-set Reeb graph.
struct LevelSetGraph {
  Surface surface;                  ///< the input, its edges split where handles are too fine
  Eigen::VectorXi vertex_of_input;  ///< #V of the input: the same vertex in `surface`
  PartitionGraph graph;             ///< of `surface`
};

/// Cuts the surface into slices, where the edge distance d from an extreme vertex passes k w + w/2.
/// Along an edge d changes by less than w, so no triangle meets three slices, and the connected
/// components of the slices are pieces that meet along cut curves: a discrete Reeb graph (Reeb
/// 1946). Where a piece has a handle of its own, w is too wide: the piece's edges are split until d
/// changes by less than w/2 along each, and that piece alone is cut again, and so on, twenty times
/// or until there are four times the vertices, and more than 32,000. A piece that then keeps a
/// handle, as one whose saddles lie in one vertex or whose vertices coincide, is cut along a loop
/// of its edges: that always ends. Precondition: one closed oriented component.
[[nodiscard]] LevelSetGraph level_set_graph(const Surface& surface, const Monitor& monitor);

/// Genus of each group's piece of surface, (2 - chi - cut curves) / 2. `index` is that of the
/// surface's triangles. O(#V + #F).
[[nodiscard]] std::vector<int> genus_of_groups(const Surface& surface, const EdgeIndex& index,
                                               const PartitionGraph& graph);

}  // namespace curveskel
