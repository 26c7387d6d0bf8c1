// A loop that opens a handle of one piece of a surface partition.
#pragma once

#include <vector>

#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// Vertices along a closed way over edges within the group, each once, that does not part the
/// group's piece even where its cut curves are closed by discs; no triangle has two edges of it.
/// From a spanning tree of the vertices and one of the faces and cut curves, the latter with the
/// edges that close the longest loops (J. Erickson, K. Whittlesey: Greedy optimal homotopy and
/// homology generators, 2005): no such loop through the group's lowest vertex is shorter.
/// Preconditions: the piece is connected and has a handle. O(#F log #F).
[[nodiscard]] std::vector<int> loop_of_handle(const Surface& surface, const EdgeIndex& index,
                                              const Eigen::VectorXi& group_of_vertex, int group);

}  // namespace curveskel
