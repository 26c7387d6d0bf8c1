// Corrections by hand: a skeleton in, the corrected skeleton out.
//
// All keep what CurveSkeleton promises: edges i < j, sorted, no row twice; radii (if there are any)
// and node_of_vertex in step with the nodes; a vertex that had a node still has one. Nodes keep
// their order: where one is taken out, those after it move up by one; a new one comes last.
// Lives (see CurveSkeleton) are the tips': one that takes the place of another has the larger life
// of the two, any other new one the largest of all, so that no detail hides it.
// With `tree`, the radius of a node that is new or moved is its distance to the surface
// (0 outside); without, it comes from the nodes that it was made of. All throw
// Error(Fault::input) that says what was found and needed. O(#V + #E log #E), and O(#N + #E) for
// each node that is taken out.
#pragma once

#include <Eigen/Core>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Takes out the leaf branch to which row `edge` of the edges belongs; its vertices go to the node
/// that it hung on, which stays. Refuses a branch that is a component of its own and one between
/// two junctions: neither hangs on anything.
[[nodiscard]] CurveSkeleton prune_branch(const CurveSkeleton& skeleton, int edge);

/// The same for one of `branches(skeleton)`.
[[nodiscard]] CurveSkeleton prune_branch(const CurveSkeleton& skeleton, const Branch& branch);

/// Takes out a node: its edges and vertices go to its nearest neighbour, which stays in place. So
/// a tip goes, a chain closes over a gap, a junction moves on; no component is torn. A node without
/// an edge goes as a component, its vertices to the nearest other node. Refuses the only node.
/// A cycle of three nodes is lost with one of them.
[[nodiscard]] CurveSkeleton remove_node(const CurveSkeleton& skeleton, int node);

enum class MergePlace { midpoint, first };

/// Two nodes become one, which has the lower of their numbers, at the middle between them or where
/// `a` is. Edges that become one through a neighbour of both are kept once: that cycle is lost.
/// Nodes without an edge between them may be merged, too: that joins two components, or makes a
/// cycle. Without a tree the radius is the mean of the two, or that of `a`.
[[nodiscard]] CurveSkeleton merge_nodes(const CurveSkeleton& skeleton, int a, int b,
                                        MergePlace place = MergePlace::midpoint,
                                        const SurfaceTree* tree = nullptr);

/// Without a tree the radius stays. Refuses coordinates that are no finite numbers.
[[nodiscard]] CurveSkeleton move_node(const CurveSkeleton& skeleton, int node,
                                      const Eigen::Vector3d& position,
                                      const SurfaceTree* tree = nullptr);

/// Takes out row `edge` of the edges: one cycle less, or one component more.
[[nodiscard]] CurveSkeleton cut_edge(const CurveSkeleton& skeleton, int edge);

/// Adds the edge between two nodes: one cycle more, or one component less. Refuses a == b, and two
/// nodes that are neighbours.
[[nodiscard]] CurveSkeleton join_nodes(const CurveSkeleton& skeleton, int a, int b);

/// Puts a node on row (i, j) of the edges, at `share` (0..1, exclusive) of the way from i to j.
/// Without a tree the radius is interpolated. Vertices stay where they are.
[[nodiscard]] CurveSkeleton split_edge(const CurveSkeleton& skeleton, int edge, double share = 0.5,
                                       const SurfaceTree* tree = nullptr);

/// Adds a node with an edge to `neighbour`. Without a tree it gets the neighbour's radius. Refuses
/// coordinates that are no finite numbers.
[[nodiscard]] CurveSkeleton add_node(const CurveSkeleton& skeleton, int neighbour,
                                     const Eigen::Vector3d& position,
                                     const SurfaceTree* tree = nullptr);

struct Path {
  std::vector<int> nodes;  ///< in order, ends included; empty = there is none
  double length = 0;       ///< in model units
};

/// The shortest way along the edges (Dijkstra 1959); a == b: that node alone.
/// O(#N + #E log #N).
[[nodiscard]] Path shortest_path(const CurveSkeleton& skeleton, int a, int b);

}  // namespace curveskel
