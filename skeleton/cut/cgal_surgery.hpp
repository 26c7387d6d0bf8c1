// Connectivity surgery by CGAL: a contracted surface becomes a graph.
#pragma once

#include <curveskel/contract.hpp>
#include <curveskel/curve_skeleton.hpp>

namespace curveskel {

/// The graph that CGAL makes of the contracted surface, by collapsing edges from the shortest to
/// the longest until no triangle is left (Tagliasacchi et al. 2012, section 4.3): a node where each
/// group of merged vertices lies in the mean, an edge between groups that met, `node_of_vertex` by
/// the vertices of the contraction's input, no radii. CGAL's own contraction does not run. Nothing
/// guards the topology: two groups that meet along several cut curves have one edge.
/// Precondition: one closed component. O(#F log #F).
[[nodiscard]] CurveSkeleton cgal_surgery(const Contraction& contraction);

}  // namespace curveskel
